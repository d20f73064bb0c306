/// The smooth surface that the splats around a plane stand for, and where the plane meets it.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "app/library/cut/plane_cut.h"

namespace splatray {

/// A splat in the coordinates of the plane: along right, along top, above it.
struct CutSplat {
  glm::dvec3 center{0.0}, normal{0.0};
  double radius = 0.0;
  std::uint32_t object = 0;
};

/// A place where the plane meets the surface.
struct CutPoint {
  glm::dvec2 place{0.0};
  glm::dvec3 normal{0.0};  ///< unit, in the coordinates of the plane
  double radius = 0.0;     ///< mean of the splats that it follows from
  std::uint32_t object = 0;
  double support = 0.0;  ///< sum of their weights, each 0 to 1
  /// From the place to the nearest splat ahead along the curve and to the nearest behind, their sum in radii of these; infinite where
  /// there is none of either.
  double gap = 0.0;

  /// Unit direction along the curve, the surface's front to the left.
  [[nodiscard]] glm::dvec2 forward() const { return glm::normalize(glm::dvec2(normal.y, -normal.x)); }
};

class CutSurface {
 public:
  /// Radii of a splat within which it says where the surface is.
  static constexpr double SUPPORT = 4.0;

  /// Takes the splats that reach the plane with their support.
  CutSurface(const Scene& scene, const CutPlane& plane);

  [[nodiscard]] const std::vector<CutSplat>& splats() const { return splats_; }

  /// The point of the surface nearest to a guess in the plane, by moving least squares (Levin 2003): on a plane, or where that leaves
  /// significantly more, on a quadric through the splats of the same object and side that are less than SUPPORT of their radii away, weighted
  /// by their distance. Nothing where too few splats make it, where it lies nearly in the plane, or not near the guess.
  [[nodiscard]] std::optional<CutPoint> project(const CutPoint& guess) const;
  /// Where the plane meets the surface at a splat that it crosses.
  [[nodiscard]] std::optional<CutPoint> project(const CutSplat& splat) const;

  /// Calls visit(index, vector from the place to the splat's centre) for the splats that are less than SUPPORT of their radii away.
  template <typename Visit>
  void for_each_near(const glm::dvec2& place, const Visit& visit) const {
    for (const auto& [level, cells] : levels_) {
      const Cell middle = cell_of(place, level);
      for (std::int64_t x = middle[0] - 1; x <= middle[0] + 1; ++x)
        for (std::int64_t y = middle[1] - 1; y <= middle[1] + 1; ++y)
          if (const auto found = cells.find({x, y}); found != cells.end())
            visit_cell(found->second, place, visit);
    }
  }

 private:
  using Cell = std::array<std::int64_t, 2>;

  template <typename Visit>
  void visit_cell(const std::vector<std::uint32_t>& cell, const glm::dvec2& place, const Visit& visit) const {
    for (const std::uint32_t index : cell) {
      const glm::dvec3 to = splats_[index].center - glm::dvec3(place, 0.0);
      const double most = SUPPORT * splats_[index].radius;
      if (glm::dot(to, to) < most * most) visit(index, to);
    }
  }

  [[nodiscard]] static Cell cell_of(const glm::dvec2& place, int level);

  std::vector<CutSplat> splats_;
  /// By the power of two that a splat's support is at most, in squares of that side.
  std::map<int, std::map<Cell, std::vector<std::uint32_t>>> levels_;
};

}  // namespace splatray
