# The compute programs, one row for each SPIR-V module: name, shader, flags. engine/device/vulkan/program_code.cpp says who picks it.
#   LIT  path tracing and its like (LOOK_*), else Phong.
add_variant(TRACE   stage/trace.comp.glsl)
add_variant(LIGHT   stage/trace.comp.glsl LIT)
add_variant(RAYS    stage/rays.comp.glsl)
add_variant(FUSED   stage/fused.comp.glsl)
add_variant(DISPLAY display/display.comp.glsl)
add_variant(DENOISE display/denoise.comp.glsl)
