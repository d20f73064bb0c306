#include "preprocess/normal_field.h"

#include <algorithm>
#include <cmath>

namespace splatray {
namespace {

constexpr double SIMILAR = 0.5;  // cosine of normals of one sheet
constexpr double LATERAL = 0.5;  // tangential share of the distance of a neighbour on the same sheet
constexpr double RIDGE = 1e-3;   // keeps the fit defined where neighbours lie in a line

/// Sums of the fit of a symmetric matrix [[x, y], [y, z]] that maps tangential offsets to leans.
class SlopeFit {
 public:
  void add(const glm::dvec2& offset, const glm::dvec2& lean, double weight) {
    const glm::dvec3 for_u(offset.x, offset.y, 0.0);
    const glm::dvec3 for_v(0.0, offset.x, offset.y);
    normal_ += weight * (glm::outerProduct(for_u, for_u) + glm::outerProduct(for_v, for_v));
    right_ += weight * (for_u * lean.x + for_v * lean.y);
    variance_ += weight * glm::dot(lean, lean);
  }

  /// The matrix' x, y, z times the share of the leans' variance it explains; zero where nothing is known.
  [[nodiscard]] glm::dvec3 solve() const {
    const double trace = normal_[0][0] + normal_[1][1] + normal_[2][2];
    if (!(trace > 0.0) || !(variance_ > 0.0)) return glm::dvec3(0.0);
    const glm::dvec3 slope = glm::inverse(normal_ + glm::dmat3(RIDGE * trace)) * right_;
    const double explained = 2.0 * glm::dot(slope, right_) - glm::dot(slope, normal_ * slope);
    return slope * std::clamp(explained / variance_, 0.0, 1.0);
  }

 private:
  glm::dmat3 normal_{0.0};
  glm::dvec3 right_{0.0};
  double variance_ = 0.0;
};

}  // namespace

glm::vec3 fit_normal_field(const Cloud& cloud, std::uint32_t point, std::span<const Neighbour> nearest) {
  const glm::dvec3 normal = glm::normalize(glm::dvec3(cloud.normal[point]));
  const TangentFrame frame(normal);
  SlopeFit fit;
  for (const Neighbour& neighbour : nearest) {
    glm::dvec3 other = glm::normalize(glm::dvec3(cloud.normal[neighbour.index()]));
    if (!cloud.oriented && glm::dot(other, normal) < 0.0) other = -other;
    const double along = glm::dot(other, normal);
    const glm::dvec3 to_other(cloud.coord[neighbour.index()] - cloud.coord[point]);
    const glm::dvec2 offset(glm::dot(to_other, frame.u), glm::dot(to_other, frame.v));
    const double distance_squared = neighbour.distance_squared();
    if (along < SIMILAR || glm::dot(offset, offset) < LATERAL * LATERAL * distance_squared) continue;
    const glm::dvec2 lean = glm::dvec2(glm::dot(other, frame.u), glm::dot(other, frame.v)) / along;
    fit.add(offset, lean, 1.0 / distance_squared);
  }
  return glm::vec3(fit.solve());
}

}  // namespace splatray
