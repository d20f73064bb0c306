# Run at every build: writes ${OUTPUT} with the current git commit, touching it only when that has changed.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND git describe --always --abbrev=12 --exclude=*
                WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
  set(commit unknown)
endif()
# Records of measurements are no source: one run must not make the next one's commit dirty.
execute_process(COMMAND git status --porcelain --untracked-files=no -- . :!tests/bench/results
                WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE changes OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(changes)
  string(APPEND commit -dirty)
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#include \"app/library/commit.h\"

namespace splatray {

const char* const COMMIT = \"@commit@\";

}  // namespace splatray
" @ONLY)
