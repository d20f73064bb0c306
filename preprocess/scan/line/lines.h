/// Lines of points: rings of a spinning scanner, scan lines, columns of a grid seen at a slant, whose points are far closer along
/// the lines than these are to each other.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "preprocess/base/parallel.h"
#include "preprocess/scan/survey.h"
#include "preprocess/surface/cloud.h"

namespace splatray {

/// A point's place on a line. Cloud coordinates.
struct LinePlace {
  glm::vec3 along{0.0F};   ///< unit
  float step = 0.0F;       ///< to the next point, on the side where that is further; 0 = on no line
  std::uint32_t next = 0;  ///< the nearest point along the line
  /// Across to the nearest lines, the second on the other side; zero = none.
  std::array<glm::vec3, 2> beside{};
  std::array<std::uint32_t, 2> other{};  ///< the points there
  bool plane = false;                    ///< the normal is that of a surface through these lines
};

/// Which of some points lie on lines, as close to the next point as that is to others; none where hardly any of the cloud does.
[[nodiscard]] std::vector<std::uint32_t> points_on_lines(const Cloud& cloud, const Survey& survey,
                                                         const std::vector<std::uint32_t>& points);

/// Where each point lies on lines; empty where hardly any does. `beside` is found among the neighbours of the survey and, further
/// off, among ever fewer points on lines.
[[nodiscard]] std::vector<LinePlace> find_lines(const Cloud& cloud, const Survey& survey, const Stage& stage);

/// Lays a surface through lines that go on straight from one to the next: its normal, where that was estimated from one line
/// alone, and with `ellipses` Cloud::ellipse, Cloud::radius_most of discs, and clip lines where the surface is known on one side
/// alone or lines are closer there. Lines whose neighbours suggest no surface stay as they are.
void join_lines(Cloud& cloud, const Survey& survey, bool ellipses, std::vector<LinePlace>& places);

/// The scanner's place, cloud coordinates: where all steps along the lines are seen under the same angle, as those of a spinning
/// scanner are. None where there is no such place among the points.
[[nodiscard]] std::optional<glm::dvec3> find_spinning_sensor(const Cloud& cloud,
                                                             const std::vector<LinePlace>& places);

/// What lines of all surfaces lie across, as far as they can: a spinning scanner's axis, unit. Zero where no direction is that.
[[nodiscard]] glm::dvec3 axis_of_lines(const std::vector<LinePlace>& places);

/// The axis, x, y or z, that a scanner at `sensor` turned about, where these points lie on its rings: from there they have few elevations,
/// and a tenth at least lie on rings of 16 and more ranges. None where they do not, as with a sensor elsewhere; and none in what was
/// turned on a lathe, milled or stacked in rows, whose points can have few elevations, too, but have one or few ranges each.
[[nodiscard]] std::optional<glm::dvec3> find_ring_axis(const Cloud& cloud,
                                                       const std::vector<std::uint32_t>& points,
                                                       const glm::dvec3& sensor);

/// What a scanner at one place saw.
struct Sweep {
  glm::dvec3 sensor;  ///< cloud coordinates
  double gap = 0.0;   ///< between its rings or columns, whichever are further, radians
};

/// Finds the places of these points again by the directions that they are seen in: whatever the surface, the next points of a ring
/// and the next rings are there. Nothing, and no change, where there are too few points or lines.
[[nodiscard]] std::optional<Sweep> find_rings(const Cloud& cloud, const std::vector<std::uint32_t>& points,
                                              const glm::dvec3& sensor, std::vector<LinePlace>& places);

/// Settles a sweep's points that lie on no surface through lines: makes normals face the scanner that noise has put along the line of
/// sight, and, where `bound`, bounds discs by the way to the next ring (Cloud::radius_most, which join_lines has made).
void settle_rest(Cloud& cloud, const Survey& survey, const std::vector<std::uint32_t>& points,
                 const Sweep& sweep, bool bound, std::vector<LinePlace>& places);

/// Lays surfaces through lines as find_lines has them and, of stations whose places are known, through rings; where `splats`, these are
/// ellipses (Cloud::ellipse) and bounds of discs.
void lay_line_surfaces(Cloud& cloud, const Survey& survey, bool splats, std::vector<LinePlace> lines);

}  // namespace splatray
