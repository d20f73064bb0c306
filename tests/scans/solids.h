/// Solids that rays meet in closed form: what simulated scanners look at.
#pragma once
#include <glm/glm.hpp>
#include <limits>
#include <variant>
#include <vector>

namespace splatray::testing {

/// A ball; seen from within too.
struct Ball {
  glm::dvec3 center;
  double radius;
};

/// A box with faces along the axes; seen from within too.
struct Block {
  glm::dvec3 low, high;
};

/// An upright cylinder without ends, about an axis along z.
struct Column3d {
  glm::dvec2 center;
  double radius;
  double low, high;
};

/// z = 0.4 sin(x) cos(0.7 y) for |x|, |y| <= half.
struct Terrain {
  double half;
};

using Solid = std::variant<Ball, Block, Column3d, Terrain>;

/// Where a ray first meets a surface.
struct SolidHit {
  double t = std::numeric_limits<double>::infinity();
  glm::dvec3 normal{0.0};  ///< unit, turned against the ray
  [[nodiscard]] bool found() const { return t < std::numeric_limits<double>::infinity(); }
};

/// The nearest hit of the ray origin + t dir, t > 1e-6; `dir` is unit. Terrain is found by steps of 0.05 and bisection.
[[nodiscard]] SolidHit nearest_hit(const std::vector<Solid>& solids, const glm::dvec3& origin,
                                   const glm::dvec3& dir);

/// 8 x 6 x 3 m, a ceiling and four columns; z is up, the floor is z = 0.
[[nodiscard]] std::vector<Solid> columned_room();

}  // namespace splatray::testing
