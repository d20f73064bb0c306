/// Promises that fuzzed input must not break.
#pragma once
#include <cstdio>
#include <cstdlib>

#include "engine/base/error.h"

namespace splatray::testing {

/// Ends the program, as a finding, unless the promise holds.
inline void require(bool holds, const char* promise) {
  if (holds) return;
  std::fprintf(stderr, "broken promise: %s\n", promise);
  std::abort();
}

/// Runs `read`, which may refuse its input by an Error (input_unreadable) of one sentence.
template <class Read>
void read_or_refuse(const Read& read) {
  try {
    read();
  } catch (const Error& error) {
    require(error.code() == ExitCode::input_unreadable, "input that cannot be read has its own exit code");
    require(std::string(error.what()).find('\n') == std::string::npos, "an error is one line");
  }
}

}  // namespace splatray::testing
