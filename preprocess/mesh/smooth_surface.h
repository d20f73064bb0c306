/// The curved surface that a mesh stands for where its vertices and normals say so.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "preprocess/mesh/edges/mesh_edges.h"
#include "preprocess/mesh/tessellated.h"
#include "preprocess/points.h"

namespace splatray {

/// A triangle bent as the surface is: half way to the mean of the corners' tangent planes (Boubekeur and Alexa 2008, "Phong
/// Tessellation"; half is exact where the surface is a quadric's graph).
struct SmoothTriangle {
  std::array<glm::dvec3, 3> corners;
  /// How each side bends, from a corner to the next: its middle lies an eighth of this off the chord.
  std::array<glm::dvec3, 3> bow;

  /// The surface's point at these barycentric weights.
  [[nodiscard]] glm::dvec3 place(const glm::dvec3& weights) const;
  /// The unit normal of the surface's tangent plane there, on the triangle's side; zero of triangles without area.
  [[nodiscard]] glm::dvec3 normal(const glm::dvec3& weights) const;
  /// The unit normal of a disc there, where light sees `seen`: that of the tangent plane, on the side of `seen`, where this
  /// leans out of it by 1 to 45 degrees and the triangle is large beside the samples' distance, as discs that lean leave slits.
  /// Else `seen`: neighbouring discs are parts of one round surface. Slivers may be bent by more, and have no plane worth it.
  [[nodiscard]] glm::vec3 disc_normal(const glm::dvec3& weights, const glm::vec3& seen,
                                      double spacing_world) const;
  /// The least height of the flat triangle.
  [[nodiscard]] double least_height() const;
};

/// The facets, bent at those edges that are chords of a curve (chord_sides). Each edge has its own share in the surface, so that
/// triangles join. Both triangles at an edge decide it: at a crease it runs in the tangent planes of both, so that a round rim is
/// round on both sides; a border follows its one triangle. Edges along which normals turn by more than 45 degrees stay straight.
class SmoothSurface {
 public:
  /// `corners`: corner_normals; `shared`: the vertices where other meshes have some too, null = none. All must outlive the
  /// surface.
  SmoothSurface(const Mesh& mesh, const std::vector<glm::uint>& weld, const std::vector<glm::vec3>& corners,
                const MeshEdges& edges, const std::vector<bool>* shared = nullptr)
      : mesh_(mesh),
        weld_(weld),
        corners_(corners),
        edges_(edges),
        chords_(chord_sides(mesh, weld, corners, edges, shared)) {}

  [[nodiscard]] SmoothTriangle triangle(std::uint32_t index) const;

 private:
  [[nodiscard]] glm::dvec3 bow_of(std::uint32_t triangle, std::uint32_t side) const;
  [[nodiscard]] glm::dvec3 corner_normal(std::uint32_t triangle, glm::uint place) const;

  const Mesh& mesh_;
  const std::vector<glm::uint>& weld_;
  const std::vector<glm::vec3>& corners_;
  const MeshEdges& edges_;
  std::vector<std::uint8_t> chords_;  ///< chord_sides
};

}  // namespace splatray
