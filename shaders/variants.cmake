# The compute programs, one row for each SPIR-V module: name, shader, flags. engine/device/vulkan/program_code.cpp says who picks it.
#   CPU    for CPU devices (llvmpipe): pools in texel buffers, which it reads in 0.6 of the time; hits decided in float64, at which it
#          is fast; wavefront stages; parameters copied to private memory. Others: pools in storage buffers, hits in double-float.
#   PAGED  some pool is larger than the device's largest buffer. Modules of their own, as the choice of a buffer at every read costs
#          SwiftShader's compiler half as long again and llvmpipe part of a frame (tests/bench/ideas.md).
#   LIT    path tracing and its like (LOOK_*), else Phong.
add_variant(TRACE           stage/trace.comp.glsl)
add_variant(TRACE_PAGED     stage/trace.comp.glsl PAGED)
add_variant(TRACE_CPU       stage/trace.comp.glsl CPU)
add_variant(TRACE_CPU_PAGED stage/trace.comp.glsl CPU PAGED)
add_variant(LIGHT           stage/trace.comp.glsl LIT)
add_variant(LIGHT_PAGED     stage/trace.comp.glsl LIT PAGED)
add_variant(LIGHT_CPU       stage/trace.comp.glsl LIT CPU)
add_variant(LIGHT_CPU_PAGED stage/trace.comp.glsl LIT CPU PAGED)
add_variant(RAYS            stage/rays.comp.glsl)
add_variant(RAYS_PAGED      stage/rays.comp.glsl PAGED)
add_variant(RAYS_CPU        stage/rays.comp.glsl CPU)
add_variant(RAYS_CPU_PAGED  stage/rays.comp.glsl CPU PAGED)
add_variant(EMPTY_CPU       stage/empty.comp.glsl CPU)
add_variant(EMPTY_LIGHT_CPU stage/empty.comp.glsl LIT CPU)
