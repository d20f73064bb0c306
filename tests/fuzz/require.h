/// Promises that fuzzed input must not break.
#pragma once
#include <cstdio>
#include <cstdlib>
#include <string>

#include "engine/base/error.h"

namespace splatray::testing {

/// Ends the program, as a finding, unless the promise holds; `found` is what broke it.
inline void require(bool holds, const char* promise, const std::string& found = {}) {
  if (holds) return;
  std::fprintf(stderr, "broken promise: %s %s\n", promise, found.c_str());
  std::abort();
}

/// Runs `read`, which may refuse its input by an Error (input_unreadable) of one sentence.
template <class Read>
void read_or_refuse(const Read& read) {
  try {
    read();
  } catch (const Error& error) {
    const std::string sentence = error.what();
    require(error.code() == ExitCode::input_unreadable, "input that cannot be read has its own exit code",
            sentence);
    require(sentence.find('\n') == std::string::npos, "an error is one line", sentence);
  }
}

}  // namespace splatray::testing
