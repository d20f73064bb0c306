# cmake -DSPIRV=in.spv -DHEADER=shaders/spirv.h -DNAME=TRACE_TEXEL -DOUTPUT=out.cpp -P embed_spirv.cmake
# Writes the little-endian words of a SPIR-V file as the array that the header declares under that name.
file(READ ${SPIRV} bytes HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${bytes}")
file(WRITE ${OUTPUT} "#include \"${HEADER}\"\n"
                     "static constexpr std::uint32_t WORDS[] = {${words}};\n"
                     "const std::span<const std::uint32_t> splatray::${NAME}(WORDS);\n")
