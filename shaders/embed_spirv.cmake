# cmake -DSPIRV_OPT=spirv-opt -DSPIRV=in.spv -DHEADER=shaders/spirv.h -DNAME=TRACE -DOUTPUT=out.cpp -P embed_spirv.cmake
# Optimises a SPIR-V file and writes its little-endian words as the array that the header declares under that name.

# Drivers make pipelines of the result in 0.6 of the time (tests/bench/ideas.md). Not spirv-opt's own -O: its merge-return
# turns early returns into loops, which costs llvmpipe 2 % of a frame. Without it functions that have some are not inlined, of
# which it warns.
set(PASSES --inline-entry-points-exhaustive --eliminate-dead-functions --private-to-local --scalar-replacement=100
           --convert-local-access-chains --eliminate-local-single-block --eliminate-local-single-store --ssa-rewrite --ccp
           --simplify-instructions --redundancy-elimination --eliminate-dead-code-aggressive --merge-blocks)
execute_process(COMMAND ${SPIRV_OPT} ${PASSES} ${SPIRV} -o ${SPIRV}.optimised RESULT_VARIABLE failed
                OUTPUT_VARIABLE messages ERROR_VARIABLE messages)
if(failed)
  message(FATAL_ERROR "${SPIRV}: ${messages}")
endif()
file(READ ${SPIRV}.optimised bytes HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${bytes}")
file(WRITE ${OUTPUT} "#include \"${HEADER}\"\n"
                     "static constexpr std::uint32_t WORDS[] = {${words}};\n"
                     "const std::span<const std::uint32_t> splatray::${NAME}(WORDS);\n")
