/// Where the surface of a mesh ends beside a point on it.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "preprocess/mesh/edges/mesh_edges.h"
#include "preprocess/points.h"

namespace splatray {

/// Looks for the lines that a disc on a mesh must end at so as not to stick out: borders and creases (MeshEdges). A line is one
/// of the edges near the point, moved outwards until all of the patch, the triangles within reach that are joined smoothly to the
/// point's own, lies before it; so no line takes a part of the surface away, and both sides of an edge end at the same line. Of
/// several lines the nearest is kept, and the nearest of those that differ from it; a corner that is not convex has none.
class ClipFinder {
 public:
  /// The mesh and its edges must outlive the finder. Not for several threads at once.
  ClipFinder(const Mesh& mesh, const MeshEdges& edges)
      : mesh_(mesh), edges_(edges), seen_(edges.triangles(), 0) {}

  /// The lines of a disc at `place`, which lies on the triangles `seeds`, with the unit `normal`; world units. `reach`: how far
  /// edges are looked for; discs of larger radius are not to be clipped.
  [[nodiscard]] PointClip find(const glm::dvec3& place, const glm::dvec3& normal,
                               std::span<const std::uint32_t> seeds, double reach);

 private:
  /// A triangle's side, or what of it is within reach, in the disc's plane; heights along the normal.
  struct Piece {
    glm::dvec2 from, to;
    double height_from, height_to;
    bool edge;  ///< the surface ends here
  };
  struct Corners {
    glm::dvec2 at[3];
  };

  [[nodiscard]] bool find_patch(const glm::dvec3& place, std::span<const std::uint32_t> seeds, double reach);
  void flatten_patch(const glm::dvec3& place, const glm::dvec3& u, const glm::dvec3& v,
                     const glm::dvec3& normal, double reach);
  [[nodiscard]] double support(const glm::dvec2& dir, double reach) const;

  const Mesh& mesh_;
  const MeshEdges& edges_;
  std::vector<std::uint32_t> seen_;  ///< of each triangle: the number of the last patch that has it
  std::uint32_t patches_ = 0;
  std::vector<std::uint32_t> patch_;  ///< triangles
  std::vector<Corners> corners_;      ///< of the patch
  std::vector<Piece> pieces_;         ///< of its sides
  std::vector<glm::dvec2> dirs_;      ///< out of the patch, across its edges
};

}  // namespace splatray
