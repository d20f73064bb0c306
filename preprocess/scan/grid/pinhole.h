/// The pinhole camera that a scan's grid was seen by.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/scene/camera.h"
#include "preprocess/surface/cloud.h"

namespace splatray {

/// A camera whose cells are where lines of sight meet a plane: a point at (x, y, z) in its axes is seen in column
/// middle.x + focal.x * x / z, row middle.y + focal.y * y / z, cells having their centres at whole numbers.
struct Pinhole {
  glm::dvec3 eye_world{0.0};
  /// Columns: towards larger columns, larger rows, ahead; unit, the third square to both others.
  glm::dmat3 axes{1.0};
  glm::dvec2 focal{1.0};   ///< cells, > 0
  glm::dvec2 middle{0.0};  ///< column and row on the axis
};

/// The camera of a station's grid, found from its points by the direct linear transformation (Abdel-Aziz and Karara 1971) with
/// its place known: least squares over at most some thousands of points. Nothing where the station has no grid or no place,
/// more than a hundredth of the points lie behind, half of them are more than half a cell off, or axes and focal lengths are
/// no camera's: spherical grids, and what was turned after the scan without its station.
[[nodiscard]] std::optional<Pinhole> fit_pinhole(const Cloud& cloud, const Station& station,
                                                 const std::vector<std::uint32_t>& points);

/// The camera that shows a scan as it was seen, where the only station there is has a pinhole's grid. Its field of view is the
/// grid's whole height; its top is that of a grid whose rows run down where columns run to the right, or up where they do not.
[[nodiscard]] std::optional<Camera> camera_of_scan(std::span<const Cloud> clouds);

}  // namespace splatray
