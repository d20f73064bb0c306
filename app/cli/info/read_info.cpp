#include <algorithm>
#include <cmath>
#include <ranges>
#include <span>

#include "app/cli/info/file_info.h"
#include "app/library/request/request.h"
#include "engine/base/number_text.h"
#include "engine/base/one_line.h"
#include "engine/base/utf8.h"
#include "engine/file/scene_file.h"
#include "engine/scene/scene_splat.h"
#include "preprocess/base/file_extension.h"
#include "preprocess/read/formats.h"
#include "preprocess/read/read_mesh.h"

namespace splatray {
namespace {

/// Adds values of an attribute that other objects of the file may have, too.
void add_range(FileInfo& info, const AttributeInfo& more) {
  const auto found = std::find_if(info.attributes.begin(), info.attributes.end(),
                                  [&](const AttributeInfo& known) { return known.name == more.name; });
  if (found == info.attributes.end()) return info.attributes.push_back(more);
  found->low = std::min(found->low, more.low);
  found->high = std::max(found->high, more.high);
}

/// The range of the finite ones of values; nothing where there are none.
template <typename Values, typename Number>
void add_values(FileInfo& info, const std::string& name, const std::string& type, const Values& values,
                const Number& number) {
  double low = INFINITY, high = -INFINITY;
  for (const auto& value : values) {
    const double x = number(value);
    if (!std::isfinite(x)) continue;
    low = std::min(low, x);
    high = std::max(high, x);
  }
  if (low <= high) add_range(info, {name, type, low, high});
}

void add_column(FileInfo& info, const Column& column) {
  static const char* const TYPES[] = {"uint8", "uint16", "float32", "float64"};
  std::visit(
      [&](const auto& values) {
        add_values(info, column.name, TYPES[column.values.index()], values,
                   [](auto value) { return static_cast<double>(value); });
      },
      column.values);
  if (column.name != COLUMN_CLASS) return;
  for (std::size_t i = 0; i < column.size(); ++i)
    if (const double value = column.number(i); value >= 0.0 && value <= 0xFFFF)
      ++info.classes[static_cast<std::uint32_t>(value)];
}

template <typename Color>
double most(const Color& color) {
  return std::max({double(color.x), double(color.y), double(color.z)});
}

void add_points(FileInfo& info, const Points& points) {
  info.points += points.size();
  for (const glm::dvec3& position : points.position)
    if (glm::dot(position, position) < INFINITY) info.box.add(position);
  if (info.crs.empty()) info.crs = points.crs;
  add_values(info, "normal", "float32", points.normal,
             [](const glm::vec3& normal) { return double(glm::length(normal)); });
  add_values(info, "rgb", "float32", points.color, most<glm::vec3>);
  add_values(info, "rgb", "uint16", points.stored_color, most<glm::u16vec3>);
  add_values(info, "radius", "float32", points.radius, [](float radius) { return double(radius); });
  for (const Column& column : points.columns) add_column(info, column);
}

void add_scans(FileInfo& info, const std::vector<Station>& stations, std::span<const std::uint16_t> station,
               std::uint64_t points) {
  const std::size_t first = info.scans.size();
  for (const Station& one : stations) info.scans.push_back({one.name, 0, 0, one});
  for (const std::uint16_t s : station)
    if (s < stations.size()) ++info.scans[first + s].points;
  if (station.empty() && stations.size() == 1) info.scans[first].points = points;
}

void add_mesh(FileInfo& info, const Mesh& mesh, PartInfo& object) {
  add_points(info, mesh.vertices);
  add_scans(info, mesh.vertices.stations, mesh.vertices.station, mesh.vertices.size());
  info.triangles += mesh.triangles.size();
  object.points += mesh.vertices.size();
  object.triangles += mesh.triangles.size();
}

void add_input(FileInfo& info, const Input& input) {
  for (const InputObject& object : input.objects) {
    PartInfo part{object.name, object.points.size()};
    add_points(info, object.points);
    for (const Mesh& mesh : object.meshes) add_mesh(info, mesh, part);
    info.objects.push_back(part);
  }
  info.lights = input.lights.size();
  info.has_camera = input.camera.has_value();
}

void add_scan_file(FileInfo& info, const ScanFile& file, bool heads_only) {
  info.facts = file.facts;
  info.counts = file.counts;
  add_points(info, file.points);
  add_scans(info, file.points.stations, file.points.station, file.points.size());
  info.from_head = heads_only && file.points.size() == 0 && file.counts.stored > 0;
  if (!info.from_head) return;
  info.points = file.counts.stored;
  if (file.said_box) info.box = {(*file.said_box)[0], (*file.said_box)[1]};
}

void add_scene(FileInfo& info, const Scene& scene) {
  info.facts = {{"splats in leaves of", std::to_string(scene.build.leaf_size)},
                {"coordinates in steps of", number_text(scene.root.unit_world)}};
  info.points = splat_count(scene);
  info.box = {scene.bounds_min_world, scene.bounds_max_world};
  info.crs = scene.crs;
  add_values(info, "radius", "float32", std::views::iota(std::size_t{0}, splat_count(scene)),
             [&](std::size_t i) { return splat_at(scene, i).radius_world(); });
  add_values(info, "rgb", "uint8", scene.color_pool,
             [](std::uint32_t color) { return most(unpack_color(color)); });
  for (const Column& column : scene.columns) add_column(info, column);
  const Column* scan = find_column(scene.columns, COLUMN_SCAN);
  const auto* station = scan == nullptr ? nullptr : std::get_if<Pool<std::uint16_t>>(&scan->values);
  add_scans(info, scene.stations, station == nullptr ? Pool<std::uint16_t>() : *station, info.points);
  for (const std::string& name : scene.object_names) info.objects.push_back({name});
  for_each_splat(scene, [&](std::size_t, const SceneSplat& splat) { ++info.objects[splat.object()].points; });
  info.lights = scene.lights.size();
  info.has_camera = scene.camera.has_value();
}

}  // namespace

FileInfo read_info(const std::filesystem::path& path, const InfoOptions& asked, const Progress& progress) {
  FileInfo info;
  info.path = path;
  ReadOptions options;
  options.data_paths = model_folders({});
  options.heads_only = asked.heads_only;
  options.scans.columns = asked.columns;
  options.progress = progress;
  const ReadListener listener{info.notes, options.progress};
  const Format* format = find_format(path);
  if (is_scene_file(path)) {
    add_scene(info, read_scene(path, progress));
  } else if (format != nullptr && format->read_scan != nullptr) {
    add_scan_file(info, format->read_scan(path, options, listener), asked.heads_only);
  } else if (format != nullptr && format->read_scene != nullptr) {
    add_input(info, format->read_scene(path, options, listener));
  } else {
    add_mesh(info, read_mesh(path, options, listener),
             info.objects.emplace_back(PartInfo{path_text(path.stem())}));
  }
  for (std::string& note : info.notes) note = one_line(note);
  return info;
}

}  // namespace splatray
