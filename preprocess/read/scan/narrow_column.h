/// Attributes in no more bytes than their values need.
#pragma once
#include <string_view>
#include <vector>

#include "engine/scene/columns.h"

namespace splatray {

/// A column of these values, in the first of uint8, uint16, float and double that holds all of them exactly; what is no
/// number is 0, in COLUMN_CHANGE NaN.
[[nodiscard]] Column narrow_column(std::string_view name, std::vector<double> values);

}  // namespace splatray
