/// What columns without names are.
#pragma once
#include <string>
#include <vector>

namespace splatray {

/// The meanings of the columns behind x, y and z by their number and their values: 1 intensity; 3 colours or normals; 4
/// intensity and colours; 6 colours and normals in either order; 7 intensity and these. Three columns are normals where
/// nine of ten have the length 1, colours where they are whole numbers up to 65535 or fractions up to 1. Beside `columns`,
/// by known_columns' names, "" = not known. What was taken for granted goes to `notes`.
[[nodiscard]] std::vector<std::string> guess_columns(const std::vector<const std::vector<float>*>& columns,
                                                     std::vector<std::string>& notes);

}  // namespace splatray
