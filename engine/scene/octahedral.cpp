#include "engine/scene/octahedral.h"

#include <algorithm>
#include <cmath>

namespace splatray {
namespace {

int sign_not_zero(double value) { return value < 0.0 ? -1 : 1; }

}  // namespace

glm::dvec2 octahedral_exact(const glm::dvec3& normal, int scale) {
  const double sum = std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z);
  const glm::dvec2 exact = glm::dvec2(normal) * (scale / sum);
  if (normal.z >= 0.0) return exact;
  return {(scale - std::abs(exact.y)) * sign_not_zero(exact.x),
          (scale - std::abs(exact.x)) * sign_not_zero(exact.y)};
}

glm::ivec2 octahedral_nearest(const glm::dvec3& normal, int scale) {
  const glm::dvec2 exact = octahedral_exact(normal, scale);
  glm::ivec2 best{0};
  double best_dot = -2.0;
  for (int corner = 0; corner < 4; ++corner) {
    const int u = std::clamp(static_cast<int>(std::floor(exact.x)) + (corner & 1), -scale, scale);
    const int v = std::clamp(static_cast<int>(std::floor(exact.y)) + (corner >> 1), -scale, scale);
    const glm::dvec3 vector = octahedral_vector(u, v, scale);
    const double dot = glm::dot(normal, vector) / glm::length(vector);
    if (dot > best_dot) {
      best_dot = dot;
      best = {u, v};
    }
  }
  // On the border two coordinates are one direction, of which this is the one that the direction itself gives.
  if (std::abs(best.x) == scale) best.y = std::abs(best.y);
  if (std::abs(best.y) == scale) best.x = std::abs(best.x);
  return best;
}

}  // namespace splatray
