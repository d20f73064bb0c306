#include "app/library/measure/plane_fit.h"

#include <cmath>
#include <vector>

namespace splatray {
namespace {

constexpr std::size_t LEAST_PLANE_POINTS = 8;
constexpr int PLANE_ROUNDS = 4;
constexpr double OUTLIER = 3.0;  ///< standard deviations
/// Reach of the points across their longest way, in residuals, below which they are a line.
constexpr double LEAST_REACH = 3.0;

/// The direction along which a symmetric matrix has least, by inverse iteration; `other`: none of it, where it is not 0.
glm::dvec3 least_direction(const glm::dmat3& sums, const glm::dvec3& other) {
  const double trace = sums[0][0] + sums[1][1] + sums[2][2];
  const glm::dmat3 closed = sums + trace * glm::outerProduct(other, other);
  const glm::dmat3 inverse = glm::inverse(closed + glm::dmat3(1e-12 * trace));
  glm::dvec3 direction(0.577, 0.578, 0.576);
  for (int i = 0; i < 60; ++i) direction = glm::normalize(inverse * direction);
  return direction;
}

std::optional<PlaneFit> fitted_once(const std::vector<glm::dvec3>& points) {
  const auto count = static_cast<double>(points.size());
  PlaneFit fit;
  fit.points = points.size();
  for (const glm::dvec3& point : points) fit.middle += point / count;
  glm::dmat3 sums(0.0);
  for (const glm::dvec3& point : points) sums += glm::outerProduct(point - fit.middle, point - fit.middle);
  if (!(sums[0][0] + sums[1][1] + sums[2][2] > 0.0)) return {};
  fit.normal = least_direction(sums, glm::dvec3(0.0));
  const glm::dvec3 across = least_direction(sums, fit.normal);
  const double squares = std::max(glm::dot(fit.normal, sums * fit.normal), 0.0);
  const double reach_squares = glm::dot(across, sums * across);
  fit.residual = std::sqrt(squares / count);
  if (!(std::sqrt(reach_squares / count) > LEAST_REACH * fit.residual)) return {};
  fit.turn_error = std::sqrt(squares / (count - 3.0) / reach_squares);
  return fit;
}

}  // namespace

std::optional<PlaneFit> fit_plane(std::span<const glm::dvec3> points) {
  std::vector<glm::dvec3> kept(points.begin(), points.end());
  std::optional<PlaneFit> fit;
  for (int round = 0; round < PLANE_ROUNDS; ++round) {
    if (kept.size() < LEAST_PLANE_POINTS) return {};
    fit = fitted_once(kept);
    if (!fit) return {};
    const std::size_t before = kept.size();
    std::erase_if(kept, [&fit](const glm::dvec3& point) {
      return std::abs(glm::dot(point - fit->middle, fit->normal)) > OUTLIER * fit->residual;
    });
    if (kept.size() == before) break;
  }
  return fit;
}

}  // namespace splatray
