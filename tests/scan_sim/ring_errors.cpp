#include "tests/scan_sim/ring_errors.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "engine/scene/clip.h"
#include "engine/scene/splat.h"
#include "tests/trace/brute_force_tree.h"
#include "tests/trace/rays.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

constexpr double FARTHEST = 40.0;  // world units
constexpr double WRONG_SHARE = 0.07, WRONG = 0.05;
constexpr double LEAST_FACING =
    0.05;  // cosine that a surface is seen at, as far as it shows what is in its plane
constexpr double ABOVE = 3.0;

/// How far off a surface may be shown.
double most_off(double range) { return WRONG_SHARE * range + WRONG; }

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

/// A surface that the sensor looks at.
struct Target {
  dvec3 place;
  double range;
};

/// Directions between a spinner's rings.
class Sights {
 public:
  Sights(const TriangleTree& truth, const Spinner& spinner)
      : truth_(truth),
        spinner_(spinner),
        step_(radians((spinner.highest_deg - spinner.lowest_deg) / (spinner.rings - 1))) {}

  [[nodiscard]] double step() const { return step_; }

  [[nodiscard]] dvec3 dir(double azimuth, double elevation) const {
    return spinner_.axes * dvec3(std::cos(elevation) * std::cos(azimuth),
                                 std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  }

  [[nodiscard]] std::optional<Target> target(double azimuth, double elevation) const {
    const auto hit = truth_.first_hit(spinner_.sensor, dir(azimuth, elevation), FARTHEST);
    if (!hit) return {};
    return Target{spinner_.sensor + hit->distance * dir(azimuth, elevation), hit->distance};
  }

  /// Whether the rings above and below and the columns beside see what lies in one plane, to within what counts as wrong: where
  /// not, a surface ends or bends in between, and the rings do not show where.
  [[nodiscard]] bool goes_on(double azimuth, double elevation) const {
    const dvec3 sight = dir(azimuth, elevation);
    const auto hit = truth_.first_hit(spinner_.sensor, sight);
    const double column = 2.0 * std::numbers::pi / spinner_.columns;
    const double most =
        most_off(hit->distance) * std::max(std::abs(glm::dot(hit->normal, sight)), LEAST_FACING);
    const std::array<std::array<double, 2>, 6> around{{{0.0, step_},
                                                       {0.0, -step_},
                                                       {0.0, 0.5 * step_},
                                                       {0.0, -0.5 * step_},
                                                       {column, 0.0},
                                                       {-column, 0.0}}};
    return std::all_of(around.begin(), around.end(), [&](const std::array<double, 2>& turn) {
      const dvec3 other = dir(azimuth + turn[0], elevation + turn[1]);
      const auto beside = truth_.first_hit(spinner_.sensor, other);
      return beside &&
             std::abs(glm::dot(hit->normal, beside->distance * other - hit->distance * sight)) < most;
    });
  }

 private:
  const TriangleTree& truth_;
  const Spinner& spinner_;
  double step_;
};

RayQuery ray_to(const Scene& scene, const dvec3& eye, const dvec3& place) {
  RayQuery ray{};
  ray.origin = vec3(scene.root.to_root(eye));
  ray.dir = vec3(glm::normalize(place - eye));
  ray.from_object = NO_OBJECT;
  return ray;
}

/// The share of targets that the scene does not show where they are.
double wrong_percent(const Scene& scene, const BruteForceTree& brute, const dvec3& eye,
                     const std::vector<Target>& targets) {
  std::vector<RayQuery> rays;
  for (const Target& target : targets) rays.push_back(ray_to(scene, eye, target.place));
  Settings settings;
  settings.side = SIDE_NONE;
  const std::vector<TrueHit> hits = all_nearest(brute, rays, settings);
  double wrong = 0.0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const double range = glm::distance(eye, targets[i].place);
    const double off = std::abs(hits[i].t * scene.root.unit_world - range);
    wrong += !hits[i].found || off > most_off(range) ? 1.0 : 0.0;
  }
  return 100.0 * wrong / std::max(static_cast<double>(hits.size()), 1.0);
}

/// A splat and how much of the disc's radius and of its width it has.
struct Shape {
  Splat splat;
  std::uint32_t clip = CLIP_NONE;
  dvec3 along{0.0}, across{0.0};  ///< half axes, lattice units
  double area = 0.0;

