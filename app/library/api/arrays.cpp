#include "app/library/api/arrays.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "app/library/api/guard.h"
#include "app/library/api/scene_impl.h"
#include "app/library/attributes.h"
#include "engine/scene/phong.h"
#include "preprocess/read/scan/narrow_column.h"
#include "preprocess/read/scan/scan_stations.h"

namespace splatray::api {
namespace {

/// More than rounding makes of 1.
constexpr float MOST_COLOR = 1.01F;
/// Attributes that an object of arrays may have: one column is for COLUMN_POINT.
constexpr std::size_t ATTRIBUTES_MOST = COLUMNS_MOST - 1;

/// An array in the type that preprocess works on.
template <typename To, typename From>
std::vector<To> copied(const std::span<const From>& values) {
  std::vector<To> list(values.size());
  std::transform(values.begin(), values.end(), list.begin(), [](const From& v) { return vector(v); });
  return list;
}

void check_size(const std::string& name, std::size_t size, std::size_t positions) {
  if (size != 0 && size != positions)
    refuse(std::to_string(size) + " " + name,
           "none or as many as the " + std::to_string(positions) + " positions");
}

void check_colors(std::span<const Float3> colors) {
  float most = 0.0F;
  for (const Float3& color : colors) most = std::max({most, color[0], color[1], color[2]});
  if (most > MOST_COLOR) refuse("colors up to " + std::to_string(most), "linear values of 0 to 1");
}

/// Names end with a zero character in scene files.
void check_name(const std::string& what, const std::string& name) {
  if (name.find('\0') != std::string::npos)
    refuse(what + " with a zero character in its name", "another name");
}

/// Checks attributes whose values stand for themselves, such as classes.
void check_categories(const Attribute& attribute) {
  for (const double value : attribute.values)
    if (std::isfinite(value) &&
        !(value >= 0.0 && value <= double{std::numeric_limits<std::uint32_t>::max()} &&
          value == std::trunc(value)))
      refuse(std::to_string(value) + " in the attribute '" + attribute.name + "'", "whole numbers from 0 on");
}

void check_attributes(std::span<const Attribute> attributes, std::size_t positions) {
  if (attributes.size() > ATTRIBUTES_MOST)
    refuse(std::to_string(attributes.size()) + " attributes", "at most " + std::to_string(ATTRIBUTES_MOST));
  for (auto attribute = attributes.begin(); attribute != attributes.end(); ++attribute) {
    const std::string& name = attribute->name;
    if (name.empty() || name == COLUMN_POINT || name == COLUMN_KIND)
      refuse("an attribute named '" + name + "'", "a name other than '', 'point' and 'kind'");
    check_name("an attribute", name);
    if (std::any_of(attributes.begin(), attribute,
                    [&](const Attribute& other) { return other.name == name; }))
      refuse("two attributes named '" + name + "'", "one of each name");
    if (attribute->values.size() != positions)
      refuse(std::to_string(attribute->values.size()) + " values of the attribute '" + name + "'",
             "as many as the " + std::to_string(positions) + " positions");
    if (is_category(name)) check_categories(*attribute);
  }
}

/// The columns of attributes; as from files, numbers of scans make stations.
void add_columns(std::span<const Attribute> attributes, splatray::Points& points) {
  for (const Attribute& attribute : attributes) {
    std::vector<double> values(attribute.values.begin(), attribute.values.end());
    if (attribute.name == COLUMN_SCAN) static_cast<void>(make_stations(values, points));
    points.columns.push_back(narrow_column(attribute.name, std::move(values)));
  }
}

/// What points and the vertices of meshes have; `object` is either.
template <typename Object>
InputObject described_object(const Object& object, std::span<const Double3> positions) {
  check_name("an object", object.name);
  check_size("normals", object.normals.size(), positions.size());
  check_size("colors", object.colors.size(), positions.size());
  check_colors(object.colors);
  check_attributes(object.attributes, positions.size());
  InputObject made;
  made.name = object.name;
  made.material = default_material(!object.colors.empty());
  return made;
}

template <typename Object>
splatray::Points vertices_of(const Object& object, std::span<const Double3> positions) {
  splatray::Points points;
  points.position = copied<glm::dvec3>(positions);
  points.normal = copied<glm::vec3>(object.normals);
  points.color = copied<glm::vec3>(object.colors);
  add_columns(object.attributes, points);
  return points;
}

void check_triangles(const Mesh& mesh) {
  if (mesh.triangles.empty()) refuse("a mesh without triangles", "at least one; Points have none");
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (const std::uint32_t vertex : mesh.triangles[i])
      if (vertex >= mesh.vertices.size())
        refuse("vertex " + std::to_string(vertex) + " in triangle " + std::to_string(i),
               "a number below " + std::to_string(mesh.vertices.size()));
}

}  // namespace

InputObject input_object(const Points& points) {
  check_size("radii", points.radii.size(), points.positions.size());
  InputObject object = described_object(points, points.positions);
  object.measured = points.scanned.value_or(points.normals.empty());
  object.points = vertices_of(points, points.positions);
  object.points.radius.assign(points.radii.begin(), points.radii.end());
  std::vector<double> number(points.positions.size());
  std::iota(number.begin(), number.end(), 0.0);
  object.points.columns.push_back({std::string(COLUMN_POINT), std::move(number)});
  return object;
}

InputObject input_object(const Mesh& mesh) {
  check_triangles(mesh);
  InputObject object = described_object(mesh, mesh.vertices);
  if (mesh.material && mesh.material->glass) {
    object.material.flags = MATERIAL_DIELECTRIC;
    follow_phong(object.material);
  }
  splatray::Mesh& made = object.meshes.emplace_back();
  made.vertices = vertices_of(mesh, mesh.vertices);
  for (const auto& [a, b, c] : mesh.triangles) made.triangles.emplace_back(a, b, c);
  return object;
}

}  // namespace splatray::api
