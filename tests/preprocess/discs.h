/// The discs and ellipses of a scene as its rays see them, with their clip lines.
#pragma once
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <vector>

#include "engine/scene/clip.h"
#include "engine/scene/scene.h"
#include "engine/scene/splat.h"

namespace splatray::test {

using glm::dvec3;

/// A scene's discs, in world units.
class Discs {
 public:
  explicit Discs(const Scene& scene) : scene_(scene) {}

  /// Whether some disc, where it has not ended, holds a point of a surface that has this normal there.
  [[nodiscard]] bool cover(const dvec3& place, const dvec3& normal) const {
    const dvec3 point = scene_.root.to_root(place);
    for (std::size_t i = 0; i < scene_.data_pool.size(); ++i) {
      const Splat splat = unpack_splat(scene_.data_pool[i]);
      const double cosine = glm::dot(splat.normal, normal);
      if (std::abs(cosine) < 0.9) continue;
      // Where a ray against the normal meets the disc's plane.
      const dvec3 offset =
          point - splat.center - normal * (glm::dot(splat.normal, point - splat.center) / cosine);
      const double height = glm::length(offset - (point - splat.center));
      if (height < 0.2 * std::sqrt(splat.radius_squared) && holds(i, splat, offset)) return true;
    }
    return false;
  }

  /// How far the discs reach at most beyond what `outside` says, in their radii: that is how far a point lies outside, world
  /// units.
  template <typename Outside>
  [[nodiscard]] double overhang(const Outside& outside) const {
    double most = 0.0;
    for (std::size_t i = 0; i < scene_.data_pool.size(); ++i) {
      const Splat splat = unpack_splat(scene_.data_pool[i]);
      const TangentFrame frame(splat.normal);
      const double radius = std::sqrt(splat.radius_squared);
      for (int turn = 0; turn < 48; ++turn) {
        const double angle = 2.0 * M_PI * turn / 48.0;
        const dvec3 dir = std::cos(angle) * frame.u + std::sin(angle) * frame.v;
        for (double share = 1.0; share > 0.0; share -= 0.01) {
          if (!holds(i, splat, share * 0.999 * radius * dir)) continue;
          const dvec3 place = scene_.root.to_world(splat.center + share * 0.999 * radius * dir);
          most = std::max(most, outside(place) / (radius * scene_.root.unit_world));
          break;
        }
      }
    }
    return most;
  }

 private:
  [[nodiscard]] bool holds(std::size_t i, const Splat& splat, const dvec3& offset) const {
    if (glm::dot(offset, offset) > splat.radius_squared) return false;
    if (scene_.clip_pool.empty()) return true;
    if (is_ellipse(scene_.clip_pool[i])) {
      const Ellipse ellipse = unpack_ellipse(scene_.clip_pool[i], scene_.data_pool[i]);
      const double across = glm::dot(ellipse.across, offset);
      if (glm::dot(offset, offset) + ellipse.factor * across * across > splat.radius_squared) return false;
    }
    for (const ClipLine& line : unpack_clip(scene_.clip_pool[i], scene_.data_pool[i]))
      if (glm::dot(line.across, offset) > line.limit) return false;
    return true;
  }

  const Scene& scene_;
};

/// The discs of a scene that is flat, in z = 0, found by their places along x.
class FlatDiscs {
 public:
  explicit FlatDiscs(const Scene& scene) : scene_(scene) {
    for (std::size_t i = 0; i < scene.data_pool.size(); ++i) {
      const Splat splat = unpack_splat(scene.data_pool[i]);
      discs_.push_back({splat, clip_lines(i)});
      widest_ = std::max(widest_, std::sqrt(splat.radius_squared));
    }
    std::sort(discs_.begin(), discs_.end(),
              [](const Disc& a, const Disc& b) { return a.splat.center.x < b.splat.center.x; });
  }

  /// Whether some disc, where it has not ended, holds the place.
  [[nodiscard]] bool cover(const dvec3& place) const {
    const dvec3 point = scene_.root.to_root(place);
    auto disc = std::lower_bound(discs_.begin(), discs_.end(), point.x - widest_,
                                 [](const Disc& one, double x) { return one.splat.center.x < x; });
    for (; disc != discs_.end() && disc->splat.center.x <= point.x + widest_; ++disc) {
      const dvec3 offset = point - disc->splat.center;
      const auto before = [&](const ClipLine& line) { return glm::dot(line.across, offset) <= line.limit; };
      if (offset.x * offset.x + offset.y * offset.y <= disc->splat.radius_squared &&
          std::all_of(disc->lines.begin(), disc->lines.end(), before))
        return true;
    }
    return false;
  }

 private:
  struct Disc {
    Splat splat;
    std::vector<ClipLine> lines;
  };

  [[nodiscard]] std::vector<ClipLine> clip_lines(std::size_t i) const {
    if (scene_.clip_pool.empty()) return {};
    const auto lines = unpack_clip(scene_.clip_pool[i], scene_.data_pool[i]);
    return {lines.begin(), lines.end()};
  }

  const Scene& scene_;
  std::vector<Disc> discs_;
  double widest_ = 0.0;
};

}  // namespace splatray::test
