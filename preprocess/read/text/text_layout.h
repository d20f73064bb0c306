/// What the first lines of a text file of points say.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/points.h"
#include "preprocess/read/text/row_reader.h"

namespace splatray {

struct TextLayout {
  CellForm form;   ///< cells without a meaning are skipped
  TextPlace data;  ///< where the first row begins
  /// By cell: known_columns' names, COLUMN_RADIUS, an attribute's own, "" = not used; empty = not named.
  std::vector<std::string> columns;
  std::vector<std::string> unused;     ///< names in the header that are not known
  std::optional<std::uint64_t> count;  ///< of points, where a line before them says it
  bool degrees = false;                ///< x and y are a longitude and a latitude
  /// The first cells of the first rows, of columns without names, count them.
  bool numbered = false;
  bool has_more = false;  ///< the first row has more cells than there are names
};

/// Finds comments, a line that counts the points, one that names the columns (also behind # or //) and the form of the rows
/// (cell_form.h). Without names, those of a points3D.txt are COLMAP's where its rows are. Cells beyond the last that has a name are not read.
/// `options.columns` stands for the file's own names; `options.attributes` are kept under the names given there. Throws
/// Error (input_unreadable) where the columns have no x, y and z, and where the first row is none.
[[nodiscard]] TextLayout find_text_layout(const std::filesystem::path& path, const ScanOptions& options);

}  // namespace splatray
