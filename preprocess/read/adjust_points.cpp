#include "preprocess/read/adjust_points.h"

#include "preprocess/mesh/mesh_transform.h"

namespace splatray {
namespace {

void scale_heights(Points& points, double scale) {
  const glm::dmat3 scaled(glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, scale));
  for (std::size_t i = 0; i < points.ellipse.size(); ++i)
    transform_ellipse(scaled, points.normal[i], points.ellipse[i], points.radius[i]);
  for (glm::dvec3& position : points.position) position.z *= scale;
  for (glm::vec3& normal : points.normal) normal.z = static_cast<float>(double(normal.z) / scale);
  for (Station& station : points.stations)
    if (station.sensor_world) station.sensor_world->z *= scale;
  for (TrackPlace& place : points.track) place.sensor_world.z *= scale;
}

}  // namespace

void adjust_points(InputObject& object, const ScanOptions& options) {
  Points& points = object.points;
  if (points.size() == 0 || !object.meshes.empty()) return;
  if (options.z_scale != 1.0) scale_heights(points, options.z_scale);
  if (!options.sensor_world) return;
  if (points.stations.empty()) points.stations.resize(1);
  for (Station& station : points.stations)
    if (!station.sensor_world) station.sensor_world = options.sensor_world;
}

}  // namespace splatray
