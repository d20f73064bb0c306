/// Which fields of an E57 record are read, and as what (ASTM E2807-11, section 8.4.4).
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/columns.h"
#include "preprocess/points.h"
#include "preprocess/read/e57/description.h"
#include "preprocess/read/e57/scan_colors.h"

namespace splatray {

/// A field's number in the record.
using FieldIndex = std::size_t;

/// A field that becomes an attribute of points.
struct ColumnSource {
  FieldIndex field = 0;
  std::optional<FieldIndex> invalid;  ///< where this field is not 0, the attribute is
  double add = 0.0;                   ///< to the field's value
  Column empty;                       ///< the attribute's name and type
};

struct ScanLayout {
  /// x, y, z; spherical: range, azimuth, elevation (metres, radians).
  std::array<FieldIndex, 3> coordinates{};
  bool is_spherical = false;
  std::optional<FieldIndex> invalid_state;  ///< not 0: no position
  std::optional<std::array<FieldIndex, 3>> colors;
  std::optional<FieldIndex> color_invalid;
  ColorScale color_scale;
  std::optional<std::array<FieldIndex, 3>> normals;
  std::optional<std::array<FieldIndex, 2>> cell;  ///< row and column
  std::vector<ColumnSource> columns;

  /// All fields that are read, each once, ascending.
  [[nodiscard]] std::vector<FieldIndex> fields() const;
};

/// The layout of a scan's records. Of `attributes`, those that are fields are kept as columns; so are intensity and, where
/// pulses have several, returns. A field that cannot be decoded is left out with a sentence in `notes`; where it is a
/// coordinate, or there are none, Error (input_unreadable) is thrown.
[[nodiscard]] ScanLayout find_layout(const E57Scan& scan, const std::vector<std::string>& attributes,
                                     const std::filesystem::path& path, std::vector<std::string>& notes);

}  // namespace splatray
