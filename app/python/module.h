/// What the parts of Python's module share.
#pragma once
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <chrono>
#include <memory>
#include <utility>
#include <vector>

#include "app/library/splatray.h"

namespace splatray::python {

namespace nb = nanobind;

/// Calls `callback(stage, share)` unless it is None, some times a second, and looks for signals there, so that Ctrl-C ends the call.
/// `callback` must outlive what is returned, which is called without the interpreter's lock.
[[nodiscard]] api::Progress progress_of(const nb::object& callback);

/// The values that a scene is opened, lit and shown with.
void add_values(nb::module_& module);
/// What makes scenes of arrays.
void add_arrays(nb::module_& module);

/// Arrays (n, 3) and (n,) as the interface takes them.
template <typename Value>
using Rows = nb::ndarray<const Value, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
template <typename Value>
using Numbers = nb::ndarray<const Value, nb::shape<-1>, nb::c_contig, nb::device::cpu>;

/// Rows of three, without a copy.
template <typename Value>
std::span<const std::array<Value, 3>> rows(const Rows<Value>& array) {
  return {reinterpret_cast<const std::array<Value, 3>*>(array.data()), array.shape(0)};
}

/// Runs body() without the interpreter's lock.
template <typename Body>
auto unlocked(const Body& body) {
  const nb::gil_scoped_release release;
  return body();
}

/// A vector as an array that owns it, without a copy.
template <typename Value, typename Element>
nb::object owning_array(std::vector<Element> values, std::initializer_list<std::size_t> shape) {
  auto* kept = new std::vector<Element>(std::move(values));
  const nb::capsule owner(kept, [](void* list) noexcept { delete static_cast<std::vector<Element>*>(list); });
  return nb::cast(nb::ndarray<nb::numpy, Value>(kept->data(), shape, owner));
}

}  // namespace splatray::python
