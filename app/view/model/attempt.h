/// What goes wrong in a step of the viewer's work, as something to show instead of an end of the program.
#pragma once
#include <functional>
#include <optional>
#include <string>

namespace splatray {

/// Why a step did not get to its end.
struct Failure {
  std::string sentence;      ///< what to show
  bool interrupted = false;  ///< stopped on request: nothing went wrong
};

/// Runs `step`; nothing when it gets to its end, else why it did not: an Error's sentence, that memory ran out, or what any
/// other std::exception says. `doing` names the work where the exception cannot: "loading dragon.ply".
[[nodiscard]] std::optional<Failure> attempt(const std::string& doing, const std::function<void()>& step);

/// Adds a sentence to others, one a line; one that is there already is not added.
void add_line(std::string& sentences, const std::string& sentence);

}  // namespace splatray
