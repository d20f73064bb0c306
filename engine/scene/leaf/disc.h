/// A splat's disc, and which boxes it comes near: without branches and inlined, so that loops take several discs at once.
#pragma once
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "engine/scene/scene.h"
#include "engine/scene/splat.h"

namespace splatray {

/// A disc as it lies along one axis of root space.
struct DiscAxis {
  [[gnu::always_inline]] DiscAxis(double disc_center, double disc_normal, double radius)
      : center(disc_center),
        normal(disc_normal),
        squared_sine(std::max(1.0 - normal * normal, 0.0)),
        inverse_squared_sine(1.0 / squared_sine),
        half_box(radius * std::sqrt(squared_sine)) {}
  double center;
  double normal;
  double squared_sine;  ///< of the angle between the normal and the axis
  double inverse_squared_sine;
  double half_box;  ///< half-size of the disc's bounding box
};

/// A disc in root space.
struct Disc {
  [[gnu::always_inline]] Disc(const glm::dvec3& center, const glm::dvec3& normal, double squared)
      : radius(std::sqrt(squared)),
        radius_squared(squared),
        x(center.x, normal.x, radius),
        y(center.y, normal.y, radius),
        z(center.z, normal.z, radius) {}
  explicit Disc(const Splat& splat) : Disc(splat.center, splat.normal, splat.radius_squared) {}
  double radius;
  double radius_squared;
  DiscAxis x, y, z;
};

/// A box along one axis, from the disc's centre: its ends, LIST_INFLATION further out, and what of it is nearest.
struct BoxAxis {
  [[gnu::always_inline]] BoxAxis(const DiscAxis& disc, double low, double high)
      : from(low - double(LIST_INFLATION) - disc.center),
        to(high + double(LIST_INFLATION) - disc.center),
        gap(std::max(from, 0.0) + std::min(to, 0.0)) {}
  double from, to, gap;
};

/// Of all points of a disc's plane with x at the box's nearest side and y in the box: n_z^2 times the least squared distance
/// from the centre; `mixed` is n_x n_y. Too small by what rounding may add.
[[gnu::always_inline]] inline double nearest_on_side(double mixed, const DiscAxis& disc_x,
                                                     const BoxAxis& box_x, const DiscAxis& disc_y,
                                                     const BoxAxis& box_y) {
  constexpr double ROUNDING = 1e-12;
  const double x = box_x.gap;
  const double y = std::max(box_y.from, std::min(-mixed * disc_x.inverse_squared_sine * x, box_y.to));
  return disc_y.squared_sine * x * x + 2.0 * mixed * x * y + disc_x.squared_sine * y * y -
         ROUNDING * (x * x + y * y);
}

/// Above 0 where all of a disc's plane that is between a box's sides across x and y, however far along z, is farther from its
/// centre than the radius.
[[gnu::always_inline]] inline double beyond_sides(const Disc& disc, const DiscAxis& disc_x,
                                                  const BoxAxis& box_x, const DiscAxis& disc_y,
                                                  const BoxAxis& box_y, double normal_z) {
  const double mixed = disc_x.normal * disc_y.normal;
  const double across_x = nearest_on_side(mixed, disc_x, box_x, disc_y, box_y);
  const double across_y = nearest_on_side(mixed, disc_y, box_y, disc_x, box_x);
  const double nearest =
      std::min(box_x.gap == 0.0 ? across_y : across_x, box_y.gap == 0.0 ? across_x : across_y);
  return nearest - normal_z * normal_z * disc.radius_squared;
}

/// Above 0 where a disc does not come within LIST_INFLATION, on each axis, of the box with these corners. Exact but for
/// rounding. The disc's plane in the box is a polygon, and what of it is nearest lies on two sides of the box at most: it is
/// enough to look at each pair of axes alone.
[[gnu::always_inline]] inline double beyond(const Disc& disc, const glm::dvec3& low, const glm::dvec3& high) {
  const DiscAxis &x = disc.x, &y = disc.y, &z = disc.z;
  const BoxAxis box_x(x, low.x, high.x), box_y(y, low.y, high.y), box_z(z, low.z, high.z);
  const double bounding_box =
      std::max(std::abs(box_x.gap) - x.half_box,
               std::max(std::abs(box_y.gap) - y.half_box, std::abs(box_z.gap) - z.half_box));
  const double middle = x.normal * (box_x.from + box_x.to) + y.normal * (box_y.from + box_y.to) +
                        z.normal * (box_z.from + box_z.to);
  const double reach = std::abs(x.normal) * (box_x.to - box_x.from) +
                       std::abs(y.normal) * (box_y.to - box_y.from) +
                       std::abs(z.normal) * (box_z.to - box_z.from);
  const double sides = std::max(beyond_sides(disc, x, box_x, y, box_y, z.normal),
                                std::max(beyond_sides(disc, y, box_y, z, box_z, x.normal),
                                         beyond_sides(disc, z, box_z, x, box_x, y.normal)));
  return std::max(std::max(bounding_box, std::abs(middle) - reach), sides);
}

}  // namespace splatray
