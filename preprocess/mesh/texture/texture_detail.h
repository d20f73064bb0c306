/// How much detail a texture has where, and how densely a mesh is sampled for it to be seen.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "preprocess/mesh/texture/texture.h"
#include "preprocess/points.h"

namespace splatray {

/// Mean change from texel to texel, in a pyramid of means.
class TextureDetail {
 public:
  /// Measures these channels, 0 red to 3 alpha. The texture must outlive it.
  TextureDetail(const Texture& texture, std::span<const int> channels);

  /// Mean difference of neighbouring texels in the channel that differs most, 0..1 as stored, in the box around three texture
  /// coordinates; of boxes that are large against a block of texels about that.
  [[nodiscard]] double in(const std::array<glm::vec2, 3>& texcoords) const;
  /// Length and area in texels of what these texture coordinates span.
  [[nodiscard]] double longest_edge(const std::array<glm::vec2, 3>& texcoords) const;
  [[nodiscard]] double area(const std::array<glm::vec2, 3>& texcoords) const;

 private:
  struct Level {
    std::uint32_t width, height, block;  ///< blocks; texels of each block's edge
    std::vector<float> mean;
  };
  [[nodiscard]] glm::dvec2 texel_of(glm::vec2 texcoord) const;

  const Texture& texture_;
  std::vector<Level> levels_;
};

/// A part of a triangle that is sampled evenly.
struct SamplePiece {
  std::uint32_t triangle;
  std::array<glm::dvec3, 3> corners;  ///< barycentric weights in the triangle
  double density;  ///< samples to an area, as a multiple of that of all pieces of density 1
};

/// Each triangle of `order` in pieces, in that order, for `count` samples on all. Half of the samples are spread evenly; the
/// others by the texture's detail e, its change to a length, as e^(2/3), which makes the sum over all of change times distance of
/// samples least; but nowhere more than four to a texel. A mesh without textures, or of the same detail all over, is one piece of
/// density 1 for each triangle.
[[nodiscard]] std::vector<SamplePiece> sample_pieces(const Mesh& mesh,
                                                     const std::vector<std::uint32_t>& order,
                                                     std::uint64_t count);

/// Whether the mesh's textures change more between neighbouring vertices than points there can show: by more than a
/// twentieth of the whole range on the mean.
[[nodiscard]] bool is_finer_than_vertices(const Mesh& mesh);

}  // namespace splatray
