/// The border of the library: what goes wrong inside becomes the interface's Error.
#pragma once
#include <exception>
#include <new>

#include "app/library/splatray.h"
#include "engine/base/error.h"
#include "engine/base/progress.h"

namespace splatray::api {

/// A user's Progress as the work inside hears it. What the user's function throws ends the work as false does, and is kept.
class ProgressRelay {
 public:
  /// `progress` must outlive this.
  explicit ProgressRelay(const Progress& progress) : progress_(progress) {}

  bool operator()(const char* stage, double share) {
    if (!progress_) return true;
    try {
      return progress_(stage, share);
    } catch (...) {
      thrown_ = std::current_exception();
      return false;
    }
  }
  [[nodiscard]] const std::exception_ptr& thrown() const { return thrown_; }

 private:
  const Progress& progress_;
  std::exception_ptr thrown_;
};

/// The interface's Error of whatever is being thrown.
[[noreturn]] void rethrow_as_error();

/// Runs body(relay), a call of the interface that reports progress.
template <typename Body>
auto guarded(const Progress& progress, const Body& body) {
  ProgressRelay relay(progress);
  try {
    return body(relay);
  } catch (...) {
    if (relay.thrown()) std::rethrow_exception(relay.thrown());
    rethrow_as_error();
  }
}

/// Runs body(), a call of the interface.
template <typename Body>
auto guarded(const Body& body) {
  try {
    return body();
  } catch (...) {
    rethrow_as_error();
  }
}

/// Throws Error (usage).
[[noreturn]] void refuse(const std::string& found, const std::string& expected);

}  // namespace splatray::api
