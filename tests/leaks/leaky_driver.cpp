/// Stands for a Vulkan driver: memory to which only its own variable points.
#include <cstdlib>

void* volatile mask = nullptr;

extern "C" void start_driver() { mask = std::malloc(128); }
