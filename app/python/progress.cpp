#include "app/python/module.h"

namespace splatray::python {

api::Progress progress_of(const nb::object& callback) {
  using Clock = std::chrono::steady_clock;
  static constexpr auto PAUSE = std::chrono::milliseconds(50);
  return [&callback, last = Clock::now() - PAUSE](const char* stage, double share) mutable {
    if (Clock::now() - last < PAUSE && share < 1.0) return true;
    last = Clock::now();
    const nb::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    if (callback.is_none()) return true;
    const nb::object answer = callback(stage, share);
    return answer.ptr() != Py_False;
  };
}

}  // namespace splatray::python
