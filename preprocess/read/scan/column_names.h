/// What programs call the columns of their points.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace splatray {

/// Names of columns that are no attributes beside the points, as known_columns gives them.
inline constexpr std::string_view COLUMN_AXES[] = {"x", "y", "z"};
inline constexpr std::string_view COLUMN_NORMALS[] = {"nx", "ny", "nz"};
inline constexpr std::string_view COLUMN_COLORS[] = {"red", "green", "blue"};
/// A disc's; known_columns does not know it, as formats of scans alone have none.
inline constexpr std::string_view COLUMN_RADIUS = "radius";

/// Letters and digits alone, in lower case: how names are compared.
[[nodiscard]] std::string plain_name(std::string_view name);

/// For each of these names what it means: one of the arrays above or of columns.h's names (COLUMN_INTENSITY and so on), or
/// "" where it is not known. Of several names with one meaning the plainest has it: "x" before "Easting" and "lon".
/// Prefixes "scalar_" (CloudCompare) and units in brackets do not matter.
[[nodiscard]] std::vector<std::string> known_columns(const std::vector<std::string>& names);

/// Whether the name is one of a longitude or latitude.
[[nodiscard]] bool is_degrees(std::string_view name);

}  // namespace splatray
