/// Where a texture's alpha cuts a mesh out.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>

#include "preprocess/points.h"

namespace splatray {

class AlphaMask {
 public:
  /// The mesh must outlive the mask.
  explicit AlphaMask(const Mesh& mesh);

  /// Whether anything may be cut out.
  [[nodiscard]] bool any() const { return any_; }
  /// Whether a vertex is cut out.
  [[nodiscard]] bool cut_out(std::size_t vertex) const;
  /// Whether the point of a triangle with these barycentric weights is cut out.
  [[nodiscard]] bool cut_out(std::uint32_t triangle, const glm::dvec3& weights) const;
  /// Adds a line to a point of a triangle where the mask ends within `reach`, world units: square to where the nearest part is
  /// that is cut out, and before all that is not; none where the mask is too fine for one line.
  void clip(std::uint32_t triangle, const glm::dvec3& place, const glm::dvec3& normal, double reach,
            PointClip& clip) const;

 private:
  [[nodiscard]] float alpha(std::size_t vertex) const {
    return mesh_.alpha.empty() ? 1.0F : mesh_.alpha[vertex];
  }

  const Mesh& mesh_;
  bool any_;
};

}  // namespace splatray
