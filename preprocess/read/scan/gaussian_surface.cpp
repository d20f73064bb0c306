#include "preprocess/read/scan/gaussian_surface.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/srgb.h"
#include "preprocess/base/bounds.h"

namespace splatray {
namespace {

constexpr double MEDIAN_PLACES = 1.5;  // on each side of a Gaussian of the median area
constexpr double MOST_PLACES = 24.0;
constexpr double SPREAD_DEVIATIONS = 1.2;
constexpr double SIDE_DEVIATIONS = 0.5;  // across its least deviation, so that either side has its gradient
constexpr double LEAST_LEFT = 0.3;       // of the light at a place that is seen
constexpr double DEEP = 0.03;            // of that light
constexpr std::size_t SLICE = std::size_t{1} << 14;  // Gaussians at a time, whose points are then joined

struct SurfacePoint {
  glm::dvec3 place_world;
  glm::vec3 normal, color;
};

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x + v.y + v.z); }

bool is_valid(const Gaussian& one) {
  const double least = std::min({one.deviation_world.x, one.deviation_world.y, one.deviation_world.z});
  const double turn = glm::dot(one.axes, one.axes);
  return is_finite(one.center_world) && is_finite(one.color) && is_finite(one.deviation_world) &&
         least >= 0.0 && size_of(one) > 0.0 && one.opacity >= 0.0 && one.opacity <= 1.0 &&
         std::isfinite(turn) && turn > 0.0;
}

glm::vec3 linear_color(const glm::dvec3& encoded) {
  const glm::vec3 shown(glm::clamp(encoded, 0.0, 1.0));
  return {srgb_to_linear(shown.x), srgb_to_linear(shown.y), srgb_to_linear(shown.z)};
}

/// The area of the ellipse that its two greater deviations span, over pi.
double area_of(const Gaussian& one) {
  const glm::ivec3 order = axes_by_length(one);
  return one.deviation_world[order[1]] * one.deviation_world[order[2]];
}

double median_area(const std::vector<Gaussian>& gaussians) {
  std::vector<double> areas(gaussians.size());
  std::transform(gaussians.begin(), gaussians.end(), areas.begin(), area_of);
  const auto middle = areas.begin() + static_cast<std::ptrdiff_t>(areas.size() / 2);
  std::nth_element(areas.begin(), middle, areas.end());
  return *middle;
}

/// The points that one shows, looked at `places` times on each side.
std::vector<SurfacePoint> look_at(const GaussianCloud& cloud, const Gaussian& one, int places,
                                  GaussianCloud::Scratch& scratch) {
  const glm::dmat3 axes = glm::mat3_cast(glm::normalize(one.axes));
  const glm::ivec3 order = axes_by_length(one);
  const glm::dvec3 deviation_world = flat_deviations(one);
  const auto along = [&](int i) { return axes[order[i]] * deviation_world[order[i]]; };
  constexpr double GOLDEN_ANGLE = 2.0 * std::numbers::pi * (2.0 - std::numbers::phi);
  std::vector<SurfacePoint> points;
  for (const double side : {SIDE_DEVIATIONS, -SIDE_DEVIATIONS})
    for (int i = 0; i < places; ++i) {
      // A sunflower's seeds lie evenly in a circle (Vogel 1979).
      const double radius = SPREAD_DEVIATIONS * std::sqrt(1.0 * i / places), angle = i * GOLDEN_ANGLE;
      const glm::dvec3 place = one.center_world + along(0) * side +
                               radius * (along(1) * std::cos(angle) + along(2) * std::sin(angle));
      const std::optional<glm::dvec3> outward = cloud.outward(place);
      const auto sight = outward ? cloud.look(place, *outward, scratch) : std::nullopt;
      if (sight && sight->share_left >= LEAST_LEFT)
        points.push_back({sight->surface_world, glm::vec3(*outward), linear_color(sight->color)});
      else if (i == 0 && sight && sight->share_left < DEEP)
        break;  // its whole side is inside, or is shown by its neighbours
    }
  return points;
}

}  // namespace

void GaussianSurface::add(const Gaussian& one) {
  ++count_;
  if (is_valid(one))
    gaussians_.push_back(one);
  else
    ++invalid_;
}

void GaussianSurface::leave_out_vast() {
  Bounds box;
  for (const Gaussian& one : gaussians_) box.add(one.center_world);
  if (gaussians_.size() > 1)
    vast_ = std::erase_if(
        gaussians_, [&](const Gaussian& one) { return size_of(one) > glm::distance(box.low, box.high); });
}

Points GaussianSurface::take(const Stage& stage) {
  leave_out_vast();
  Points points;
  points.up = {0.0, -1.0, 0.0};
  if (gaussians_.empty()) return points;
  const GaussianCloud cloud(gaussians_);
  const double place_area = median_area(gaussians_) / MEDIAN_PLACES;
  tbb::enumerable_thread_specific<GaussianCloud::Scratch> scratch;
  std::vector<std::vector<SurfacePoint>> found;
  for (std::size_t begin = 0; begin < gaussians_.size(); begin += SLICE) {
    stage.report(static_cast<double>(begin) / static_cast<double>(gaussians_.size()));
    found.assign(std::min(SLICE, gaussians_.size() - begin), {});
    tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t i) {
      const Gaussian& one = gaussians_[begin + i];
      const double places = std::ceil(std::min(area_of(one) / place_area, MOST_PLACES));
      found[i] = look_at(cloud, one, std::max(static_cast<int>(places), 1), scratch.local());
    });
    for (const std::vector<SurfacePoint>& of_one : found)
      for (const SurfacePoint& point : of_one) {
        points.position.push_back(point.place_world);
        points.normal.push_back(point.normal);
        points.color.push_back(point.color);
      }
  }
  points_ = points.size();
  return points;
}

std::string GaussianSurface::note() const {
  const auto some = [](std::uint64_t count, const char* are) {
    return count > 0 ? "; " + std::to_string(count) + ' ' + are + " and left out" : std::string();
  };
  return "found a capture of " + std::to_string(count_) + " 3D Gaussians; " + std::to_string(points_) +
         " points stand where they hide half of what lies behind, in colours of no direction" +
         some(vast_, "are wider than all lie apart") + some(invalid_, "are no Gaussians by their numbers");
}

}  // namespace splatray