  Shape(const Scene& scene, std::size_t i) : splat(unpack_splat(scene.data_pool[i])) {
    if (!scene.clip_pool.empty()) clip = scene.clip_pool[i];
    const double radius = std::sqrt(splat.radius_squared);
    double width = radius;
    const TangentFrame frame(splat.normal);
    along = frame.u;
    if (is_ellipse(clip)) {
      const Ellipse ellipse = unpack_ellipse(clip, scene.data_pool[i]);
      const dvec3 in_plane = ellipse.across - splat.normal * glm::dot(splat.normal, ellipse.across);
      along = glm::normalize(in_plane);
      width = radius / std::sqrt(1.0 + ellipse.factor * glm::dot(in_plane, in_plane));
    }
    across = radius * glm::cross(splat.normal, along);
    along *= width;
    area = std::numbers::pi * radius * width;
  }

  [[nodiscard]] bool keeps(const Scene& scene, std::size_t i, const dvec3& offset) const {
    if (clip == CLIP_NONE) return true;
    for (const ClipLine& line : unpack_clip(clip, scene.data_pool[i]))
      if (glm::dot(line.across, offset) > line.limit) return false;
    return true;
  }
};

}  // namespace

double overlap_of(const Scene& scene, std::uint32_t points) {
  const BruteForceTree brute(scene);
  std::vector<double> up_to;
  double area = 0.0;
  for (std::size_t i = 0; i < scene.data_pool.size(); ++i) up_to.push_back(area += Shape(scene, i).area);
  Settings settings;
  settings.side = SIDE_NONE;
  std::vector<double> share(points, 0.0), counted(points, 0.0);
  tbb::parallel_for(0U, points, [&](std::uint32_t n) {
    std::mt19937_64 random(n);
    std::uniform_real_distribution<double> unit;
    const double at = area * (n + unit(random)) / points;
    const auto i = static_cast<std::size_t>(
        std::min<std::ptrdiff_t>(std::upper_bound(up_to.begin(), up_to.end(), at) - up_to.begin(),
                                 static_cast<std::ptrdiff_t>(up_to.size()) - 1));
    const Shape shape(scene, i);
    const double out = 0.999 * std::sqrt(unit(random)), turn = 2.0 * std::numbers::pi * unit(random);
    const dvec3 offset = out * (std::cos(turn) * shape.along + std::sin(turn) * shape.across);
    if (!shape.keeps(scene, i, offset)) return;
    const double height = 0.25 * std::sqrt(shape.splat.radius_squared);
    RayQuery ray{};
    ray.origin = vec3(shape.splat.center + offset + height * shape.splat.normal);
    ray.dir = vec3(-shape.splat.normal);
    ray.from_object = NO_OBJECT;
    const std::size_t met = brute.objects_met(ray, settings, 2.0 * height).size();
    share[n] = 1.0 / std::max(static_cast<double>(met), 1.0);
    counted[n] = 1.0;
  });
  double shares = 0.0, all = 0.0;
  for (std::uint32_t n = 0; n < points; ++n) shares += share[n], all += counted[n];
  return shares > 0.0 ? all / shares : 0.0;
}

RingErrors ring_errors(const Scene& scene, const TriangleTree& truth, const Spinner& spinner,
                       std::uint32_t rays) {
  const Sights sights(truth, spinner);
  const dvec3 above = spinner.sensor + spinner.axes * dvec3(-ABOVE, 0.0, ABOVE);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit;
  const double low = std::sin(radians(spinner.lowest_deg)), high = std::sin(radians(spinner.highest_deg));
  std::vector<Target> targets, from_above;
  double edges = 0.0, all = 0.0;
  for (std::uint32_t n = 0; n < rays; ++n) {
    const double azimuth = 2.0 * std::numbers::pi * unit(random);
    const double elevation = std::asin(low + (high - low) * (n + unit(random)) / rays);
    const auto target = sights.target(azimuth, elevation);
    if (!target) continue;
    all += 1.0;
    if (!sights.goes_on(azimuth, elevation)) {
      edges += 1.0;
      continue;
    }
    targets.push_back(*target);
    const double range = glm::distance(above, target->place);
    const auto seen = truth.first_hit(above, (target->place - above) / range);
    if (seen && std::abs(seen->distance - range) < 1e-3 * range) from_above.push_back(*target);
  }
  const BruteForceTree brute(scene);
  RingErrors errors;
  errors.stripes_percent = wrong_percent(scene, brute, spinner.sensor, targets);
  errors.stripes_above_percent = wrong_percent(scene, brute, above, from_above);
  errors.edges_percent = 100.0 * edges / std::max(all, 1.0);
  errors.overlap = overlap_of(scene, rays);
  return errors;
}

}  // namespace splatray::testing
