#include "tests/scan_sim/scan_cases.h"

#include "tests/scan_sim/sim_meshes.h"

namespace splatray::testing {
using glm::dvec3;

Sweep street_sweep(int rings) {
  static const std::shared_ptr<const TriangleTree> street = std::make_shared<TriangleTree>(street_mesh());
  Spinner spinner{.sensor = {0.0, 0.5, 1.8}, .rings = rings};
  if (rings <= 16) spinner.lowest_deg = -15.0;  // as those of so few have
  return {scan_by_spinner(*street, spinner, {.noise = 0.015}), spinner, street};
}

SimulatedScan corner_by_depth_camera(DepthCamera camera) {
  camera.sensor = {3.2, 3.0, 1.4};
  const dvec3 ahead = glm::normalize(dvec3(0.9, 1.0, 0.6) - camera.sensor);
  const dvec3 right = glm::normalize(glm::cross(ahead, dvec3(0.0, 0.0, 1.0)));
  camera.axes = {right, glm::cross(ahead, right), ahead};
  return scan_by_depth_camera(TriangleTree(corner_mesh()), camera, {.noise = 0.0005, .divergence = 1e-3});
}

Sweep without_stations(Sweep sweep) {
  Points& points = sweep.scan.points;
  points.stations.clear();
  points.station.clear();
  points.grid_cell.clear();
  return sweep;
}

}  // namespace splatray::testing
