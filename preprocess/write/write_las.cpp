#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/base/crs.h"
#include "engine/base/error.h"
#include "engine/base/number_text.h"
#include "preprocess/base/bounds.h"
#include "preprocess/base/little_endian.h"
#include "preprocess/write/point_output.h"

// ASPRS, LAS Specification 1.4 R15.

namespace splatray {
namespace {

constexpr std::size_t LAS_1_4_HEADER_BYTES = 375;
constexpr std::size_t RETURNS = 15;  // counted by the header
constexpr std::size_t MOST_VLR_BYTES = 65535;
constexpr std::size_t NAME_BYTES = 32;

template <typename Number>
void append_number(Number number, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

void append_text(std::string text, std::size_t size, std::string& bytes) {
  text.resize(size, '\0');
  bytes += text;
}

/// A field of the format's own records and the largest number that it holds.
struct LasField {
  std::string_view property;
  double most;
};

/// Fields in the order of Fields::own.
enum OwnField : std::size_t {
  INTENSITY,
  RETURN,
  RETURNS_OF_PULSE,
  CLASS,
  SOURCE,
  TIME,
  RED,
  GREEN,
  BLUE,
  OWN_FIELDS
};
constexpr LasField OWN[OWN_FIELDS] = {{COLUMN_INTENSITY, 65535.0},
                                      {COLUMN_RETURN, 15.0},
                                      {COLUMN_RETURNS, 15.0},
                                      {COLUMN_CLASS, 255.0},
                                      {COLUMN_SOURCE, 65535.0},
                                      {COLUMN_TIME, INFINITY},
                                      {"red", 65535.0},
                                      {"green", 65535.0},
                                      {"blue", 65535.0}};

/// Whether a field holds all values exactly.
bool holds(const LasField& field, const PointProperty& property, std::size_t points) {
  if (field.most == INFINITY) return true;
  for (std::size_t i = 0; i < points; ++i) {
    const double value = property.value(i);
    if (!(value >= 0.0 && value <= field.most && value == std::floor(value))) return false;
  }
  return true;
}

/// Where each property goes.
struct Fields {
  std::array<const PointProperty*, OWN_FIELDS> own{};
  std::vector<const PointProperty*> extra;

  explicit Fields(const PointTable& table) {
    for (const PointProperty& property : table.properties) {
      const auto field = std::find_if(std::begin(OWN), std::end(OWN),
                                      [&](const LasField& one) { return one.property == property.name; });
      if (field != std::end(OWN) && holds(*field, property, table.size))
        own[static_cast<std::size_t>(field - std::begin(OWN))] = &property;
      else
        extra.push_back(&property);
    }
  }
  [[nodiscard]] bool has_colors() const { return own[RED] != nullptr; }
  [[nodiscard]] double value(OwnField field, std::size_t i, double absent = 0.0) const {
    return own[field] == nullptr ? absent : own[field]->value(i);
  }
  /// LAS has 16 bits a channel; those of 8 are multiplied, as the specification asks for.
  [[nodiscard]] std::uint16_t color(OwnField field, std::size_t i) const {
    const bool is_narrow = own[field]->type == ValueType::uint8;
    return static_cast<std::uint16_t>(own[field]->value(i) * (is_narrow ? 257.0 : 1.0));
  }
  [[nodiscard]] std::size_t record_bytes() const {
    std::size_t bytes = has_colors() ? 36 : 30;
    for (const PointProperty* property : extra) bytes += bytes_of(property->type);
    return bytes;
  }
};

glm::ivec3 stored_place(const PointTable& table, std::size_t i) {
  const RootTransform& root = table.scene.root;
  const glm::dvec3 place = glm::round(root.to_root(table.position(i)));
  constexpr double MOST = std::numeric_limits<std::int32_t>::max();
  if (glm::all(glm::lessThanEqual(glm::abs(place), glm::dvec3(MOST)))) return glm::ivec3(place);
  throw Error(ExitCode::failed, "found a point at " + number_text(table.position(i), ' ') +
                                    ", which LAS cannot hold beside coordinates in steps of " +
                                    number_text(root.unit_world) + "; a .ply holds it");
}

/// A record beside the points; `Size` is the type of its length, 16 bits before them, 64 behind.
template <typename Size>
std::string record(const std::string& user, std::uint16_t id, const std::string& content) {
  std::string bytes;
  append_number(std::uint16_t{0}, bytes);
  append_text(user, 16, bytes);
  append_number(id, bytes);
  append_number(static_cast<Size>(content.size()), bytes);
  append_text("", 32, bytes);
  return bytes + content;
}
constexpr auto vlr = record<std::uint16_t>;
constexpr auto evlr = record<std::uint64_t>;

std::string extra_bytes_vlr(const std::vector<const PointProperty*>& extra) {
  constexpr std::uint8_t TYPES[] = {1, 3, 5, 9, 10};
  constexpr std::size_t DESCRIPTOR_BYTES = 192;
  std::string content;
  for (const PointProperty* property : extra) {
    std::string one(2, '\0');
    append_number(TYPES[static_cast<std::size_t>(property->type)], one);
    one += '\0';
    const std::string& name = property->name;
    const bool is_normal = name == "nx" || name == "ny" || name == "nz";  // as other programs name them
    append_text(is_normal ? std::string("Normal") + static_cast<char>(std::toupper(name[1])) : name,
                NAME_BYTES, one);
    append_text(one, DESCRIPTOR_BYTES, content);
  }
  return vlr("LASF_Spec", 4, content);
}

/// GeoTIFF's keys for a system that is known by EPSG's numbers.
std::string geo_keys_vlr(const Crs& crs) {
  const std::array<std::uint16_t, 2> keys[] = {
      {1024, static_cast<std::uint16_t>(crs.is_degrees ? 2 : 1)},
      {2048, static_cast<std::uint16_t>(crs.is_degrees ? crs.epsg : 0)},
      {3072, static_cast<std::uint16_t>(crs.is_degrees ? 0 : crs.epsg)},
      {3076, epsg_unit(crs.horizontal_metres)},
      {4096, static_cast<std::uint16_t>(crs.vertical_epsg)},
      {4099, epsg_unit(crs.vertical_metres)}};
  std::string content;
  std::uint16_t count = 0;
  for (const auto& [key, value] : keys) {
    if (value == 0) continue;
    for (const std::uint16_t number : {key, std::uint16_t{0}, std::uint16_t{1}, value})
      append_number(number, content);
    ++count;
  }
  std::string head;
  for (const std::uint16_t number : {std::uint16_t{1}, std::uint16_t{1}, std::uint16_t{0}, count})
    append_number(number, head);
  return vlr("LASF_Projection", 34735, head + content);
}

/// What the header counts and bounds.
struct LasSums {
  Bounds box;
  std::array<std::uint64_t, RETURNS> by_return{};
  bool late_times = false;  ///< beyond a week: they are not seconds of one

  LasSums(const PointTable& table, const Fields& fields) {
    constexpr double WEEK = 604800.0;
    const RootTransform& root = table.scene.root;
    for (std::size_t i = 0; i < table.size; ++i) {
      box.add(root.to_world(glm::dvec3(stored_place(table, i))));
      const auto number = static_cast<std::size_t>(fields.value(RETURN, i, 1.0));
      if (number >= 1 && number <= RETURNS) ++by_return[number - 1];
      late_times = late_times || fields.value(TIME, i) > WEEK;
    }
  }
};

/// The header; `vlrs` and records of `record_bytes` follow it.
std::string header_of(const PointTable& table, const Fields& fields, const LasSums& sums,
                      const std::vector<std::string>& vlrs, bool has_evlr, bool has_wkt) {
  std::uint64_t points_at = LAS_1_4_HEADER_BYTES;
  for (const std::string& one : vlrs) points_at += one.size();
  std::string bytes = "LASF";
  append_number(std::uint16_t{0}, bytes);
  append_number(static_cast<std::uint16_t>((sums.late_times ? 1 : 0) | (has_wkt ? 16 : 0)), bytes);
  append_text("", 16, bytes);
  bytes += {1, 4};
  append_text("EXTRACTION", NAME_BYTES, bytes);
  append_text("splatray", NAME_BYTES, bytes);
  append_number(std::uint32_t{0}, bytes);  // no day, so that the same points are the same bytes
  append_number(static_cast<std::uint16_t>(LAS_1_4_HEADER_BYTES), bytes);
  append_number(static_cast<std::uint32_t>(points_at), bytes);
  append_number(static_cast<std::uint32_t>(vlrs.size()), bytes);
  append_number(static_cast<std::uint8_t>(fields.has_colors() ? 7 : 6), bytes);
  append_number(static_cast<std::uint16_t>(fields.record_bytes()), bytes);
  append_text("", 24, bytes);  // counts of before 1.4
  const RootTransform& root = table.scene.root;
  for (int axis = 0; axis < 3; ++axis) append_number(root.unit_world, bytes);
  for (int axis = 0; axis < 3; ++axis) append_number(root.origin_world[axis], bytes);
  for (int axis = 0; axis < 3; ++axis)
    append_number(sums.box.high[axis], bytes), append_number(sums.box.low[axis], bytes);
  append_number(std::uint64_t{0}, bytes);
  append_number(has_evlr ? points_at + table.size * fields.record_bytes() : std::uint64_t{0}, bytes);
  append_number(std::uint32_t{has_evlr ? 1U : 0U}, bytes);
  append_number(std::uint64_t{table.size}, bytes);
  for (const std::uint64_t count : sums.by_return) append_number(count, bytes);
  return bytes;
}

void append_record(const PointTable& table, const Fields& fields, std::size_t i, std::string& row) {
  const glm::ivec3 place = stored_place(table, i);
  for (int axis = 0; axis < 3; ++axis) append_number(std::int32_t{place[axis]}, row);
  append_number(static_cast<std::uint16_t>(fields.value(INTENSITY, i)), row);
  const auto number = static_cast<unsigned>(fields.value(RETURN, i, 1.0));
  const auto count = static_cast<unsigned>(fields.value(RETURNS_OF_PULSE, i, 1.0));
  append_number(static_cast<std::uint8_t>(number | count << 4U), row);
  append_number(std::uint8_t{0}, row);
  append_number(static_cast<std::uint8_t>(fields.value(CLASS, i)), row);
  append_text("", 3, row);  // user data and scan angle
  append_number(static_cast<std::uint16_t>(fields.value(SOURCE, i)), row);
  append_number(fields.value(TIME, i), row);
  if (fields.has_colors())
    for (const OwnField channel : {RED, GREEN, BLUE}) append_number(fields.color(channel, i), row);
  for (const PointProperty* property : fields.extra) append_value(property->type, property->value(i), row);
}

}  // namespace

void write_las(const PointTable& table, PointOutput& out) {
  const Fields fields(table);
  const LasSums sums(table, fields);
  std::vector<std::string> vlrs = {extra_bytes_vlr(fields.extra)};
  std::string behind;
  const std::string& text = table.scene.crs;
  const Crs crs = describe_crs(text);
  const bool has_wkt = !text.empty() && !text.starts_with("EPSG:");
  if (has_wkt && text.size() < MOST_VLR_BYTES)
    vlrs.push_back(vlr("LASF_Projection", 2112, text + '\0'));
  else if (has_wkt)
    behind = evlr("LASF_Projection", 2112, text + '\0');
  else if (crs.epsg != 0)
    vlrs.push_back(geo_keys_vlr(crs));
  out.write(header_of(table, fields, sums, vlrs, !behind.empty(), has_wkt));
  for (const std::string& one : vlrs) out.write(one);
  out.write_rows([&](std::size_t i, std::string& row) { append_record(table, fields, i, row); });
  if (!behind.empty()) out.write(behind);
}

}  // namespace splatray
