/// The records of a scene file that are no GPU buffer images, as scene_file.h draws them. A member that is added goes to a record's
/// end, and zero means what files without it do.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <string>

#include "engine/file/scene_sections.h"
#include "engine/scene/scene.h"

namespace splatray::scene_file {

struct LightRecord {
  static constexpr std::uint32_t LEAST_BYTES = 48;  ///< up to zero_1
  std::uint32_t kind, zero_0;
  glm::dvec3 position;
  glm::vec3 power;
  std::uint32_t zero_1;
  double size;
  glm::dvec3 edge_u, edge_v;
  glm::dvec3 spot_axis;
  double spot_inner, spot_outer, range;
};

/// Scenes' own cameras have no lens shift and square pixels.
struct CameraRecord {
  static constexpr std::uint32_t LEAST_BYTES = 88;
  glm::dvec3 eye, target, up;
  double fov_y_deg, ortho_height;
};

struct StationRecord {
  static constexpr std::uint32_t LEAST_BYTES = 40;  ///< up to sensor_found
  glm::dvec3 sensor;
  std::uint32_t has_sensor, rows, columns, sensor_found;
  double noise, step;
};

struct RootRecord {
  static constexpr std::uint32_t LEAST_BYTES = 32;
  glm::dvec3 origin;
  double unit;
};

struct BuildRecord {
  static constexpr std::uint32_t LEAST_BYTES = 40;
  std::uint32_t leaf_size, insertion, probes, radius_rule;
  double radius_scale;
  std::uint64_t samples, seed;
};

struct WorldRecord {
  static constexpr std::uint32_t LEAST_BYTES = 80;
  glm::dvec3 up, bounds_min, bounds_max;
  double surface_area;
};

/// Bytes that the first files of version 15 had of layout.h's Material.
inline constexpr std::uint32_t MATERIAL_LEAST_BYTES = 144;

static_assert(sizeof(LightRecord) == 152 && sizeof(CameraRecord) == 88 && sizeof(StationRecord) == 56 &&
              sizeof(RootRecord) == 32 && sizeof(BuildRecord) == 40 && sizeof(WorldRecord) == 80);

[[nodiscard]] LightRecord record_of(const SceneLight& light);
[[nodiscard]] SceneLight value_of(const LightRecord& record);
[[nodiscard]] CameraRecord record_of(const Camera& camera);
[[nodiscard]] Camera value_of(const CameraRecord& record);
/// Without its name.
[[nodiscard]] StationRecord record_of(const Station& station);
[[nodiscard]] Station value_of(const StationRecord& record);
[[nodiscard]] RootRecord record_of(const RootTransform& root);
[[nodiscard]] RootTransform value_of(const RootRecord& record);
[[nodiscard]] BuildRecord record_of(const BuildParams& build);
/// The build parameters of a scene without normal fields: whether there are any the pools say.
[[nodiscard]] BuildParams value_of(const BuildRecord& record);

}  // namespace splatray::scene_file
