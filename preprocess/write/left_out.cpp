#include "preprocess/write/left_out.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "engine/scene/splat.h"
#include "preprocess/base/append.h"
#include "preprocess/base/parallel.h"
#include "preprocess/base/select.h"

namespace splatray {
namespace {

const std::string NUMBER(COLUMN_INPUT_NUMBER);

}  // namespace

LeftOutPoints::LeftOutPoints(Input& input) {
  for (InputObject& object : input.objects) {
    Points& points = object.points;
    const std::size_t before = all_.position.size();
    append_columns(all_.columns, before, std::vector<Column>(points.columns), points.size());
    std::vector<std::uint32_t> colors;
    for (const glm::vec3& color : points.color) colors.push_back(pack_color(color));
    append(all_.color, before, std::move(colors), points.size(), pack_color(glm::vec3(1.0F)));
    all_.position.insert(all_.position.end(), points.position.begin(), points.position.end());
    std::vector<double> numbers(points.size());
    std::iota(numbers.begin(), numbers.end(), static_cast<double>(before) + 1.0);
    points.columns.push_back({NUMBER, std::move(numbers)});
  }
}

LeftOut LeftOutPoints::take(Scene& scene) && {
  std::vector<bool> used(all_.position.size() + 1, false);  // by number; 0 is no point of the input
  if (const Column* number = find_column(scene.columns, NUMBER))
    for (std::size_t i = 0; i < number->size(); ++i) used[static_cast<std::size_t>(number->number(i))] = true;
  std::erase_if(scene.columns, [](const Column& column) { return column.name == NUMBER; });
  const auto left = numbers_where(all_.position.size(), [&](std::size_t i) {
    return !used[i + 1] && glm::dot(all_.position[i], all_.position[i]) < INFINITY;
  });
  LeftOut taken{gather(all_.position, left), gather(all_.color, left), std::move(all_.columns)};
  for (Column& column : taken.columns)
    edit_values(column, [&](auto& values) { values = gather(values, left); });
  return taken;
}

}  // namespace splatray
