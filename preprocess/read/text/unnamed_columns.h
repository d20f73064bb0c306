/// What columns without names are.
#pragma once
#include <string>
#include <vector>

namespace splatray {

/// Whether nine of ten of three columns' values, from the column `first` on, are normals: of the length 1.
[[nodiscard]] bool are_normals(const std::vector<const std::vector<float>*>& columns, std::size_t first);

/// Which of a number of columns that are triples but for one is an intensity.
struct IntensityPlace {
  std::size_t column = 0;
  bool is_sure = true;  ///< the values of the others speak against every other place
};

/// The place before, between or behind the triples where these are known best: as normals, as colours of 8 bits, as others. Where several
/// are as good it is the first.
[[nodiscard]] IntensityPlace find_intensity(const std::vector<const std::vector<float>*>& columns);

/// The meanings of the columns behind x, y and z by their number and their values: 1 intensity; 3 colours or normals; 6 colours
/// and normals in either order; 4 and 7 these and intensity where find_intensity() has it. Three columns are normals where
/// are_normals() says so, colours where none is below 0 and they are whole numbers up to 65535 or fractions up to 1. Beside `columns`,
/// by known_columns' names, "" = not known. What was taken for granted goes to `notes`.
[[nodiscard]] std::vector<std::string> guess_columns(const std::vector<const std::vector<float>*>& columns,
                                                     std::vector<std::string>& notes);

}  // namespace splatray
