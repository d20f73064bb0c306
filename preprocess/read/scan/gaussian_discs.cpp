#include "preprocess/read/scan/gaussian_discs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/base/srgb.h"

namespace splatray {
namespace {

constexpr double SOLID = 0.5;  // opacity: what hides as much as it lets through

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
  const double radius = solid_deviations * one.deviation_world[wider];
  const double aspect =
      one.deviation_world[wider] / std::max(one.deviation_world[wide], 1e-6 * one.deviation_world[wider]);
  if (!(radius > 0.0)) {
    ++invalid_;
    return;
  }
  points_.position.push_back(one.center_world);
  points_.normal.emplace_back(axes[thin]);
  const glm::vec3 shown(glm::clamp(one.color, 0.0, 1.0));
  points_.color.emplace_back(srgb_to_linear(shown.x), srgb_to_linear(shown.y), srgb_to_linear(shown.z));
  points_.radius.push_back(static_cast<float>(radius));
  points_.ellipse.push_back({glm::vec3(axes[wide]), static_cast<float>(aspect), static_cast<float>(radius)});
}

Points GaussianDiscs::points() {
  points_.up = {0.0, -1.0, 0.0};
  return std::move(points_);
}

std::string GaussianDiscs::note() const {
  const std::uint64_t all = points_.size() + faint_ + invalid_;
  std::string text = "found a capture of 3D Gaussians; " + std::to_string(points_.size()) + " of " +
                     std::to_string(all) + " are discs out to where their opacity is a half, " +
                     std::to_string(faint_) +
                     " are less opaque than that and left out, and colours are those of no direction";
  if (invalid_ > 0)
    text += "; " + std::to_string(invalid_) + " are no Gaussians by their numbers and left out";
  return text;
}

}  // namespace splatray
