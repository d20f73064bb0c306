#include "engine/file/scene_records.h"

namespace splatray::scene_file {

LightRecord record_of(const SceneLight& light) {
  return {light.kind,
          0,
          light.position,
          light.power,
          0,
          light.size,
          light.edge_u,
          light.edge_v,
          light.spot_axis,
          light.spot_inner,
          light.spot_outer,
          light.range};
}

SceneLight value_of(const LightRecord& record) {
  return {record.kind,   record.position,  record.power,      record.size,       record.edge_u,
          record.edge_v, record.spot_axis, record.spot_inner, record.spot_outer, record.range};
}

CameraRecord record_of(const Camera& camera) {
  return {camera.eye, camera.target, camera.up, camera.fov_y_deg, camera.ortho_height};
}

Camera value_of(const CameraRecord& record) {
  return {record.eye, record.target, record.up, record.fov_y_deg, record.ortho_height};
}

StationRecord record_of(const Station& station) {
  return {sensor_place_world(station).value_or(glm::dvec3(0.0)),
          station.sensor_world ? 1U : 0U,
          station.rows,
          station.columns,
          station.sensor_found_world ? 1U : 0U,
          station.noise_world,
          station.step_world};
}

Station value_of(const StationRecord& record) {
  Station station;
  if (record.has_sensor != 0) station.sensor_world = record.sensor;
  if (record.sensor_found != 0) station.sensor_found_world = record.sensor;
  station.rows = record.rows;
  station.columns = record.columns;
  station.noise_world = record.noise;
  station.step_world = record.step;
  return station;
}

RootRecord record_of(const RootTransform& root) { return {root.origin_world, root.unit_world}; }

RootTransform value_of(const RootRecord& record) { return {record.origin, record.unit}; }

BuildRecord record_of(const BuildParams& build) {
  return {build.leaf_size,    static_cast<std::uint32_t>(build.insertion),
          build.probes,       static_cast<std::uint32_t>(build.radius_rule),
          build.radius_scale, build.samples,
          build.seed};
}

BuildParams value_of(const BuildRecord& record) {
  return {record.leaf_size,    Insertion{record.insertion},
          record.probes,       RadiusRule{record.radius_rule},
          record.radius_scale, record.samples,
          record.seed,         false};
}

}  // namespace splatray::scene_file
