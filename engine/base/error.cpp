#include "engine/base/error.h"

#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "engine/base/one_line.h"

namespace splatray {

Error::Error(ExitCode code, const std::string& sentence)
    : std::runtime_error(one_line(sentence)), code_(code) {}

int run_main(const char* program, int (*body)(int, char**), int argc, char** argv) {
  const auto fail = [program](ExitCode code, const std::string& sentence) {
    std::fprintf(stderr, "%s: error: %s\n", program, sentence.c_str());
    return static_cast<int>(code);
  };
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    const int code = body(argc, argv);
    if (code == 0 && (std::fflush(stdout) != 0 || std::ferror(stdout) != 0))
      return fail(ExitCode::failed, "not all that was printed could be written to stdout");
    return code;
  } catch (const Error& error) {
    return fail(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::out_of_memory, "out of memory");
  } catch (const std::exception& error) {
    return fail(ExitCode::failed, one_line(error.what()));
  }
}

}  // namespace splatray
