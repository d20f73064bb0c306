#include "preprocess/base/splat_marks.h"
#include "preprocess/write/point_output.h"

namespace splatray {

void write_ply(const PointTable& table, PointOutput& out) {
  const char* const TYPES[] = {"uchar", "ushort", "uint", "float", "double"};
  std::vector<PointProperty> properties = table.properties;
  properties.insert(properties.end(), table.words.begin(), table.words.end());
  std::string header = "ply\nformat binary_little_endian 1.0\n";
  for (const SplatMark& mark : splat_marks(table.scene, table.splats_alone))
    header += "comment " + mark.key + ' ' + mark.text + '\n';
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
