/// Which parts of space hold points: how far rays go before they come near a surface.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "preprocess/scan/survey.h"
#include "preprocess/surface/cloud.h"

namespace splatray {

/// Cubic cells over a cloud, in its coordinates.
class Occupancy {
 public:
  /// Cells of about `edge`, at least 1/`along` of the cloud's extent: at most 2^24 or so of 256, 2^27 bits of 512.
  Occupancy(const Cloud& cloud, double edge, double along = 256.0);

  [[nodiscard]] double edge() const { return edge_; }
  /// The middles of at most `most` cells without points, an even choice of all in the cloud's box.
  [[nodiscard]] std::vector<glm::dvec3> free_places(std::size_t most) const;
  /// Distance along a unit direction from `origin` to the first cell with points; nothing where the ray leaves the cloud's box
  /// before.
  [[nodiscard]] std::optional<double> free_path(const glm::dvec3& origin, const glm::dvec3& dir) const;

 private:
  [[nodiscard]] bool filled(const glm::ivec3& cell) const {
    const std::size_t number = (static_cast<std::size_t>(cell.z) * static_cast<std::size_t>(size_.y) +
                                static_cast<std::size_t>(cell.y)) *
                                   static_cast<std::size_t>(size_.x) +
                               static_cast<std::size_t>(cell.x);
    return (bits_[number / 64] >> number % 64 & 1U) != 0;
  }

  double edge_;
  glm::dvec3 low_;
  glm::ivec3 size_;
  std::vector<std::uint64_t> bits_;
};

/// The edge of cells that leave few holes in a surface: 2.5 times the distance to the 8th place, of the sparsest tenth.
[[nodiscard]] double cell_edge(const Survey& survey);

}  // namespace splatray
