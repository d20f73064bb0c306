#include "preprocess/read/las/las_further_fields.h"

#include <algorithm>
#include <iterator>
#include <span>
#include <string_view>

#include "preprocess/read/las/las_header.h"
#include "preprocess/read/scan/column_names.h"

namespace splatray {
namespace {

constexpr unsigned U8 = 1, I8 = 2, U16 = 3, I16 = 4;  ///< types of extra bytes
constexpr unsigned ALL_BITS = 0xFF;

struct FurtherField {
  std::string_view name;
  unsigned type;
  std::size_t at;
  unsigned shift = 0, mask = ALL_BITS;
  double scale = 1.0;
};

constexpr FurtherField OLD[] = {
    {"user_data", U8, 17},
    {"scan_angle", I8, 16},
    {"scan_direction_flag", U8, 14, 6, 1},
    {"edge_of_flight_line", U8, 14, 7, 1},
    {"synthetic", U8, 15, 5, 1},
    {"key_point", U8, 15, 6, 1},
    {"withheld", U8, 15, 7, 1},
};
constexpr double ANGLE_STEP = 0.006;  ///< degrees
constexpr FurtherField EXTENDED[] = {
    {"user_data", U8, 17},
    {"scan_angle", I16, 18, 0, ALL_BITS, ANGLE_STEP},
    {"scan_direction_flag", U8, 15, 6, 1},
    {"edge_of_flight_line", U8, 15, 7, 1},
    {"synthetic", U8, 15, 0, 1},
    {"key_point", U8, 15, 1, 1},
    {"withheld", U8, 15, 2, 1},
    {"overlap", U8, 15, 3, 1},
    {"scanner_channel", U8, 15, 4, 3},
    {"nir", U16, 36},
};

std::span<const FurtherField> fields_of(unsigned point_format) {
  constexpr unsigned FIRST_EXTENDED = 6;
  if (point_format < FIRST_EXTENDED) return OLD;
  const std::span<const FurtherField> all(EXTENDED);
  return las_fields(point_format).infrared != 0 ? all : all.first(all.size() - 1);
}

/// How names are compared: without "flag" and "rank" behind, and PDAL's two others as the specification has them.
std::string compared(std::string_view name) {
  std::string plain = plain_name(name);
  for (const std::string_view suffix : {"flag", "rank"})
    if (plain.ends_with(suffix)) plain.resize(plain.size() - suffix.size());
  if (plain == "infrared") return "nir";
  return plain == "scanchannel" ? "scannerchannel" : plain;
}

}  // namespace

std::optional<LasExtraBytes> las_further_field(unsigned point_format, const std::string& name) {
  const std::span<const FurtherField> fields = fields_of(point_format);
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const FurtherField& field) {
    return compared(field.name) == compared(name);
  });
  if (found == fields.end()) return std::nullopt;
  return LasExtraBytes{name, found->type, found->at, found->scale, 0.0, found->shift, found->mask};
}

std::vector<std::string> las_further_names(unsigned point_format) {
  std::vector<std::string> names;
  for (const FurtherField& field : fields_of(point_format)) names.emplace_back(field.name);
  return names;
}

}  // namespace splatray
