#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <string>
#include <tuple>

#include "app/python/module.h"

namespace splatray::python {
namespace {

using Attributes = std::vector<std::pair<std::string, Numbers<double>>>;
/// Positions, triangles (None: points), normals, colours, radii, attributes, name, material, whether scanned.
using ObjectArrays = std::tuple<Rows<double>, std::optional<Rows<std::uint32_t>>, std::optional<Rows<float>>,
                                std::optional<Rows<float>>, std::optional<Numbers<float>>, Attributes,
                                std::string, std::optional<api::Material>, std::optional<bool>>;

template <typename Value>
std::span<const std::array<Value, 3>> rows_or_none(const std::optional<Rows<Value>>& array) {
  return array ? rows(*array) : std::span<const std::array<Value, 3>>{};
}

/// The object, which looks into the arrays.
api::Object object_of(const ObjectArrays& arrays) {
  const auto& [positions, triangles, normals, colors, radii, attributes, name, material, scanned] = arrays;
  std::vector<api::Attribute> columns;
  for (const auto& [column, values] : attributes)
    columns.push_back({column, std::span(values.data(), values.shape(0))});
  if (triangles)
    return api::Mesh{
        rows(positions), rows(*triangles), rows_or_none(normals), rows_or_none(colors), columns, name,
        material};
  std::span<const float> sizes;
  if (radii) sizes = {radii->data(), radii->shape(0)};
  return api::Points{
      rows(positions), rows_or_none(normals), rows_or_none(colors), sizes, columns, name, material, scanned};
}

api::Scene* make_scene(const std::vector<ObjectArrays>& given, const api::Request& request,
                       const nb::object& progress) {
  std::vector<api::Object> objects;
  for (const ObjectArrays& arrays : given) objects.push_back(object_of(arrays));
  const api::Progress relay = progress_of(progress);
  return unlocked([&] { return new api::Scene(api::make_scene(objects, request, relay)); });
}

}  // namespace

void add_arrays(nb::module_& module) {
  module.def("make_scene", make_scene, nb::arg("objects"), nb::arg("request"), nb::arg("progress").none());
}

}  // namespace splatray::python
