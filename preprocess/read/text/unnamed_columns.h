/// What columns without names are.
#pragma once
#include <string>
#include <vector>

namespace splatray {

/// Whether nine of ten of three columns' values, from the column `first` on, are normals: of the length 1.
[[nodiscard]] bool are_normals(const std::vector<const std::vector<float>*>& columns, std::size_t first);

/// The meanings of the columns behind x, y and z by their number and their values: 1 intensity; 3 colours or normals; 4
/// intensity and colours; 6 colours and normals in either order; 7 intensity and these. Three columns are normals where
/// are_normals() says so, colours where none is below 0 and they are whole numbers up to 65535 or fractions up to 1. Beside `columns`,
/// by known_columns' names, "" = not known. What was taken for granted goes to `notes`.
[[nodiscard]] std::vector<std::string> guess_columns(const std::vector<const std::vector<float>*>& columns,
                                                     std::vector<std::string>& notes);

}  // namespace splatray
