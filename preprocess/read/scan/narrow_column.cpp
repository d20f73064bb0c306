#include "preprocess/read/scan/narrow_column.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>

namespace splatray {
namespace {

template <typename Value>
bool all_fit(const std::vector<double>& values, double least, double most) {
  return std::all_of(values.begin(), values.end(), [&](double v) {
    if (std::isnan(v)) return std::is_floating_point_v<Value>;
    return v >= least && v <= most && static_cast<double>(static_cast<Value>(v)) == v;
  });
}

template <typename Value>
std::vector<Value> narrowed(const std::vector<double>& values) {
  std::vector<Value> list(values.size());
  std::transform(values.begin(), values.end(), list.begin(), [](double v) { return static_cast<Value>(v); });
  return list;
}

}  // namespace

Column narrow_column(std::string_view name, std::vector<double> values) {
  constexpr double MOST_FLOAT = 3.4028234663852886e38;
  const bool may_be_unknown = name == COLUMN_CHANGE;
  for (double& value : values)
    if (!std::isfinite(value)) value = may_be_unknown ? std::nan("") : 0.0;
  Column column{std::string(name), {}};
  if (all_fit<std::uint8_t>(values, 0.0, 255.0)) {
    column.values = narrowed<std::uint8_t>(values);
  } else if (all_fit<std::uint16_t>(values, 0.0, 65535.0)) {
    column.values = narrowed<std::uint16_t>(values);
  } else if (all_fit<float>(values, -MOST_FLOAT, MOST_FLOAT)) {
    column.values = narrowed<float>(values);
  } else {
    column.values = std::move(values);
  }
  return column;
}

}  // namespace splatray
