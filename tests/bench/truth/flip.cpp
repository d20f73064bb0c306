#include "tests/bench/truth/flip.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace splatray::testing {
namespace {

using glm::dmat3;
using glm::dvec3;
using std::numbers::pi;

/// Weights of the neighbours -radius..radius in one direction.
using Kernel = std::vector<double>;

/// A picture of one channel.
struct Plane {
  std::int64_t width;
  std::int64_t height;
  std::vector<double> value;
};

/// Three planes: a picture in an opponent colour space.
using Picture = std::vector<dvec3>;

/// IEC 61966-2-1: linear rgb of primaries with D65 white to XYZ.
const dmat3 XYZ_OF_RGB = glm::transpose(dmat3(0.41239080, 0.35758434, 0.18048079,  //
                                              0.21263901, 0.71516868, 0.07219232,  //
                                              0.01933082, 0.11919478, 0.95053215));
const dvec3 WHITE_XYZ = XYZ_OF_RGB * dvec3(1.0);

double linear_of(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

dvec3 linear_rgb(const glm::vec3& srgb) { return {linear_of(srgb.x), linear_of(srgb.y), linear_of(srgb.z)}; }

/// Paper, sec. 4.1: YCxCz, a linear version of L*a*b*.
dvec3 opponent_of(const dvec3& rgb) {
  const dvec3 xyz = XYZ_OF_RGB * rgb / WHITE_XYZ;
  return {116.0 * xyz.y - 16.0, 500.0 * (xyz.x - xyz.y), 200.0 * (xyz.y - xyz.z)};
}

dvec3 rgb_of_opponent(const dvec3& opponent) {
  const double y = (opponent.x + 16.0) / 116.0;
  const dvec3 xyz(y + opponent.y / 500.0, y, y - opponent.z / 200.0);
  return glm::inverse(XYZ_OF_RGB) * (xyz * WHITE_XYZ);
}

double lab_curve(double x) {
  constexpr double D = 6.0 / 29.0;
  return x > D * D * D ? std::cbrt(x) : x / (3.0 * D * D) + 4.0 / 29.0;
}

/// Paper, sec. 4.1: L*a*b* whose chroma fades with lightness (Hunt effect).
dvec3 hunt_lab(const dvec3& rgb) {
  const dvec3 xyz = XYZ_OF_RGB * rgb / WHITE_XYZ;
  const double x = lab_curve(xyz.x);
  const double y = lab_curve(xyz.y);
  const double z = lab_curve(xyz.z);
  const double lightness = 116.0 * y - 16.0;
  return {lightness, 0.01 * lightness * 500.0 * (x - y), 0.01 * lightness * 200.0 * (y - z)};
}

/// Distance for large colour differences (Abasi et al. 2020).
double hyab(const dvec3& a, const dvec3& b) { return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

Kernel gaussian(std::int64_t radius, double deviation) {
  Kernel kernel;
  for (std::int64_t x = -radius; x <= radius; ++x)
    kernel.push_back(std::exp(-0.5 * double(x * x) / (deviation * deviation)));
  return kernel;
}

double sum_of(const Kernel& kernel) {
  double sum = 0.0;
  for (const double weight : kernel) sum += weight;
  return sum;
}

void scale(Kernel& kernel, double by) {
  for (double& weight : kernel) weight *= by;
}

/// The positive weights then sum to 1 and the negative ones, if any, to -1.
void normalise_signs(Kernel& kernel) {
  double positive = 0.0;
  double negative = 0.0;
  for (const double weight : kernel) (weight > 0.0 ? positive : negative) += std::abs(weight);
  for (double& weight : kernel) weight /= weight > 0.0 ? positive : std::max(negative, 1e-300);
}

/// Correlates rows with `along_x` and columns with `along_y`; beyond its borders the picture repeats them.
Plane filtered(const Plane& plane, const Kernel& along_x, const Kernel& along_y) {
  assert(along_x.size() == along_y.size());
  const auto radius = static_cast<std::int64_t>(along_x.size() / 2);
  Plane rows{plane.width, plane.height, std::vector<double>(plane.value.size())};
  Plane result = rows;
  auto pass = [&](const Plane& from, Plane& to, const Kernel& kernel, bool vertical) {
    for (std::int64_t y = 0; y < plane.height; ++y)
      for (std::int64_t x = 0; x < plane.width; ++x) {
        double sum = 0.0;
        for (std::int64_t i = -radius; i <= radius; ++i) {
          const std::int64_t at_x = vertical ? x : std::clamp<std::int64_t>(x + i, 0, plane.width - 1);
          const std::int64_t at_y = vertical ? std::clamp<std::int64_t>(y + i, 0, plane.height - 1) : y;
          sum += kernel[std::size_t(i + radius)] * from.value[std::size_t(at_y * plane.width + at_x)];
        }
        to.value[std::size_t(y * plane.width + x)] = sum;
      }
  };
  pass(plane, rows, along_x, false);
  pass(rows, result, along_y, true);
  return result;
}

Plane channel_of(const Picture& picture, std::int64_t width, std::int64_t height, int channel) {
  Plane plane{width, height, {}};
  for (const dvec3& pixel : picture) plane.value.push_back(pixel[channel]);
  return plane;
}

/// One term a sqrt(pi / b) exp(-pi^2 x^2 / b) of a contrast sensitivity function, x in degrees.
struct SensitivityTerm {
  double a;
  double b;
};

/// The paper's table 1: achromatic, red-green, blue-yellow.
const std::vector<std::vector<SensitivityTerm>> SENSITIVITIES = {
    {{1.0, 0.0047}}, {{1.0, 0.0053}}, {{34.1, 0.04}, {13.5, 0.025}}};
constexpr double WIDEST_B = 0.04;

/// Paper, sec. 4.1: what of the picture the eye resolves.
Picture as_seen(const Picture& opponent, std::int64_t width, std::int64_t height, double pixels_per_degree) {
  const auto radius =
      static_cast<std::int64_t>(std::ceil(3.0 * std::sqrt(WIDEST_B / (2.0 * pi * pi)) * pixels_per_degree));
  Picture seen(opponent.size(), dvec3(0.0));
  for (int channel = 0; channel < 3; ++channel) {
    const Plane plane = channel_of(opponent, width, height, channel);
    double total = 0.0;
    for (const auto& [a, b] : SENSITIVITIES[std::size_t(channel)]) {
      const Kernel kernel = gaussian(radius, std::sqrt(b / (2.0 * pi * pi)) * pixels_per_degree);
      const double height_of_term = a * std::sqrt(pi / b);
      total += height_of_term * sum_of(kernel) * sum_of(kernel);
      const Plane part = filtered(plane, kernel, kernel);
      for (std::size_t i = 0; i < seen.size(); ++i) seen[i][channel] += height_of_term * part.value[i];
    }
    for (dvec3& pixel : seen) pixel[channel] /= total;
  }
  return seen;
}

/// Paper, sec. 4.1: the colour error, compressed and spread so that most of 0..1 is for small errors.
double color_error(const dvec3& seen_a, const dvec3& seen_b) {
  constexpr double EXPONENT = 0.7;
  constexpr double SHARE_OF_MOST = 0.4;
  constexpr double SHARE_OF_RANGE = 0.95;
  static const double MOST =
      std::pow(hyab(hunt_lab(dvec3(0.0, 1.0, 0.0)), hunt_lab(dvec3(0.0, 0.0, 1.0))), EXPONENT);
  auto lab_of = [](const dvec3& seen) {
    return hunt_lab(glm::clamp(rgb_of_opponent(seen), dvec3(0.0), dvec3(1.0)));
  };
  const double error = std::pow(hyab(lab_of(seen_a), lab_of(seen_b)), EXPONENT);
  const double knee = SHARE_OF_MOST * MOST;
  if (error < knee) return error * SHARE_OF_RANGE / knee;
  return SHARE_OF_RANGE + (error - knee) / (MOST - knee) * (1.0 - SHARE_OF_RANGE);
}

/// Strength of the edges or points at each pixel.
std::vector<double> strength(const Plane& lightness, const Kernel& along, const Kernel& across) {
  const Plane x = filtered(lightness, along, across);
  const Plane y = filtered(lightness, across, along);
  std::vector<double> result;
  for (std::size_t i = 0; i < x.value.size(); ++i) result.push_back(std::hypot(x.value[i], y.value[i]));
  return result;
}

/// What the paper's sec. 4.2 compares of each picture.
struct Features {
  std::vector<double> edges;
  std::vector<double> points;
};

Features features_of(const Picture& opponent, std::int64_t width, std::int64_t height,
                     double pixels_per_degree) {
  constexpr double EDGE_WIDTH_DEG = 0.082;
  const double deviation = 0.5 * EDGE_WIDTH_DEG * pixels_per_degree;
  const auto radius = static_cast<std::int64_t>(std::ceil(3.0 * deviation));
  Kernel smooth = gaussian(radius, deviation);
  Kernel first = smooth;
  Kernel second = smooth;
  for (std::int64_t x = -radius; x <= radius; ++x) {
    first[std::size_t(x + radius)] *= -double(x);
    second[std::size_t(x + radius)] *= double(x * x) / (deviation * deviation) - 1.0;
  }
  scale(smooth, 1.0 / sum_of(smooth));
  normalise_signs(first);
  normalise_signs(second);
  Plane lightness = channel_of(opponent, width, height, 0);
  for (double& y : lightness.value) y = (y + 16.0) / 116.0;
  return {strength(lightness, first, smooth), strength(lightness, second, smooth)};
}

}  // namespace

double flip_mean(const std::vector<glm::vec3>& a_srgb, const std::vector<glm::vec3>& b_srgb,
                 std::uint32_t width, std::uint32_t height, double pixels_per_degree) {
  assert(a_srgb.size() == std::size_t(width) * height && b_srgb.size() == a_srgb.size() && !a_srgb.empty());
  auto opponent = [](const std::vector<glm::vec3>& srgb) {
    Picture picture;
    for (const glm::vec3& pixel : srgb) picture.push_back(opponent_of(linear_rgb(pixel)));
    return picture;
  };
  const Picture a = opponent(a_srgb);
  const Picture b = opponent(b_srgb);
  const Picture seen_a = as_seen(a, width, height, pixels_per_degree);
  const Picture seen_b = as_seen(b, width, height, pixels_per_degree);
  const Features of_a = features_of(a, width, height, pixels_per_degree);
  const Features of_b = features_of(b, width, height, pixels_per_degree);
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double feature_error = std::sqrt(
        std::max(std::abs(of_a.edges[i] - of_b.edges[i]), std::abs(of_a.points[i] - of_b.points[i])) /
        std::numbers::sqrt2);
    sum += std::pow(color_error(seen_a[i], seen_b[i]), 1.0 - feature_error);
  }
  return sum / static_cast<double>(a.size());
}

}  // namespace splatray::testing
