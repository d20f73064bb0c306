/// The two kinds of failure. A user's mistake is an Error: one sentence with the file, what was found and what was
/// expected, and the exit code; thrown anywhere, caught once in each main. A programmer's mistake is an assert.
#pragma once
#include <stdexcept>
#include <string>

namespace splatray {

/// Exit codes of all programs.
enum class ExitCode : int {
  done = 0,
  failed = 1,            ///< the work or a comparison failed
  usage = 2,             ///< the command line is wrong
  input_unreadable = 3,  ///< a file is missing, unreadable or not what it should be
  no_device = 4,         ///< no usable Vulkan device (viewer: no display)
  out_of_memory = 5,     ///< host or device memory
  interrupted = 130,     ///< SIGINT, SIGTERM or SIGHUP
};

/// A failure to report to the user; what() is one sentence without a trailing period. Control characters in it, as file
/// names may have them, become '?': a report is always one line.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& sentence);
  [[nodiscard]] ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// Runs a program's body; prints an Error, bad_alloc or other exception, and that stdout did not take all, as one sentence on stderr
/// ("splatray-render: error: ...") and returns the exit code to return from main. Ignores SIGXFSZ, so that a write beyond
/// the limit of a file's size fails as one on a full disk does.
int run_main(const char* program, int (*body)(int, char**), int argc, char** argv);

}  // namespace splatray
