#include "preprocess/read/tiles/tile_schema.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "engine/base/srgb.h"
#include "preprocess/base/little_endian.h"
#include "preprocess/read/bytes/byte_reader.h"

namespace splatray {
namespace {

using Json = nlohmann::json;
using Kind = TileField::Kind;

/// The columns that have names of their own in PDAL.
struct KnownColumn {
  std::string_view column, field;
};
constexpr std::array<KnownColumn, 6> KNOWN_COLUMNS{{{COLUMN_INTENSITY, TILE_INTENSITY},
                                                    {COLUMN_CLASS, TILE_CLASS},
                                                    {COLUMN_RETURN, "ReturnNumber"},
                                                    {COLUMN_RETURNS, "NumberOfReturns"},
                                                    {COLUMN_SOURCE, "PointSourceId"},
                                                    {COLUMN_TIME, "GpsTime"}}};

constexpr const char* STATION = "Station";

std::string field_of_column(std::string_view column) {
  for (const KnownColumn& known : KNOWN_COLUMNS)
    if (known.column == column) return std::string(known.field);
  return std::string(column);
}

/// How a column's numbers are stored.
TileField field_of(const Column& column) {
  const auto type = std::visit(
      [](const auto& list) {
        using Number = typename std::decay_t<decltype(list)>::value_type;
        return std::pair(std::is_integral_v<Number> ? Kind::unsigned_integer : Kind::floating,
                         sizeof(Number));
      },
      column.values);
  return {.name = field_of_column(column.name), .kind = type.first, .bytes = type.second};
}

std::string_view name_of(Kind kind) {
  return kind == Kind::floating ? "float" : kind == Kind::signed_integer ? "signed" : "unsigned";
}

/// Calls f with a number of the field's type.
template <typename F>
auto with_number(const TileField& field, const F& f) {
  if (field.kind == Kind::floating) return field.bytes == 4 ? f(float{}) : f(double{});
  const bool is_signed = field.kind == Kind::signed_integer;
  switch (field.bytes) {
    case 1:
      return is_signed ? f(std::int8_t{}) : f(std::uint8_t{});
    case 2:
      return is_signed ? f(std::int16_t{}) : f(std::uint16_t{});
    case 4:
      return is_signed ? f(std::int32_t{}) : f(std::uint32_t{});
    default:
      return is_signed ? f(std::int64_t{}) : f(std::uint64_t{});
  }
}

/// The nearest number of a type below the value or at it; 0 for what is none.
template <typename Number>
Number narrowed(double value) {
  if constexpr (std::is_integral_v<Number>) {
    constexpr auto LEAST = std::numeric_limits<Number>::lowest(), MOST = std::numeric_limits<Number>::max();
    if (std::isnan(value)) return 0;
    if (value <= static_cast<double>(LEAST)) return LEAST;
    if (value >= static_cast<double>(MOST)) return MOST;
  }
  return static_cast<Number>(value);
}

/// No values, of the narrowest type that a column has for the field's numbers.
Column::Values empty_values(const TileField& field) {
  const bool is_scaled = field.scale != 1.0 || field.offset != 0.0;
  if (field.kind == Kind::unsigned_integer && field.bytes == 1 && !is_scaled)
    return std::vector<std::uint8_t>{};
  if (field.kind == Kind::unsigned_integer && field.bytes == 2 && !is_scaled)
    return std::vector<std::uint16_t>{};
  const bool fits_float = field.kind == Kind::floating ? field.bytes == 4 : field.bytes <= 2;
  return fits_float ? Column::Values(Pool<float>()) : Column::Values(Pool<double>());
}

/// The columns that records give, empty, and the field of each.
std::vector<Column> empty_columns(const TileSchema& schema, const std::vector<std::string>& asked,
                                  std::vector<const TileField*>& fields) {
  std::vector<Column> columns;
  const auto add = [&](std::string_view column, const TileField* field) {
    if (field == nullptr || std::find(fields.begin(), fields.end(), field) != fields.end() ||
        find_column(columns, column) != nullptr)
      return;
    columns.push_back({std::string(column), empty_values(*field)});
    fields.push_back(field);
  };
  for (const KnownColumn& known : KNOWN_COLUMNS) add(known.column, schema.find(known.field));
  for (const std::string& name : asked) add(name, schema.find(name));
  add(COLUMN_POINT_COUNT, schema.count());
  return columns;
}

/// Whether a record is left out, which is counted then.
class Unwanted {
 public:
  Unwanted(const TileSchema& schema, bool keep_all)
      : class_(keep_all ? nullptr : schema.find(TILE_CLASS)),
        withheld_(keep_all ? nullptr : schema.find(TILE_WITHHELD)) {}

