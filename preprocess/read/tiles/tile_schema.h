/// Records of points as binary tiles hold them (Entwine Point Tile 1.0, "schema" and the data type "binary").
#pragma once
#include <array>
#include <cstddef>
#include <filesystem>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "preprocess/base/levels.h"
#include "preprocess/points.h"

namespace splatray {

/// Fields by PDAL's names, of which means are made (levels/level_means.h).
inline constexpr std::array<const char*, 3> TILE_PLACE{"X", "Y", "Z"}, TILE_COLOUR{"Red", "Green", "Blue"},
    TILE_NORMAL{"NormalX", "NormalY", "NormalZ"};
inline constexpr const char* TILE_INTENSITY = "Intensity";
inline constexpr const char* TILE_CLASS = "Classification";
inline constexpr const char* TILE_WITHHELD = "Withheld";

/// One number of a record: value = scale * number + offset.
struct TileField {
  enum class Kind : std::uint8_t { signed_integer, unsigned_integer, floating };

  std::string name;  ///< as PDAL names dimensions: X, Y, Z, Intensity, Red, NormalX, or any other
  Kind kind = Kind::unsigned_integer;
  std::size_t bytes = 0;  ///< 1, 2, 4 or 8
  double scale = 1.0, offset = 0.0;
  std::size_t at = 0;  ///< bytes from the record's begin

  [[nodiscard]] double value(const unsigned char* record) const;
  /// Stores the nearest number that the field holds.
  void store(double value, unsigned char* record) const;
};

struct TileSchema {
  std::vector<TileField> fields;
  std::size_t record_bytes = 0;
  bool is_of_means = false;  ///< as tile_means_schema made it

  /// Appends a field behind the others.
  void add(TileField field);
  /// nullptr where there is none of this name.
  [[nodiscard]] const TileField* find(std::string_view name) const;
  /// How many points a mean is of, whatever fields of points are called; nullptr of records of points.
  [[nodiscard]] const TileField* count() const { return is_of_means ? &fields.back() : nullptr; }
  /// A record's position.
  [[nodiscard]] glm::dvec3 position(const unsigned char* record) const;
};

/// The fields of these names, or nothing where one is missing; and their values.
using TileFields = std::array<const TileField*, 3>;
[[nodiscard]] TileFields tile_fields(const TileSchema& schema, const std::array<const char*, 3>& names);
[[nodiscard]] glm::dvec3 tile_values(const TileFields& fields, const unsigned char* record);

/// The schema of means of such records of points: these and a count behind them.
[[nodiscard]] TileSchema tile_means_schema(TileSchema schema);

/// Whether a class is one of noise, whose points are left out (LAS 1.4, 7 and 18).
[[nodiscard]] bool is_noise_class(double number);

/// Reads the member "schema" of the ept.json at `path`. Throws Error (input_unreadable), one sentence, for numbers of other sizes, and
/// where X, Y or Z is missing.
[[nodiscard]] TileSchema read_tile_schema(const nlohmann::json& schema, const std::filesystem::path& path);
[[nodiscard]] nlohmann::json tile_schema_json(const TileSchema& schema);

/// The fields that hold what points have, columns under PDAL's names or their own. Positions are integers in steps of `step_world` from
/// `origin_world` on, or, where that is zero, float64.
[[nodiscard]] TileSchema tile_schema_of(const Points& points, const glm::dvec3& step_world,
                                        const glm::dvec3& origin_world);
/// Appends those that `more` has and `schema` lacks; of those that both have the wider stays.
void widen_schema(TileSchema& schema, const TileSchema& more);

/// Appends the points' records; what points lack is 0. The first of their stations has the number `first_station`.
void append_records(const Points& points, const TileSchema& schema, std::size_t first_station,
                    std::vector<unsigned char>& records);

/// The points of whole records, with those other fields that `options.attributes` names. Points of the classes of noise (7, 18) and
/// withheld ones are left out, and counted, unless options keep them. Points::station is what the field "Station" says, Points::mean_of the
/// count of means, which have the column COLUMN_POINT_COUNT, too.
[[nodiscard]] Points points_of_records(std::span<const unsigned char> records, const TileSchema& schema,
                                       const ScanOptions& options, ScanCounts& counts);

}  // namespace splatray
