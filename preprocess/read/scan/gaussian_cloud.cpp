#include "preprocess/read/scan/gaussian_cloud.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace splatray {
namespace {

constexpr double SOLID = 0.5;          // opacity: what hides as much as it lets through
constexpr double MOST_ALPHA = 0.99;    // Kerbl et al. 2023
constexpr double FAINT = 1.0 / 50.0;   // of alpha: what a pixel hardly shows
constexpr double LEAST_FLAT = 1e-4;    // the least deviation of a Gaussian over its greatest
constexpr double SIGHT_MEDIANS = 2.0;  // how far a ray looks to either side
constexpr int SIGHT_PIECES = 4;        // boxes around the ray, so that they hold little else
constexpr double BLUR_DEVIATIONS = 3.0;
constexpr double NOTHING_LEFT = 1e-3;  // of the light
constexpr double ROUNDING = 1e-6;      // of a float's place, over the size of all

/// R diag(d) R^T
glm::dmat3 along_axes(const Gaussian& one, const glm::dvec3& d) {
  const glm::dmat3 axes = glm::mat3_cast(glm::normalize(one.axes));
  return glm::dmat3(axes[0] * d[0], axes[1] * d[1], axes[2] * d[2]) * glm::transpose(axes);
}

/// The box of the ellipsoid out to so many deviations, with a blur of this deviation.
Bounds box_of(const Gaussian& one, double deviations, double blur_world) {
  const glm::dvec3 deviation = flat_deviations(one);
  const glm::dmat3 covariance = along_axes(one, deviation * deviation + blur_world * blur_world);
  const glm::dvec3 reach =
      deviations * glm::sqrt(glm::dvec3(covariance[0][0], covariance[1][1], covariance[2][2]));
  return {one.center_world - reach, one.center_world + reach};
}

double median_size(const std::vector<Gaussian>& gaussians) {
  std::vector<double> sizes;
  for (const double least_opacity : {SOLID, 0.0}) {
    for (const Gaussian& one : gaussians)
      if (one.opacity >= least_opacity) sizes.push_back(size_of(one));
    if (!sizes.empty()) break;
  }
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle;
}

}  // namespace

double size_of(const Gaussian& one) {
  return std::max({one.deviation_world.x, one.deviation_world.y, one.deviation_world.z});
}

glm::dvec3 flat_deviations(const Gaussian& one) {
  return glm::max(one.deviation_world, glm::dvec3(LEAST_FLAT * size_of(one)));
}

glm::ivec3 axes_by_length(const Gaussian& one) {
  std::array<int, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return one.deviation_world[a] < one.deviation_world[b]; });
  return {order[0], order[1], order[2]};
}

GaussianCloud::GaussianCloud(const std::vector<Gaussian>& gaussians) : median_world_(median_size(gaussians)) {
  std::vector<Bounds> alpha_boxes, blur_boxes;
  std::vector<double> radius_world;
  Bounds all;
  for (const Gaussian& one : gaussians) {
    if (one.opacity <= FAINT) continue;
    parts_.push_back(part_of(one));
    const double most_deviations = std::sqrt(parts_.back().most_deviations_squared);
    alpha_boxes.push_back(box_of(one, most_deviations, 0.0));
    blur_boxes.push_back(box_of(one, BLUR_DEVIATIONS, median_world_));
    radius_world.push_back(most_deviations * size_of(one));
    all.add(alpha_boxes.back());
  }
  if (parts_.empty()) return;
  origin_world_ = all.low;
  for (std::size_t i = 0; i < parts_.size(); ++i)
    balls_.push_back({glm::vec3(parts_[i].center_world - origin_world_),
                      static_cast<float>(radius_world[i] + ROUNDING * longest_side(all))});
  const double finest_world = SIGHT_MEDIANS * median_world_ / SIGHT_PIECES;
  alpha_cells_ = {alpha_boxes, finest_world};
  blur_cells_ = {blur_boxes, finest_world};
}

