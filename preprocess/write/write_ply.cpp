#include <algorithm>

#include "engine/base/number_text.h"
#include "preprocess/write/point_output.h"

namespace splatray {
namespace {

/// A line; what would end it, as line breaks in well-known text do, is a blank.
void add_remark(std::string& header, std::string remark) {
  std::replace_if(
      remark.begin(), remark.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; }, ' ');
  header += "comment " + remark + '\n';
}

/// What preprocess/read/ply/ply_splats.h reads.
std::string splat_remarks(const Scene& scene) {
  std::string header;
  add_remark(header, "splatray lattice " + number_text(scene.root.origin_world, ' ') + ' ' +
                         number_text(scene.root.unit_world));
  add_remark(header, "splatray up " + number_text(scene.up, ' '));
  for (const Station& station : scene.stations) {
    const std::string sensor = station.sensor_world ? number_text(*station.sensor_world, ' ') : "- - -";
    add_remark(header, "splatray scan " + number_text(station.noise_world) + ' ' +
                           number_text(station.step_world) + ' ' + sensor + ' ' + station.name);
  }
  return header;
}

/// Words that the splats have beside their 128 bits.
void add_words(const Scene& scene, std::vector<PointProperty>& properties) {
  const auto add = [&](const char* name, const std::vector<std::uint32_t>& pool) {
    if (!pool.empty())
      properties.push_back({name, ValueType::uint32, [&pool](std::size_t i) { return double(pool[i]); }});
  };
  add("splat_field", scene.field_pool);
  add("splat_clip", scene.clip_pool);
}

}  // namespace

void write_ply(const PointTable& table, PointOutput& out) {
  const char* const TYPES[] = {"uchar", "ushort", "uint", "float", "double"};
  std::vector<PointProperty> properties = table.properties;
  std::string header = "ply\nformat binary_little_endian 1.0\n";
  if (table.splats_alone) {
    header += splat_remarks(table.scene);
    add_words(table.scene, properties);
  }
  if (!table.scene.crs.empty()) add_remark(header, "crs " + table.scene.crs);
  header += "element vertex " + std::to_string(table.size) +
            "\nproperty double x\nproperty double y\nproperty double z\n";
  for (const PointProperty& property : properties)
    header += std::string("property ") + TYPES[static_cast<std::size_t>(property.type)] + ' ' +
              property.name + '\n';
  out.write(header + "end_header\n");
  out.write_rows([&](std::size_t i, std::string& row) {
    const glm::dvec3 position = table.position(i);
    for (int axis = 0; axis < 3; ++axis) append_value(ValueType::float64, position[axis], row);
    for (const PointProperty& property : properties) append_value(property.type, property.value(i), row);
  });
}

}  // namespace splatray
