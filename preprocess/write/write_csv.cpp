#include "engine/base/number_text.h"
#include "preprocess/write/point_output.h"

namespace splatray {
namespace {

std::string value_text(ValueType type, double number) {
  return type == ValueType::float32 ? number_text(static_cast<float>(number)) : number_text(number);
}

}  // namespace

void write_csv(const PointTable& table, PointOutput& out) {
  std::string names = "x,y,z";
  for (const PointProperty& property : table.properties) names += ',' + property.name;
  out.write(names + '\n');
  out.write_rows([&](std::size_t i, std::string& row) {
    row += number_text(table.position(i));
    for (const PointProperty& property : table.properties)
      row += ',' + value_text(property.type, property.value(i));
    row += '\n';
  });
}

}  // namespace splatray
