// The few words in which GLSL and C++ differ, so that every other .glsl file compiles as both. The C++ side
// of this file is shaders/lang/glsl_as_cpp.h.
#ifndef SPLATRAY_LANGUAGE_GLSL
#define SPLATRAY_LANGUAGE_GLSL
#ifndef __cplusplus
#define OUT(type) out type
#define INOUT(type) inout type
#define PRECISE precise
#define INFINITY_F uintBitsToFloat(0x7F800000u)
#endif
#endif
