/// Inside and outside of triangle meshes.
#pragma once
#include <glm/glm.hpp>
#include <vector>

#include "preprocess/points.h"

namespace splatray {

/// What the winding of a mesh says about its inside.
struct MeshOrientation {
  double open_share = 1.0;     ///< share of edges whose two directions are not used equally often: 0 = closed
  double signed_volume = 0.0;  ///< > 0: triangles are wound counter-clockwise seen from outside
  /// Share of triangles whose given normals agree with their winding; 1 without normals.
  double agreeing_share = 1.0;

  /// Few enough open edges that the volume's sign can be trusted.
  [[nodiscard]] bool is_closed() const { return open_share <= 0.01 && signed_volume != 0.0; }
};

/// Measures a mesh whose coincident vertices are joined by `weld` (weld_positions). An edge that is used k
/// times in each direction is closed for every k, so that folded and doubled sheets do not count as holes.
[[nodiscard]] MeshOrientation measure_orientation(const Mesh& mesh, const std::vector<glm::uint>& weld);

}  // namespace splatray