GaussianCloud::Part GaussianCloud::part_of(const Gaussian& one) const {
  const glm::dvec3 deviation = flat_deviations(one), variance = deviation * deviation;
  const glm::dvec3 blurred = variance + median_world_ * median_world_;
  const glm::dvec3 thinner = deviation / glm::sqrt(blurred);
  return {one.center_world,
          along_axes(one, 1.0 / variance),
          along_axes(one, 1.0 / blurred),
          one.opacity,
          one.opacity * thinner.x * thinner.y * thinner.z,
          one.color,
          2.0 * std::log(one.opacity / FAINT)};
}

std::optional<glm::dvec3> GaussianCloud::outward(const glm::dvec3& place_world) const {
  glm::dvec3 down(0.0);  // against the gradient
  blur_cells_.each_near(place_world, place_world, [&](std::uint32_t i) {
    const Part& part = parts_[i];
    const glm::dvec3 offset = place_world - part.center_world, slope = part.blurred_precision * offset;
    const double deviations_squared = glm::dot(offset, slope);
    if (deviations_squared > BLUR_DEVIATIONS * BLUR_DEVIATIONS) return;
    down += part.blurred_opacity * std::exp(-0.5 * deviations_squared) * slope;
  });
  const double length = glm::length(down);
  if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;
  return down / length;
}

void GaussianCloud::find_near(const glm::dvec3& place_world, const glm::dvec3& direction, double reach_world,
                              Scratch& scratch) const {
  const glm::vec3 place(place_world - origin_world_), along(direction);
  scratch.seen_by.resize(parts_.size());
  ++scratch.search;
  scratch.near.clear();
  const auto end_of = [&](int piece) {
    return place_world + direction * (reach_world * (2.0 * piece / SIGHT_PIECES - 1.0));
  };
  for (int piece = 0; piece < SIGHT_PIECES; ++piece) {
    const glm::dvec3 from = end_of(piece), to = end_of(piece + 1);
    alpha_cells_.each_near(glm::min(from, to), glm::max(from, to), [&](std::uint32_t i) {
      if (scratch.seen_by[i] == scratch.search) return;
      scratch.seen_by[i] = scratch.search;
      const glm::vec3 aside = glm::cross(along, balls_[i].center - place);
      if (glm::dot(aside, aside) <= balls_[i].radius_world * balls_[i].radius_world)
        scratch.near.push_back(i);
    });
  }
}

std::optional<GaussianSight> GaussianCloud::look(const glm::dvec3& place_world, const glm::dvec3& outward,
                                                 Scratch& scratch) const {
  const double reach_world = SIGHT_MEDIANS * median_world_;
  find_near(place_world, outward, reach_world, scratch);
  scratch.hits.clear();
  for (const std::uint32_t i : scratch.near) {
    const Part& part = parts_[i];
    const glm::dvec3 offset = place_world - part.center_world, slope = part.precision * outward;
    const double along = -glm::dot(offset, slope) / glm::dot(outward, slope);
    if (!(std::abs(along) <= reach_world)) continue;
    const glm::dvec3 nearest = offset + along * outward;
    const double deviations_squared = glm::dot(nearest, part.precision * nearest);
    if (deviations_squared >= part.most_deviations_squared) continue;
    const double alpha = std::min(MOST_ALPHA, part.opacity * std::exp(-0.5 * deviations_squared));
    scratch.hits.push_back({along, alpha, i});
  }
  std::sort(scratch.hits.begin(), scratch.hits.end(), [](const Scratch::Hit& a, const Scratch::Hit& b) {
    return a.along_world != b.along_world ? a.along_world > b.along_world : a.gaussian < b.gaussian;
  });
  double left = 1.0, met = 0.0;
  std::optional<double> left_here, surface;
  glm::dvec3 color(0.0);
  for (const Scratch::Hit& hit : scratch.hits) {
    if (!left_here && hit.along_world <= 0.0) left_here = left;
    color += left * hit.alpha * parts_[hit.gaussian].color;
    met += left * hit.alpha;
    left *= 1.0 - hit.alpha;
    if (!surface && left <= SOLID) surface = hit.along_world;
    if (left < NOTHING_LEFT) break;
  }
  if (!surface) return std::nullopt;
  return GaussianSight{left_here.value_or(left), place_world + *surface * outward, color / met};
}

}  // namespace splatray
