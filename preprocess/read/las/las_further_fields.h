/// Fields of LAS files' records that few ask for (ASPRS, LAS Specification 1.4 R15, section 2.6).
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "preprocess/read/las/las_extra_bytes.h"

namespace splatray {

/// The field that records of a point format have under a name, as LAS's specification, laspy or PDAL call it, whatever its case:
/// user_data, scan_angle (degrees), scan_direction_flag, edge_of_flight_line, synthetic, key_point, withheld, from format 6 on
/// overlap and scanner_channel, in 8 and 10 nir. It is called `name`. Nothing where they have none such.
[[nodiscard]] std::optional<LasExtraBytes> las_further_field(unsigned point_format, const std::string& name);

/// The names of all of them.
[[nodiscard]] std::vector<std::string> las_further_names(unsigned point_format);

}  // namespace splatray
