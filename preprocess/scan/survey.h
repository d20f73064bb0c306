/// One look at what surrounds every point of a scan.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "preprocess/base/parallel.h"
#include "preprocess/surface/cloud.h"
#include "preprocess/surface/near_places.h"

namespace splatray {

/// The nearest places of every point, and what one search finds of them. In the cloud's coordinates and order.
struct Survey {
  static constexpr std::size_t LISTED = NearPlaces::LISTED;
  static constexpr std::size_t RING = 8;  ///< the place whose distance gives the local spacing

  static constexpr std::size_t WIDE = 32;

  static constexpr float FLAT = 0.35F;  ///< the flatness of a surface, at most

  std::unique_ptr<NearPlaces> near;
  std::vector<float> reach;  ///< distance to the RING-th place
  std::vector<float> wide;   ///< distance to the WIDE-th place, or what it is on a surface of even density
  std::vector<std::uint8_t> estimated;  ///< whether the normal was unknown before
  std::vector<std::uint8_t> sided;      ///< whether the normal's side is that of a given one; empty = of none
  /// Least deviation over the second, of the flattest neighbourhood that does not lie along a line, where the normal was
  /// unknown, else 0; infinite on a line. Empty where all normals were given.
  std::vector<float> flatness;
  glm::vec3 step{0.0F};  ///< coordinate_step, where any normal was unknown

  [[nodiscard]] NearPlaces::List around(std::size_t point) const { return near->around(point); }
  /// The k-th of them.
  [[nodiscard]] std::uint32_t around(std::size_t point, std::size_t k) const {
    return near->around(point, k);
  }

  /// The squared distance within which `count` places are expected, as few as 8 and 32 are within theirs: it grows alike with
  /// each doubling, on surfaces and in the crowns of trees, but never more than on surfaces.
  [[nodiscard]] float expected_squared(std::size_t point, float count) const;
  /// How many places are expected within a squared distance: its inverse.
  [[nodiscard]] float expected_count(std::size_t point, float squared) const;

  /// Squared distance within which there are four times as many places, over that of as many.
  [[nodiscard]] float growth(std::size_t point) const;

  /// NearPlaces::keep, of all that is known of points.
  void keep(const Cloud& cloud, const std::vector<std::uint32_t>& kept,
            const std::vector<std::uint32_t>& number);
};

/// Gives every unknown (zero) normal the axis of its neighbourhood of 32 places; where these are rough, of that of 8, 16 and 32
/// with the least eigenentropy (Demantke et al. 2011; Weinmann et al. 2015, "Semantic point cloud interpretation based on
/// optimal neighborhoods", sec. 3.1), of those that are no line; their sides are as they come. Where that is rough, as noise
/// makes it that is wider than the neighbourhood, the same is tried among every 8th and every 64th point; rough points within a
/// third of the radius of such a wider neighbourhood share it. Without neighbours it is `up`, a unit vector. Where The flatness
/// is that of 8, 16 and 32 places and, where these are rough, of 128 and 256 places as well if they are hardly thicker than the
/// 32, as those of a noisy surface are and those of a crown are not. Where both the 32 and the 128 lie along a line the point
/// is of one. Where any normal was unknown, the cloud's positions are from then on those of its coordinates, which saves their
/// room.
[[nodiscard]] Survey survey_points(Cloud& cloud, const glm::dvec3& up, const Stage& stage);

}  // namespace splatray
