# cmake -DSPIRV=in.spv -DNAME=TRACE_TEXEL -DOUTPUT=out.cpp -P embed_spirv.cmake
# Writes the little-endian words of a SPIR-V file as the array that spirv.h declares under that name.
file(READ ${SPIRV} bytes HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${bytes}")
file(WRITE ${OUTPUT} "#include \"shaders/spirv.h\"\n"
                     "static constexpr std::uint32_t WORDS[] = {${words}};\n"
                     "const std::span<const std::uint32_t> splatray::${NAME}(WORDS);\n")
