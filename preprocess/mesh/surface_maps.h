/// Textures beside the base colour's (SurfaceMap): what they make of points on a mesh.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "engine/scene/texture_factors.h"
#include "preprocess/points.h"

namespace splatray {

/// Value of a map's channel at a texture coordinate, 0..1.
[[nodiscard]] float map_value(const SurfaceMap& map, const MapChannel& channel, glm::vec2 texcoord);

/// Collects the texture factors of points on a mesh, one point after the other.
class MapSamples {
 public:
  /// The mesh must outlive it.
  explicit MapSamples(const Mesh& mesh);

  /// Adds the point of a triangle with these barycentric weights, or a vertex, with the surface's normal there, of any length.
  void add(const glm::uvec3& triangle, const glm::vec3& weights, const glm::vec3& normal);
  void add(glm::uint vertex, const glm::vec3& normal);

  /// A column for each factor, which is then gone from here.
  [[nodiscard]] std::vector<Column> take();

 private:
  template <class ValueOf>
  void add_at(const ValueOf& value_of, const glm::uvec3* triangle, const glm::vec3& normal);
  /// `triangle`: one at the point, whose texture coordinates say where the map's x and y lead; null: there is none.
  void add_normal(const SurfaceMap& map, glm::vec2 texcoord, const glm::uvec3* triangle,
                  const glm::vec3& normal);

  const Mesh& mesh_;
  std::vector<std::vector<std::uint8_t>> bytes_;    ///< one for each channel of each map
  std::vector<std::uint16_t> normal_u_, normal_v_;  ///< of a normal map
  std::vector<const glm::uvec3*> triangle_at_;      ///< beside the vertices, where they are asked for
};

}  // namespace splatray
