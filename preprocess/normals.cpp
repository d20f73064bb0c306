#include "preprocess/normals.h"

#include <array>
#include <cmath>

#include "preprocess/neighbours.h"

namespace splatray {
namespace {

constexpr std::size_t NEIGHBOURS = 16;
constexpr double STRAIGHT = 1e-10;  // second variance / first variance: below this the points lie on a line
constexpr double FLAT = 1.0 / 3.0;  // thinnest extent / second thinnest: below this the object is a sheet

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

/// Which way the estimated normals of one object point.
class Sides {
 public:
  explicit Sides(const Cloud& cloud) {
    glm::dvec3 low(1.0);
    glm::dvec3 high(-1.0);
    glm::dvec3 sum(0.0);
    for (const glm::vec3& coord : cloud.coord) {
      low = glm::min(low, glm::dvec3(coord));
      high = glm::max(high, glm::dvec3(coord));
      sum += glm::dvec3(coord);
    }
    centroid_ = sum / static_cast<double>(cloud.size());
    const glm::dvec3 extent = high - low;
    const int thin = extent.x < extent.y ? (extent.x < extent.z ? 0 : 2) : (extent.y < extent.z ? 1 : 2);
    const double second = std::min(extent[(thin + 1) % 3], extent[(thin + 2) % 3]);
    if (extent[thin] < FLAT * second) sheet_axis_[thin] = 1.0;
  }

  [[nodiscard]] glm::dvec3 turned(const glm::dvec3& normal, const glm::dvec3& point) const {
    const bool is_sheet = sheet_axis_ != glm::dvec3(0.0);
    return glm::dot(normal, is_sheet ? sheet_axis_ : point - centroid_) < 0.0 ? -normal : normal;
  }

 private:
  glm::dvec3 centroid_{0.0};
  glm::dvec3 sheet_axis_{0.0};  // zero: not a sheet
};

}  // namespace

glm::dvec3 plane_normal(std::span<const glm::dvec3> points, const glm::dvec3& up) {
  glm::dvec3 mean(0.0);
  for (const glm::dvec3& point : points) mean += point;
  mean /= static_cast<double>(points.size());
  glm::dmat3 covariance(0.0);
  for (const glm::dvec3& point : points) covariance += glm::outerProduct(point - mean, point - mean);
  const glm::dmat3 vectors = diagonalise(covariance);
  std::array<int, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&](int a, int b) { return covariance[a][a] < covariance[b][b]; });
  const double largest = covariance[order[2]][order[2]];
  if (!(largest > 0.0)) return up;
  if (covariance[order[1]][order[1]] <= STRAIGHT * largest)
    return perpendicular_nearest(vectors[order[2]], up);
  return glm::normalize(vectors[order[0]]);
}

std::uint64_t estimate_normals(Cloud& cloud, const glm::dvec3& up, const Stage& stage) {
  std::vector<std::uint32_t> unknown;
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    if (cloud.normal[i] == glm::vec3(0.0F)) unknown.push_back(i);
  }
  if (unknown.empty()) return 0;
  const NeighbourSearch search(cloud, Sites::positions);
  const Sides sides(cloud);
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
