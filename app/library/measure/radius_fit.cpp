#include "app/library/measure/radius_fit.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/library/measure/least_squares.h"

namespace splatray {
namespace {

constexpr std::size_t LEAST_POINTS = 8;
constexpr int STEPS = 40, ROUNDS = 4;
constexpr double FAR_OFF = 3.0;      ///< standard deviations
constexpr double MOST_RADII = 50.0;  ///< a radius in sizes of what it is fitted to: a plane

using Points = std::vector<glm::dvec3>;

/// What a fit starts from and works on.
struct Patch {
  Points points, normals;
  glm::dvec3 middle{0.0};
  double size = 0.0;  ///< root of the mean square of the distances from the middle

  void measure() {
    middle = glm::dvec3(0.0);
    for (const glm::dvec3& point : points) middle += point / static_cast<double>(points.size());
    double sum = 0.0;
    for (const glm::dvec3& point : points) sum += glm::dot(point - middle, point - middle);
    size = std::sqrt(sum / static_cast<double>(points.size()));
  }
};

/// The point from which all normals' lines pass least, in the plane across `axis` where there is one.
std::optional<glm::dvec3> center_of_normals(const Patch& patch, const glm::dvec3& axis) {
  LeastSquares<3> sums;
  for (std::size_t i = 0; i < patch.points.size(); ++i) {
    glm::dvec3 n = patch.normals[i] - glm::dot(patch.normals[i], axis) * axis;
    if (!(glm::length(n) > 0.1)) continue;
    n = glm::normalize(n);
    const glm::dvec3 to = patch.points[i] - patch.middle;
    for (int row = 0; row < 3; ++row) {
      std::array<double, 3> across{-n[0] * n[row], -n[1] * n[row], -n[2] * n[row]};
      across[static_cast<std::size_t>(row)] += 1.0;
      sums.add(across, to[row] - glm::dot(to, n) * n[row]);
    }
  }
  // A cylinder's axis leaves the place along it open.
  if (axis != glm::dvec3(0.0))
    sums.add({axis.x, axis.y, axis.z}, 0.0, static_cast<double>(patch.points.size()));
  const auto found = sums.solve();
  if (!found) return {};
  return patch.middle + glm::dvec3((*found)[0], (*found)[1], (*found)[2]);
}

/// The direction that normals have least of.
glm::dvec3 axis_of_normals(const Points& normals) {
  glm::dmat3 sums(0.0);
  for (const glm::dvec3& n : normals) sums += glm::outerProduct(n, n);
  // Inverse iteration; what the normals lack decides, however little of it there is.
  const double shift = 1e-9 * (sums[0][0] + sums[1][1] + sums[2][2]);
  const glm::dmat3 inverse = glm::inverse(sums + glm::dmat3(shift));
  glm::dvec3 axis(0.577, 0.578, 0.576);
  for (int i = 0; i < 60; ++i) axis = glm::normalize(inverse * axis);
  return axis;
}

double distance_off(const RadiusFit& fit, const glm::dvec3& point) {
  const glm::dvec3 to = point - fit.center;
  return glm::length(to - glm::dot(to, fit.axis) * fit.axis) - fit.radius;
}

/// Gauss-Newton of a sphere (N = 4: centre, radius) or cylinder (N = 5: centre across, axis, radius).
template <std::size_t N>
std::optional<RadiusFit> refine(const Patch& patch, RadiusFit fit) {
  const bool cylinder = N == 5;
  for (int step = 0; step < STEPS; ++step) {
    const glm::dvec3 any = std::abs(fit.axis.x) < 0.6 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 u = cylinder ? glm::normalize(glm::cross(fit.axis, any)) : glm::dvec3(0.0);
    const glm::dvec3 v = glm::cross(fit.axis, u);
    LeastSquares<N> sums;
    double squares = 0.0;
    for (const glm::dvec3& point : patch.points) {
      const glm::dvec3 to = point - fit.center;
      const double along = glm::dot(to, fit.axis);
      const glm::dvec3 out = to - along * fit.axis;
      const double length = glm::length(out);
      if (!(length > 0.0)) continue;
      const glm::dvec3 n = out / length;
      const double off = length - fit.radius;
      squares += off * off;
      std::array<double, N> row;
      if constexpr (cylinder)
        row = {glm::dot(n, u), glm::dot(n, v), along * glm::dot(n, u), along * glm::dot(n, v), 1.0};
      else
        row = {n.x, n.y, n.z, 1.0};
      sums.add(row, off);
    }
    const auto change = sums.solve();
    const auto variance = sums.variance(N - 1);
    if (!change || !variance) return {};
    const auto& x = *change;
    fit.radius += x[N - 1];
    if constexpr (cylinder) {
      fit.center += x[0] * u + x[1] * v;
      fit.axis = glm::normalize(fit.axis + x[2] * u + x[3] * v);
      fit.center += glm::dot(patch.middle - fit.center, fit.axis) * fit.axis;
    } else {
      fit.center += glm::dvec3(x[0], x[1], x[2]);
    }
    const double count = static_cast<double>(patch.points.size());
    fit.residual = std::sqrt(squares / count);
    fit.radius_error = std::sqrt(*variance * squares / std::max(count - static_cast<double>(N), 1.0));
    if (!(fit.radius > 0.0 && fit.radius < MOST_RADII * patch.size)) return {};
    double most = 0.0;
    for (const double value : x) most = std::max(most, std::abs(value));
    if (most < 1e-12 * patch.size) break;
  }
  fit.points = patch.points.size();
  return fit;
}

template <std::size_t N>
std::optional<RadiusFit> fitted(std::span<const glm::dvec3> points, std::span<const glm::dvec3> normals) {
  Patch patch{{points.begin(), points.end()}, {normals.begin(), normals.end()}};
  std::optional<RadiusFit> fit;
  for (int round = 0; round < ROUNDS; ++round) {
    if (patch.points.size() < LEAST_POINTS) return {};
    patch.measure();
    if (!fit) {
      RadiusFit start;
      if (N == 5) start.axis = axis_of_normals(patch.normals);
      const auto center = center_of_normals(patch, start.axis);
      if (!center) return {};
      start.center = *center;
      for (const glm::dvec3& point : patch.points)
        start.radius += distance_off({.center = start.center, .axis = start.axis}, point) /
                        static_cast<double>(patch.points.size());
      fit = start;
    }
    fit = refine<N>(patch, *fit);
    if (!fit) return {};
    Patch kept;
    for (std::size_t i = 0; i < patch.points.size(); ++i) {
      if (std::abs(distance_off(*fit, patch.points[i])) > FAR_OFF * fit->residual) continue;
      kept.points.push_back(patch.points[i]);
      kept.normals.push_back(patch.normals[i]);
    }
    if (kept.points.size() == patch.points.size()) break;
    patch = std::move(kept);
  }
  return fit;
}

}  // namespace

std::optional<RadiusFit> fit_sphere(std::span<const glm::dvec3> points, std::span<const glm::dvec3> normals) {
  return fitted<4>(points, normals);
}

std::optional<RadiusFit> fit_cylinder(std::span<const glm::dvec3> points,
                                      std::span<const glm::dvec3> normals) {
  return fitted<5>(points, normals);
}

}  // namespace splatray
