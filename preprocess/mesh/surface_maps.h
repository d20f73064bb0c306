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

  /// Of the point of a triangle with these barycentric weights, and of a vertex.
  void add(const glm::uvec3& triangle, const glm::vec3& weights);
  void add(glm::uint vertex);

  /// A column for each factor, which is then gone from here.
  [[nodiscard]] std::vector<Column> take();

 private:
  template <class TexcoordOf>
  void add_at(const TexcoordOf& texcoord_of);

  const std::vector<SurfaceMap>& maps_;
  std::vector<std::vector<std::uint8_t>> bytes_;  ///< one for each channel of each map
};

}  // namespace splatray