  bool is(const unsigned char* record, ScanCounts& counts) const {
    if (withheld_ != nullptr && withheld_->value(record) != 0.0) return ++counts.withheld, true;
    if (class_ == nullptr || !is_noise_class(class_->value(record))) return false;
    return ++counts.noise, true;
  }

 private:
  const TileField* class_;
  const TileField* withheld_;
};

/// The stored colour of a point, in 16 bits.
glm::dvec3 stored_colour(const Points& points, std::size_t i) {
  if (!points.stored_color.empty()) return points.stored_color[i];
  return glm::round(65535.0 * glm::dvec3(linear_to_srgb(points.color[i])));
}

}  // namespace

double TileField::value(const unsigned char* record) const {
  return with_number(*this, [&](auto number) {
    return scale * static_cast<double>(load<decltype(number)>(record + at)) + offset;
  });
}

void TileField::store(double value, unsigned char* record) const {
  with_number(*this, [&](auto number) {
    const double stored = (value - offset) / scale;
    const auto stored_number =
        narrowed<decltype(number)>(kind == Kind::floating ? stored : std::round(stored));
    std::copy_n(reinterpret_cast<const unsigned char*>(&stored_number), sizeof stored_number, record + at);
  });
}

void TileSchema::add(TileField field) {
  field.at = record_bytes;
  record_bytes += field.bytes;
  fields.push_back(std::move(field));
}

const TileField* TileSchema::find(std::string_view name) const {
  const auto found =
      std::find_if(fields.begin(), fields.end(), [&](const TileField& field) { return field.name == name; });
  return found == fields.end() ? nullptr : &*found;
}

glm::dvec3 TileSchema::position(const unsigned char* record) const {
  return tile_values(tile_fields(*this, TILE_PLACE), record);
}

TileFields tile_fields(const TileSchema& schema, const std::array<const char*, 3>& names) {
  TileFields fields{};
  for (std::size_t i = 0; i < 3; ++i) fields[i] = schema.find(names[i]);
  return std::find(fields.begin(), fields.end(), nullptr) == fields.end() ? fields : TileFields{};
}

glm::dvec3 tile_values(const TileFields& fields, const unsigned char* record) {
  return {fields[0]->value(record), fields[1]->value(record), fields[2]->value(record)};
}

TileSchema tile_means_schema(TileSchema schema) {
  schema.add({.name = COLUMN_POINT_COUNT, .bytes = 4});
  schema.is_of_means = true;
  return schema;
}

bool is_noise_class(double number) {
  constexpr double LOW_NOISE = 7.0, HIGH_NOISE = 18.0;
  return number == LOW_NOISE || number == HIGH_NOISE;
}

TileSchema read_tile_schema(const Json& schema, const std::filesystem::path& path) {
  TileSchema read;
  for (const Json& entry : schema.is_array() ? schema : Json::array()) {
    const auto text = [&](const char* name) {
      const Json value = entry.is_object() ? entry.value(name, Json()) : Json();
      return value.is_string() ? value.get<std::string>() : std::string();
    };
    const auto number = [&](const char* name, double absent) {
      const Json value = entry.is_object() ? entry.value(name, Json()) : Json();
      return value.is_number() ? value.get<double>() : absent;
    };
    const std::string type = text("type");
    const double size = number("size", 0.0);
    TileField field{.name = text("name"),
                    .kind = type == "float"    ? Kind::floating
                            : type == "signed" ? Kind::signed_integer
                                               : Kind::unsigned_integer,
                    .bytes = size >= 1.0 && size <= 8.0 ? static_cast<std::size_t>(size) : 0,
                    .scale = number("scale", 1.0),
                    .offset = number("offset", 0.0)};
    const bool has_size = field.kind == Kind::floating ? field.bytes == 4 || field.bytes == 8
                                                       : field.bytes != 0 && std::has_single_bit(field.bytes);
    const bool is_known = type == "float" || type == "signed" || type == "unsigned";
    if (field.name.empty() || !is_known || !has_size || !std::isfinite(field.offset) ||
        !std::isnormal(field.scale))
      throw_unreadable(path,
                       "found in its schema " + entry.dump() +
                           ", expected a name, a type (signed, unsigned, float) and a size of 1 to 8 bytes");
    read.add(std::move(field));
  }
  if (tile_fields(read, TILE_PLACE)[0] == nullptr)
    throw_unreadable(path, "found a schema without X, Y and Z, expected them for binary tiles");
  return read;
}

Json tile_schema_json(const TileSchema& schema) {
  Json json = Json::array();
  for (const TileField& field : schema.fields) {
    Json entry{{"name", field.name}, {"type", name_of(field.kind)}, {"size", field.bytes}};
    if (field.scale != 1.0) entry["scale"] = field.scale;
    if (field.offset != 0.0) entry["offset"] = field.offset;
    json.push_back(std::move(entry));
  }
  return json;
}

TileSchema tile_schema_of(const Points& points, const glm::dvec3& step_world,
                          const glm::dvec3& origin_world) {
  TileSchema schema;
  for (int axis = 0; axis < 3; ++axis) {
    TileField field{.name = TILE_PLACE[static_cast<std::size_t>(axis)], .kind = Kind::floating, .bytes = 8};
    if (step_world[axis] > 0.0)
      field = {field.name, Kind::signed_integer, 4, step_world[axis], origin_world[axis]};
    schema.add(std::move(field));
  }
  if (!points.stored_color.empty() || !points.color.empty())
    for (const char* name : TILE_COLOUR) schema.add({.name = name, .bytes = 2});
  if (!points.normal.empty())
    for (const char* name : TILE_NORMAL) schema.add({.name = name, .kind = Kind::floating, .bytes = 4});
  if (!points.stations.empty()) schema.add({.name = STATION, .bytes = 2});
  for (const Column& column : points.columns) schema.add(field_of(column));
  return schema;
}

void widen_schema(TileSchema& schema, const TileSchema& more) {
  std::vector<TileField> fields = std::move(schema.fields);
  for (const TileField& field : more.fields) {
    const auto same = std::find_if(fields.begin(), fields.end(),
                                   [&](const TileField& one) { return one.name == field.name; });
    if (same == fields.end())
      fields.push_back(field);
    else if (field.kind > same->kind || (field.kind == same->kind && field.bytes > same->bytes))
      *same = field;
  }
  schema = {};
  for (TileField& field : fields) schema.add(std::move(field));
}

void append_records(const Points& points, const TileSchema& schema, std::size_t first_station,
                    std::vector<unsigned char>& records) {
  const std::size_t begin = records.size(), stride = schema.record_bytes;
  records.resize(begin + points.size() * stride);
  const auto store = [&](const TileField* field, const auto& value_of) {
    for (std::size_t i = 0; field != nullptr && i < points.size(); ++i)
      field->store(value_of(i), records.data() + begin + i * stride);
  };
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    store(schema.find(TILE_PLACE[a]), [&](std::size_t i) { return points.position[i][axis]; });
    if (!points.stored_color.empty() || !points.color.empty())
      store(schema.find(TILE_COLOUR[a]), [&](std::size_t i) { return stored_colour(points, i)[axis]; });
    if (!points.normal.empty())
      store(schema.find(TILE_NORMAL[a]), [&](std::size_t i) { return double(points.normal[i][axis]); });
  }
  store(schema.find(STATION), [&](std::size_t i) {
    return static_cast<double>(first_station + (points.station.empty() ? 0 : points.station[i]));
  });
  for (const Column& column : points.columns)
    store(schema.find(field_of_column(column.name)), [&](std::size_t i) { return column.number(i); });
}

