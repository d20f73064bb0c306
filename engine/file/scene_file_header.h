/// The bytes that scene_file.h draws: header, section table and records.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <iterator>
#include <variant>

#include "engine/file/scene_file.h"
#include "engine/scene/pool_table.h"
#include "engine/scene/scene.h"

namespace splatray::scene_file {

inline constexpr char MAGIC[] = {'S', 'O', 'C', 'T'};
inline constexpr char END_MARKER[] = {'S', 'O', 'C', 'T', '.', 'E', 'N', 'D'};
inline constexpr std::uint32_t ENDIANNESS = 0x01020304;
inline constexpr std::uint64_t ALIGNMENT = 16;

/// Behind those of the pools, which have the numbers of their rows in POOL_TABLE.
enum SectionId : std::uint32_t {
  MATERIALS = SCENE_POOLS,
  LIGHTS,
  CAMERA,
  STATIONS,
  STRINGS,
  SURFACES,
  COLUMNS,
  SECTION_COUNT = COLUMNS + COLUMNS_MOST
};

struct SectionEntry {
  std::uint32_t id, element_size;
  std::uint64_t offset, size, checksum;
};

struct Header {
  char magic[4];
  std::uint32_t version, endianness, header_size;
  std::uint64_t file_size, checksum;
  std::uint64_t splats, references, nodes, leaves;
  std::uint32_t objects, lights, attributes, has_camera;
  std::uint64_t string_bytes;
  RootTransform root;
  std::uint32_t leaf_size, insertion, probes, radius_rule;
  double radius_scale;
  std::uint64_t samples, seed;
  glm::dvec3 up, bounds_min, bounds_max;
  double surface_area;
  std::uint32_t stations, surfaces;
  std::uint8_t column_types[COLUMNS_MOST];  ///< 1 + index in Column::Values; 0 = no column
  std::uint32_t section_count, section_entry_size;
  SectionEntry sections[SECTION_COUNT];
};

struct LightRecord {
  std::uint32_t kind, zero_0;
  glm::dvec3 position;
  glm::vec3 power;
  std::uint32_t zero_1;
};

/// That of version 11.
struct SizedLightRecord {
  LightRecord light;
  double size;
  glm::dvec3 edge_u, edge_v;
};

/// That of version 12.
struct AimedLightRecord {
  SizedLightRecord light;
  glm::dvec3 spot_axis;
  double spot_inner, spot_outer, range;
};

/// Scenes' own cameras have no lens shift and square pixels.
struct CameraRecord {
  glm::dvec3 eye, target, up;
  double fov_y_deg, ortho_height;
};

struct StationRecord {
  glm::dvec3 sensor;
  std::uint32_t has_sensor, rows, columns, zero;
};

/// That of version 14.
struct MeasuredStationRecord {
  StationRecord station;
  double noise_world, step_world;
};

inline constexpr std::uint32_t HEADER_BYTES = sizeof(Header);
static_assert(HEADER_BYTES == 1760 && sizeof(LightRecord) == 48 && sizeof(SizedLightRecord) == 104 &&
              sizeof(AimedLightRecord) == 152 && sizeof(CameraRecord) == 88 && sizeof(StationRecord) == 40 &&
              sizeof(MeasuredStationRecord) == 56);

/// Bytes of a value of each column type.
inline constexpr std::uint32_t COLUMN_BYTES[] = {0, sizeof(std::uint8_t), sizeof(std::uint16_t),
                                                 sizeof(float), sizeof(double)};
static_assert(std::variant_size_v<Column::Values> + 1 == std::size(COLUMN_BYTES));

/// Bytes of the file's light records: AimedLightRecord, or as much of its beginning as the version knows.
[[nodiscard]] inline std::uint32_t light_record_bytes(const Header& header) {
  return header.version >= 12 ? sizeof(AimedLightRecord)
                              : (header.version >= 11 ? sizeof(SizedLightRecord) : sizeof(LightRecord));
}

/// Whether the version has the coordinate system, and noise and step of stations.
[[nodiscard]] inline bool is_measured(const Header& header) { return header.version >= 14; }
[[nodiscard]] inline std::uint32_t station_record_bytes(const Header& header) {
  return is_measured(header) ? sizeof(MeasuredStationRecord) : sizeof(StationRecord);
}

/// The section table (but for checksums) and the file's size follow from the header's counts.
void lay_out(Header& header);

/// One bit for each optional pool of POOL_TABLE, in order, that the scene has, and ELLIPSES where some splat is one, which
/// readers before knew nothing of; with `all`, each that there may be.
[[nodiscard]] std::uint32_t attributes_of(const Scene& scene, bool all = false);
inline constexpr std::uint32_t ELLIPSES = 256;

/// Of header and section table, its own field taken as zero.
[[nodiscard]] std::uint64_t header_checksum(Header header);

}  // namespace splatray::scene_file
