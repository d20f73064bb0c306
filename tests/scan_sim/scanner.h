/// Simulated scanners: points as laser and range scanners deliver them, with the truth of each.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "preprocess/points.h"
#include "tests/scan_sim/triangle_tree.h"

namespace splatray::testing {

/// What a simulated point truly is.
enum class PointKind : std::uint8_t {
  surface,
  mixed,  ///< of a beam that meets two surfaces: between them
  stray,  ///< on nothing: dust, birds, multiple reflections
  leaf    ///< on something smaller than the points are apart (mark_leaves)
};
inline constexpr std::size_t POINT_KINDS = 4;

/// Points with what is true of them, beside them.
struct SimulatedScan {
  Points points;  ///< positions, stations, station and grid_cell; columns where the scanner has them
  std::vector<glm::dvec3> position;  ///< without noise
  std::vector<glm::dvec3> normal;    ///< unit, towards the scanner
  std::vector<PointKind> kind;
  std::vector<std::uint32_t> triangle;  ///< of the mesh, that was met

  [[nodiscard]] std::size_t size() const { return kind.size(); }
};

/// What is the same of all scanners.
struct Beam {
  double noise = 0.003;        ///< standard deviation of the range, world units
  double divergence = 5e-4;    ///< half the beam's angle, radians
  double stray_share = 0.001;  ///< of the points
  std::uint64_t seed = 1;
};

/// A scanner on a tripod: a grid of directions about its vertical axis +z.
struct Tripod {
  std::vector<glm::dvec3> sensors;
  double step_deg = 0.5;      ///< between rows and between columns
  double lowest_deg = -60.0;  ///< elevation of the first row
  double highest_deg = 90.0;
  glm::dmat3 axes{1.0};  ///< columns: the scanner's x, y and z in the world
};
[[nodiscard]] SimulatedScan scan_from_tripods(const TriangleTree& mesh, const Tripod& tripod,
                                              const Beam& beam);

/// A spinning lidar: rings of even elevation, much closer points along them.
struct Spinner {
  glm::dvec3 sensor{0.0};
  int rings = 64;
  int columns = 1800;
  double lowest_deg = -25.0;
  double highest_deg = 15.0;
  glm::dmat3 axes{1.0};
};
[[nodiscard]] SimulatedScan scan_by_spinner(const TriangleTree& mesh, const Spinner& spinner,
                                            const Beam& beam);

/// A flight along x at a height over z = 0, with lines across: the columns return, returns and time, and no station's place.
struct Flight {
  double from_x = -60.0, to_x = 60.0, y = 0.0;
  double height = 80.0;
  double swath = 55.0;    ///< half of it, on the ground
  double spacing = 0.35;  ///< along and across, on the ground
  double speed = 60.0;    ///< world units a second
};
[[nodiscard]] SimulatedScan scan_from_air(const TriangleTree& mesh, const Flight& flight, const Beam& beam);

/// A flight over wood_mesh, with 8 pulses a square metre.
[[nodiscard]] SimulatedScan wood_scan(const TriangleTree& mesh);

/// Says that what lies on the mesh's triangles from `first` on is leaves.
void mark_leaves(SimulatedScan& scan, std::uint32_t first);

/// Range images all around a body from `views` places, each turned and moved a little, as registration leaves it: several
/// layers of one surface.
struct RangeImages {
  int views = 10;
  double distance = 4.0;  ///< of the scanners from the middle
  int pixels = 250;       ///< of an image's edge
  double fov_deg = 32.0;
  double misplaced = 0.001;  ///< standard deviation of each image's shift, world units
  glm::dvec3 middle{0.0};    ///< what all look at
};
[[nodiscard]] SimulatedScan range_images(const TriangleTree& mesh, const RangeImages& images,
                                         const Beam& beam);

/// A depth camera: a grid of lines of sight through a pinhole, and depths that are steps of disparity.
struct DepthCamera {
  glm::dvec3 sensor{0.0};
  glm::dmat3 axes{1.0};  ///< columns: towards larger columns, larger rows, and ahead
  std::uint32_t columns = 320, rows = 240;
  double focal = 290.0;          ///< cells
  double step = 0.0029;          ///< of inverse depths, 1 / world units; 0 = they are not rounded
  double inverse_noise = 0.001;  ///< standard deviation of inverse depths before they are rounded
};
[[nodiscard]] SimulatedScan scan_by_depth_camera(const TriangleTree& mesh, const DepthCamera& camera,
                                                 const Beam& beam);

}  // namespace splatray::testing
