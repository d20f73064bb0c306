#include "preprocess/scan/plane_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace splatray {
namespace {

/// Eigenvalues, ascending, of a symmetric matrix xx, yy, zz, xy, xz, yz (Smith 1961, "Eigenvalues of a symmetric 3 x 3
/// matrix").
glm::dvec3 eigenvalues(const std::array<double, 6>& m) {
  const auto [xx, yy, zz, xy, xz, yz] = m;
  const double mean = (xx + yy + zz) / 3.0;
  const double a = xx - mean, b = yy - mean, c = zz - mean;
  const double off = xy * xy + xz * xz + yz * yz;
  const double p = std::sqrt((a * a + b * b + c * c + 2.0 * off) / 6.0);
  if (!(p > 0.0)) return glm::dvec3(mean);
  const double determinant = a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz);
  const double angle = std::acos(std::clamp(determinant / (2.0 * p * p * p), -1.0, 1.0)) / 3.0;
  const double largest = mean + 2.0 * p * std::cos(angle);
  const double least = mean + 2.0 * p * std::cos(angle + 2.0 * std::numbers::pi / 3.0);
  return {std::max(least, 0.0), std::max(3.0 * mean - largest - least, 0.0), largest};
}

}  // namespace

std::array<double, 6> PlaneFit::covariance() const {
  const glm::dvec3 m = mean();
  const double by = 1.0 / weight_;
  return {xx_ * by - m.x * m.x, yy_ * by - m.y * m.y, zz_ * by - m.z * m.z,
          xy_ * by - m.x * m.y, xz_ * by - m.x * m.z, yz_ * by - m.y * m.z};
}

glm::dvec3 PlaneFit::variances() const { return eigenvalues(covariance()); }

LeastAxis PlaneFit::least_axis() const {
  const std::array<double, 6> m = covariance();
  LeastAxis found{eigenvalues(m), glm::dvec3(0.0)};
  // The columns of M - least I span what is perpendicular to its eigenvector.
  const double least = found.variance.x;
  const glm::dvec3 x(m[0] - least, m[3], m[4]), y(m[3], m[1] - least, m[5]), z(m[4], m[5], m[2] - least);
  const std::array<glm::dvec3, 3> candidates{glm::cross(x, y), glm::cross(y, z), glm::cross(z, x)};
  const auto longest = std::max_element(
      candidates.begin(), candidates.end(),
      [](const glm::dvec3& a, const glm::dvec3& b) { return glm::dot(a, a) < glm::dot(b, b); });
  const double length = glm::length(*longest);
  if (length > 1e-12 * found.variance.z * found.variance.z) found.axis = *longest / length;
  return found;
}

}  // namespace splatray
