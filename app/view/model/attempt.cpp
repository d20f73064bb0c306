#include "app/view/model/attempt.h"

#include <exception>
#include <new>

#include "engine/base/error.h"

namespace splatray {

std::optional<Failure> attempt(const std::string& doing, const std::function<void()>& step) {
  try {
    step();
  } catch (const Error& error) {
    return Failure{error.what(), error.code() == ExitCode::interrupted};
  } catch (const std::bad_alloc&) {
    return Failure{"out of memory while " + doing};
  } catch (const std::exception& error) {
    return Failure{doing + ": " + error.what()};
  }
  return {};
}

void add_line(std::string& sentences, const std::string& sentence) {
  if (sentences.find(sentence) != std::string::npos) return;
  sentences += (sentences.empty() ? "" : "\n") + sentence;
}

}  // namespace splatray
