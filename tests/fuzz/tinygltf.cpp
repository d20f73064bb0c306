// tinygltf and its image decoder, compiled here so that the fuzzer sees into them; the distribution's library is not
// instrumented. These symbols come before the library's.
#define TINYGLTF_IMPLEMENTATION
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <tiny_gltf.h>
