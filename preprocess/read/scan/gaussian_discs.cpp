#include "preprocess/read/scan/gaussian_discs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/base/srgb.h"
#include "engine/scene/clip.h"
#include "preprocess/base/bounds.h"
#include "preprocess/base/parallel.h"
#include "preprocess/base/point_arrays.h"

namespace splatray {
namespace {

constexpr double SOLID = 0.5;        // opacity: what hides as much as it lets through
constexpr double MOST_ASPECT = 1e6;  // of a disc, so that it has a width

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x + v.y + v.z); }

bool is_valid(const Gaussian& one) {
  const double least = std::min({one.deviation_world.x, one.deviation_world.y, one.deviation_world.z});
  return is_finite(one.center_world) && is_finite(one.color) && is_finite(one.deviation_world) &&
         least >= 0.0 && one.opacity >= 0.0 && std::isfinite(glm::dot(one.axes, one.axes)) &&
         glm::dot(one.axes, one.axes) > 0.0;
}

/// The numbers of the axes from the shortest to the longest.
std::array<int, 3> axes_by_length(const glm::dvec3& deviation) {
  std::array<int, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return deviation[a] < deviation[b]; });
  return order;
}

}  // namespace

void GaussianDiscs::reserve(std::size_t count) {
  points_.position.reserve(count);
  points_.normal.reserve(count);
  points_.color.reserve(count);
  points_.radius.reserve(count);
  points_.ellipse.reserve(count);
}

void GaussianDiscs::add(const Gaussian& one) {
  if (!is_valid(one)) {
    ++invalid_;
    return;
  }
  if (!(one.opacity > SOLID)) {
    ++faint_;
    return;
  }
  const glm::dmat3 axes = glm::mat3_cast(glm::normalize(one.axes));
  const auto [thin, wide, wider] = axes_by_length(one.deviation_world);
  const double solid_deviations = std::sqrt(2.0 * std::log(std::min(one.opacity, 1.0) / SOLID));
  const double half_length = solid_deviations * one.deviation_world[wider],
               half_width = std::max(solid_deviations * one.deviation_world[wide], half_length / MOST_ASPECT);
  const bool is_round = half_length < LEAST_ASPECT * half_width;
  const auto radius = static_cast<float>(is_round ? std::sqrt(half_length * half_width) : half_length);
  if (!(radius > 0.0F)) {
    ++invalid_;
    return;
  }
  points_.position.push_back(one.center_world);
  points_.normal.emplace_back(axes[thin]);
  const glm::vec3 shown(glm::clamp(one.color, 0.0, 1.0));
  points_.color.emplace_back(srgb_to_linear(shown.x), srgb_to_linear(shown.y), srgb_to_linear(shown.z));
  points_.radius.push_back(radius);
  points_.ellipse.push_back(
      is_round ? PointEllipse{}
               : PointEllipse{glm::vec3(axes[wide]), static_cast<float>(half_length / half_width), radius});
}

Points GaussianDiscs::take() {
  Bounds box;
  for (const glm::dvec3& place : points_.position) box.add(place);
  const auto kept = numbers_where(points_.size(), [&](std::size_t i) {
    return points_.size() == 1 || points_.radius[i] <= glm::distance(box.low, box.high);
  });
  discs_ = kept.size();
  vast_ = points_.size() - discs_;
  for_each_array(points_, [&](auto& values) {
    if (vast_ > 0 && !values.empty()) values = gather(values, kept);
  });
  points_.up = {0.0, -1.0, 0.0};
  return std::move(points_);
}

std::string GaussianDiscs::note() const {
  const auto some = [](std::uint64_t count, const char* are) {
    return count > 0 ? "; " + std::to_string(count) + ' ' + are + " and left out" : std::string();
  };
  return "found a capture of 3D Gaussians; " + std::to_string(discs_) + " of " +
         std::to_string(discs_ + vast_ + faint_ + invalid_) +
         " are discs out to where their opacity is a half, in colours of no direction" +
         some(faint_, "are less opaque than that in their centre") +
         some(vast_, "are wider than all lie apart") + some(invalid_, "are no Gaussians by their numbers");
}

}  // namespace splatray
