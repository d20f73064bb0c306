#include "preprocess/scan/plane_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/base/vector_clones.h"

namespace splatray {
namespace {

/// Sums over places, some in each lane.
struct LaneSums {
  Lanes x{}, y{}, z{}, xx{}, yy{}, zz{}, xy{}, xz{}, yz{};

  [[gnu::always_inline]] void add(const Lanes& dx, const Lanes& dy, const Lanes& dz) {
    x += dx, y += dy, z += dz;
    xx += dx * dx, yy += dy * dy, zz += dz * dz;
    xy += dx * dy, xz += dx * dz, yz += dy * dz;
  }
};

/// Sums c[0] + c[1] x + ... (Horner's rule).
template <std::size_t COUNT>
double polynomial(const double (&c)[COUNT], double x) {
  double sum = c[COUNT - 1];
  for (std::size_t i = COUNT - 1; i-- > 0;) sum = sum * x + c[i];
  return sum;
}

/// Cosine and sine of a third of an angle between 0 and half a turn, given its cosine, to 4e-9. With s, the cosine of half the
/// angle, they are cos(2/3 acos s) and sin(2/3 acos s); the first, and the second over the root of 1 - s, are smooth, so that
/// polynomials (at Chebyshev's nodes) do.
std::array<double, 2> third_of(double cosine) {
  static constexpr double COSINE[] = {0.5000000033,  0.5773497198,   -0.1110956833,
                                      0.05328865599, -0.0319612954,  0.01967571807,
                                      -0.0103254929, 0.003707686365, -0.0006393143375};
  static constexpr double SINE[] = {0.866025405,     0.09967915766,  -0.03435130508,
                                    0.01847848993,   -0.01161663884, 0.007319808831,
                                    -0.003887509444, 0.001404662775, -0.0002430302127};
  const double s = std::sqrt(0.5 * (1.0 + cosine));
  const double beyond = 0.5 * (1.0 - cosine) / (1.0 + s);  // 1 - s
  return {polynomial(COSINE, s), std::sqrt(beyond) * polynomial(SINE, s)};
}

}  // namespace

SPLATRAY_VECTOR_CLONES Covariance covariance_of(const Offsets& offsets, std::size_t count) {
  LaneSums sums;
  Lanes x, y, z;
  std::size_t j = 0;
  for (; j + LANES <= count; j += LANES) {
    load_lanes(offsets.x + j, x), load_lanes(offsets.y + j, y), load_lanes(offsets.z + j, z);
    sums.add(x, y, z);
  }
  if (j < count) {
    x = y = z = Lanes{};
    for (std::size_t k = 0; j + k < count; ++k)
      x[k] = offsets.x[j + k], y[k] = offsets.y[j + k], z[k] = offsets.z[j + k];
    sums.add(x, y, z);
  }
  const double by = 1.0 / static_cast<double>(count + 1);
  const double mx = by * sum_lanes(sums.x), my = by * sum_lanes(sums.y), mz = by * sum_lanes(sums.z);
  return {by * sum_lanes(sums.xx) - mx * mx, by * sum_lanes(sums.yy) - my * my,
          by * sum_lanes(sums.zz) - mz * mz, by * sum_lanes(sums.xy) - mx * my,
          by * sum_lanes(sums.xz) - mx * mz, by * sum_lanes(sums.yz) - my * mz};
}

glm::dvec3 variances_of(const Covariance& covariance) {
  const auto [xx, yy, zz, xy, xz, yz] = covariance;
  const double mean = (xx + yy + zz) / 3.0;
  const double a = xx - mean, b = yy - mean, c = zz - mean;
  const double off = xy * xy + xz * xz + yz * yz;
  const double p = std::sqrt((a * a + b * b + c * c + 2.0 * off) / 6.0);
  if (!(p > 0.0)) return glm::dvec3(mean);
  const double determinant = a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz);
  const double cosine = std::clamp(determinant / (2.0 * p * p * p), -1.0, 1.0);  // of three times the angle
  const auto [along, across] = third_of(cosine);
  const double largest = mean + 2.0 * p * along;
  const double least = mean - p * (along + std::numbers::sqrt3 * across);
  return {std::max(least, 0.0), std::max(3.0 * mean - largest - least, 0.0), largest};
}

glm::dvec3 least_axis_of(const Covariance& covariance, const glm::dvec3& variances) {
  const auto [xx, yy, zz, xy, xz, yz] = covariance;
  // The columns of M - least I span what is perpendicular to its eigenvector.
  const double least = variances.x;
  const glm::dvec3 x(xx - least, xy, xz), y(xy, yy - least, yz), z(xz, yz, zz - least);
  const std::array<glm::dvec3, 3> candidates{glm::cross(x, y), glm::cross(y, z), glm::cross(z, x)};
  const auto longest = std::max_element(
      candidates.begin(), candidates.end(),
      [](const glm::dvec3& a, const glm::dvec3& b) { return glm::dot(a, a) < glm::dot(b, b); });
  const double length = glm::length(*longest);
  return length > 1e-12 * variances.z * variances.z ? *longest / length : glm::dvec3(0.0);
}

}  // namespace splatray
