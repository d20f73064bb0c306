#include "engine/base/error.h"

#include <cstdio>
#include <exception>
#include <new>

namespace splatray {

int run_main(const char* program, int (*body)(int, char**), int argc, char** argv) {
  const auto fail = [program](ExitCode code, const char* sentence) {
    std::fprintf(stderr, "%s: error: %s\n", program, sentence);
    return static_cast<int>(code);
  };
  try {
    return body(argc, argv);
  } catch (const Error& error) {
    return fail(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::out_of_memory, "out of memory");
  } catch (const std::exception& error) {
    return fail(ExitCode::failed, error.what());
  }
}

}  // namespace splatray