Points points_of_records(std::span<const unsigned char> records, const TileSchema& schema,
                         const ScanOptions& options, ScanCounts& counts) {
  const auto place = tile_fields(schema, TILE_PLACE), colour = tile_fields(schema, TILE_COLOUR),
             normal = tile_fields(schema, TILE_NORMAL);
  const TileField* const station = schema.find(STATION);
  const Unwanted unwanted(schema, options.keep_withheld);
  Points points;
  std::vector<const TileField*> fields;
  points.columns = empty_columns(schema, options.attributes, fields);
  const std::size_t count = records.size() / schema.record_bytes;
  points.position.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const unsigned char* record = records.data() + i * schema.record_bytes;
    if (unwanted.is(record, counts)) continue;
    const glm::dvec3 position = tile_values(place, record);
    if (!std::isfinite(glm::dot(position, glm::dvec3(1.0)))) {
      ++counts.no_return;
      continue;
    }
    points.position.push_back(position);
    if (colour[0] != nullptr) {
      const glm::dvec3 stored = tile_values(colour, record);
      points.stored_color.emplace_back(narrowed<std::uint16_t>(stored.x), narrowed<std::uint16_t>(stored.y),
                                       narrowed<std::uint16_t>(stored.z));
    }
    if (normal[0] != nullptr) points.normal.emplace_back(glm::vec3(tile_values(normal, record)));
    if (station != nullptr) points.station.push_back(narrowed<std::uint16_t>(station->value(record)));
    if (schema.is_of_means) points.mean_of.push_back(narrowed<std::uint32_t>(schema.count()->value(record)));
    for (std::size_t c = 0; c < fields.size(); ++c)
      edit_values(points.columns[c], [&](auto& list) {
        using Number = typename std::decay_t<decltype(list)>::value_type;
        list.push_back(narrowed<Number>(fields[c]->value(record)));
      });
  }
  counts.stored += count;
  return points;
}

}  // namespace splatray
