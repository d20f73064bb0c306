#include "preprocess/surface/normals.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "preprocess/surface/neighbours.h"

namespace splatray {
namespace {

constexpr std::size_t NEIGHBOURS = 16;
constexpr double ON_A_LINE = 1e-10;  // second variance / first variance: below this the points lie on a line
constexpr double SHEET_FLATNESS =
    1.0 / 3.0;  // least deviation / second least: below this the object is a sheet

/// Eigenvectors (columns) of a symmetric matrix, eigenvalues on the diagonal of `matrix` afterwards; cyclic
/// Jacobi (Golub, Van Loan, "Matrix Computations", sec. 8.5).
glm::dmat3 diagonalise(glm::dmat3& matrix) {
  glm::dmat3 vectors(1.0);
  for (int rotation = 0; rotation < 24; ++rotation) {
    const int p = rotation % 3 == 2 ? 1 : 0;
    const int q = rotation % 3 == 0 ? 1 : 2;
    const double off = matrix[p][q];
    if (off == 0.0) continue;
    const double theta = (matrix[q][q] - matrix[p][p]) / (2.0 * off);
    const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(theta, 1.0));
    const double c = 1.0 / std::sqrt(t * t + 1.0);
    const double s = t * c;
    glm::dmat3 turn(1.0);
    turn[p][p] = turn[q][q] = c;
    turn[p][q] = -s;
    turn[q][p] = s;
    matrix = glm::transpose(turn) * matrix * turn;
    matrix[p][q] = matrix[q][p] = 0.0;
    vectors = vectors * turn;
  }
  return vectors;
}

glm::dvec3 any_perpendicular(const glm::dvec3& axis) {
  const glm::dvec3 a = glm::abs(axis);
  const glm::dvec3 other = a.x <= a.y && a.x <= a.z ? glm::dvec3(1, 0, 0)
                           : a.y <= a.z             ? glm::dvec3(0, 1, 0)
                                                    : glm::dvec3(0, 0, 1);
  return glm::normalize(glm::cross(axis, other));
}

/// The unit vector perpendicular to a unit `axis` that is nearest `up`.
glm::dvec3 perpendicular_nearest(const glm::dvec3& axis, const glm::dvec3& up) {
  const glm::dvec3 across = up - axis * glm::dot(axis, up);
  return glm::length(across) > 1e-3 ? glm::normalize(across) : any_perpendicular(axis);
}

/// Directions and variances of a point set's spread, ascending.
struct Spread {
  std::array<glm::dvec3, 3> axis;
  std::array<double, 3> variance;
  glm::dvec3 mean;
};

template <typename Point>
Spread spread_of(std::span<const Point> points) {
  Spread spread{};
  for (const Point& point : points) spread.mean += glm::dvec3(point);
  const auto count = static_cast<double>(points.size());
  spread.mean /= count;
  glm::dmat3 covariance(0.0);
  for (const Point& point : points) {
    const glm::dvec3 offset = glm::dvec3(point) - spread.mean;
    covariance += glm::outerProduct(offset, offset);
  }
  const glm::dmat3 vectors = diagonalise(covariance);
  std::array<int, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&](int i, int j) { return covariance[i][i] < covariance[j][j]; });
  for (std::size_t i = 0; i < 3; ++i) {
    spread.axis[i] = glm::normalize(vectors[order[i]]);
    spread.variance[i] = covariance[order[i]][order[i]] / count;
  }
  return spread;
}

/// Which way the estimated normals of one object point.
class Sides {
 public:
  Sides(const Cloud& cloud, const glm::dvec3& up)
      : spread_(spread_of(std::span<const glm::vec3>(cloud.coord))) {
    if (glm::dot(spread_.axis[0], up) < 0.0) spread_.axis[0] = -spread_.axis[0];
  }

  [[nodiscard]] bool is_sheet() const {
    return spread_.variance[0] < SHEET_FLATNESS * SHEET_FLATNESS * spread_.variance[1];
  }
  [[nodiscard]] const glm::dvec3& axis() const { return spread_.axis[0]; }

  [[nodiscard]] glm::dvec3 turned(const glm::dvec3& normal, const glm::dvec3& point) const {
    return glm::dot(normal, is_sheet() ? spread_.axis[0] : point - spread_.mean) < 0.0 ? -normal : normal;
  }

 private:
  Spread spread_;
};

}  // namespace

glm::dvec3 plane_normal(std::span<const glm::dvec3> points, const glm::dvec3& up) {
  const Spread spread = spread_of(points);
  if (!(spread.variance[2] > 0.0)) return up;
  if (spread.variance[1] <= ON_A_LINE * spread.variance[2]) return perpendicular_nearest(spread.axis[2], up);
  return spread.axis[0];
}

std::optional<glm::dvec3> sheet_axis(const Cloud& cloud, const glm::dvec3& up) {
  const Sides sides(cloud, up);
  return sides.is_sheet() ? std::optional(sides.axis()) : std::nullopt;
}

std::uint64_t estimate_normals(Cloud& cloud, const glm::dvec3& up, const Stage& stage) {
  const auto unknown =
      numbers_where(cloud.size(), [&](std::size_t i) { return cloud.normal[i] == glm::vec3(0.0F); });
  if (unknown.empty()) return 0;
  const NeighbourSearch search(cloud, Sites::positions);
  const Sides sides(cloud, up);
  parallel_each(stage, unknown.size(), [&](std::size_t n) {
    const glm::vec3 center = cloud.coord[unknown[n]];
    std::array<Neighbour, NEIGHBOURS> nearest;
    const std::size_t count = search.find(center, nearest);
    std::array<glm::dvec3, NEIGHBOURS + 1> points;
    for (std::size_t j = 0; j < count; ++j) points[j] = cloud.coord[nearest[j].index()] - center;
    points[count] = glm::dvec3(0.0);
    const glm::dvec3 normal = plane_normal(std::span(points).first(count + 1), up);
    cloud.normal[unknown[n]] = glm::vec3(sides.turned(normal, glm::dvec3(center)));
  });
  return unknown.size();
}

}  // namespace splatray
