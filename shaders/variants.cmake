# The compute programs, one row for each SPIR-V module: name, shader, flags. engine/device/vulkan/program_code.cpp says who picks it.
#   PAGED  some pool is larger than the device's largest buffer. Modules of their own, as the choice of a buffer at every read costs
#          SwiftShader's compiler half as long again and llvmpipe part of a frame (tests/bench/ideas.md).
#   LIT    path tracing and its like (LOOK_*), else Phong.
add_variant(TRACE       stage/trace.comp.glsl)
add_variant(TRACE_PAGED stage/trace.comp.glsl PAGED)
add_variant(LIGHT       stage/trace.comp.glsl LIT)
add_variant(LIGHT_PAGED stage/trace.comp.glsl LIT PAGED)
add_variant(RAYS        stage/rays.comp.glsl)
add_variant(RAYS_PAGED  stage/rays.comp.glsl PAGED)
add_variant(FUSED       stage/fused.comp.glsl)
add_variant(DISPLAY     display/display.comp.glsl)
