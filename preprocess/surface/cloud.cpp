#include "preprocess/surface/cloud.h"

#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <compare>
#include <numeric>
#include <tuple>
#include <utility>

#include "engine/base/release.h"
#include "engine/scene/splat.h"
#include "preprocess/base/morton.h"
#include "preprocess/base/parallel.h"
#include "preprocess/base/sorted_order.h"
#include "preprocess/base/unit_or_zero.h"
#include "preprocess/base/usable_position.h"

namespace splatray {
namespace {

/// The arrays that a cloud takes of its points as they are.
constexpr std::tuple TAKEN{
    std::pair{&Points::position, &Cloud::position},    std::pair{&Points::normal, &Cloud::normal},
    std::pair{&Points::shading, &Cloud::shading},      std::pair{&Points::station, &Cloud::station},
    std::pair{&Points::grid_cell, &Cloud::grid_cell},  std::pair{&Points::mean_of, &Cloud::mean_of},
    std::pair{&Points::radius, &Cloud::radius},        std::pair{&Points::clip, &Cloud::clip},
    std::pair{&Points::ellipse, &Cloud::ellipse},      std::pair{&Points::field_words, &Cloud::field_words},
    std::pair{&Points::clip_words, &Cloud::clip_words}};

std::vector<std::uint32_t> usable_points(const Points& points) {
  return numbers_where(points.size(), [&](std::size_t i) { return is_usable_position(points.position[i]); });
}

/// The points named by `usable`; frees the source arrays one by one.
Cloud take_points(Points&& points, const std::vector<std::uint32_t>& usable) {
  const auto take = [&](auto& values) {
    auto taken = usable.size() == values.size() ? std::move(values) : gather(values, usable);
    release(values);
    return taken;
  };
  Cloud cloud;
  std::apply([&](const auto&... of) { ((cloud.*of.second = take(points.*of.first)), ...); }, TAKEN);
  cloud.normal.resize(usable.size(), glm::vec3(0.0F));
  const std::vector<glm::vec3> color = take(points.color);
  cloud.color.resize(color.size());
  for (Column& column : points.columns)
    edit_values(column, [&](auto& values) { cloud.columns.push_back({column.name, take(values)}); });
  cloud.stations = std::move(points.stations);
  cloud.track = std::move(points.track);
  cloud.lattice = points.lattice;
  cloud.ends_known = !cloud.clip.empty();
  tbb::parallel_for(std::size_t{0}, usable.size(), [&](std::size_t i) {
    cloud.normal[i] = glm::vec3(unit_or_zero(glm::dvec3(cloud.normal[i])));
    if (!color.empty()) cloud.color[i] = pack_color(color[i]);
  });
  for (float& radius : cloud.radius)
    if (!(std::isfinite(radius) && radius > 0.0F)) radius = 0.0F;
  return cloud;
}

glm::vec3 rounded(const glm::dvec3& unit) {
  const glm::dvec3 steps = glm::round(glm::clamp(unit, -1.0, 1.0) / static_cast<double>(COORD_STEP));
  return glm::vec3(steps) * COORD_STEP;
}

/// Cloud::coord, in the cloud's frame.
void find_coordinates(Cloud& cloud) {
  cloud.coord.resize(cloud.position.size());
  tbb::parallel_for(std::size_t{0}, cloud.size(),
                    [&](std::size_t i) { cloud.coord[i] = rounded(cloud.in_cloud(cloud.position[i])); });
}

void normalise_coordinates(Cloud& cloud, const Bounds& bounds) {
  cloud.center_world = 0.5 * (bounds.low + bounds.high);
  const glm::dvec3 half = 0.5 * (bounds.high - bounds.low);
  const double longest = std::max({half.x, half.y, half.z});
  // Points that lie no farther apart than this are at one place: smaller numbers have no inverse.
  constexpr double LEAST_EXTENT = 1e-150;
  cloud.half_extent_world = longest > LEAST_EXTENT ? longest : 1.0;
  find_coordinates(cloud);
  const auto unit = static_cast<float>(1.0 / cloud.half_extent_world);
  for (PointClip& clip : cloud.clip) clip.distance[0] *= unit, clip.distance[1] *= unit, clip.reach *= unit;
  for (PointEllipse& ellipse : cloud.ellipse) ellipse.half_length *= unit;
  tbb::parallel_for(std::size_t{0}, cloud.radius.size(), [&](std::size_t i) {
    if (cloud.radius[i] > 0.0F) {
      const double radius = cloud.radius[i] / cloud.half_extent_world;
      cloud.radius[i] = static_cast<float>(std::clamp(radius, 0x1p-100, 0x1p100));
    }
  });
}

auto sort_key(const glm::vec3& v) { return std::make_tuple(v.x, v.y, v.z); }

bool point_less(const Cloud& cloud, std::uint32_t a, std::uint32_t b) {
  const auto key = [&cloud](std::uint32_t i) {
    const glm::dvec3 p = cloud.place_world(i);
    const std::uint32_t color = cloud.color.empty() ? 0U : cloud.color[i];
    const std::uint16_t station = cloud.station.empty() ? std::uint16_t{0} : cloud.station[i];
    const std::uint32_t cell = cloud.grid_cell.empty() ? NO_CELL : cloud.grid_cell[i];
    const std::uint32_t count = cloud.mean_of.empty() ? 0U : cloud.mean_of[i];
    const float radius = cloud.radius.empty() ? 0.0F : cloud.radius[i];
    const glm::vec3 shading = cloud.shading.empty() ? glm::vec3(0.0F) : cloud.shading[i];
    const ScanKind kind = cloud.kind.empty() ? ScanKind::surface : cloud.kind[i];
    const PointEllipse shape = cloud.ellipse.empty() ? PointEllipse{} : cloud.ellipse[i];
    return std::tuple(sort_key(cloud.coord[i]), sort_key(cloud.normal[i]), sort_key(shading), p.x, p.y, p.z,
                      color, radius, shape.aspect, sort_key(shape.short_axis), station, cell, count, kind);
  };
  const auto key_a = key(a), key_b = key(b);
  if (key_a != key_b) return key_a < key_b;
  for (const Column& column : cloud.columns)
    if (const auto order = std::strong_order(column.number(a), column.number(b)); order != 0)
      return order < 0;
  return false;
}

/// Whether all that is known of two points is the same, but for their numbers in the input.
bool are_alike(const Cloud& cloud, std::size_t a, std::size_t b) {
  const auto same = [&](const auto& values) { return values.empty() || values[a] == values[b]; };
  const bool taken = std::apply([&](const auto&... of) { return (same(cloud.*of.second) && ...); }, TAKEN);
  return taken && same(cloud.coord) && same(cloud.color) && same(cloud.kind) &&
         std::all_of(cloud.columns.begin(), cloud.columns.end(), [&](const Column& column) {
           return column.name == COLUMN_INPUT_NUMBER ||
                  std::strong_order(column.number(a), column.number(b)) == 0;
         });
}

/// Points' indices, ascending by Morton key of the coordinates, then by every attribute.
std::vector<std::uint32_t> canonical_order(const Cloud& cloud) {
  const auto key = [&cloud](std::size_t i) {
    return morton_key(glm::min(glm::uvec3((cloud.coord[i] + 1.0F) * 0x1p20F), glm::uvec3(0x1FFFFF)));
  };
  return sorted_order(cloud.size(), key,
                      [&cloud](std::uint32_t a, std::uint32_t b) { return point_less(cloud, a, b); });
}

void count_given(const Cloud& cloud, BuildStats& stats) {
  const auto unknown_normals = std::count(cloud.normal.begin(), cloud.normal.end(), glm::vec3(0.0F));
  const auto radii_repaired = std::count(cloud.radius.begin(), cloud.radius.end(), 0.0F);
  stats.normals_given += cloud.size() - static_cast<std::size_t>(unknown_normals);
  stats.radii_given += cloud.radius.size() - static_cast<std::size_t>(radii_repaired);
  stats.radii_repaired += static_cast<std::size_t>(radii_repaired);
}

/// Calls change for every array of the points, which are others from then on.
template <typename Change>
void change_all(Cloud& cloud, const Change& change) {
  cloud.near = {};
  std::apply([&](const auto&... of) { (change(cloud.*of.second), ...); }, TAKEN);
  change(cloud.coord);
  change(cloud.color);
  change(cloud.kind);
  change(cloud.radius_most);
  for (Column& column : cloud.columns) edit_values(column, change);
}

/// Gives all arrays the values of these points, in this order.
void rearrange(Cloud& cloud, const std::vector<std::uint32_t>& order) {
  change_all(cloud, [&](auto& values) { values = gather(values, order); });
}

/// Finds far points and drops them where they were measured; the box of those that stay.
Bounds drop_far_points(Cloud& cloud, BuildStats& stats) {
  cloud.far = find_far_points(cloud.position);
  if (cloud.far.numbers.empty() || !cloud.measured)
    return cloud.far.numbers.empty() ? cloud.far.others : bounds_of(cloud.position);
  std::vector<bool> is_far(cloud.position.size(), false);
  for (const std::uint32_t i : cloud.far.numbers) is_far[i] = true;
  keep_points(cloud, numbers_where(is_far.size(), [&](std::size_t i) { return !is_far[i]; }));
  stats.dropped_far += cloud.far.numbers.size();
  return cloud.far.others;
}

}  // namespace

Bounds bounds_of(const Cloud& cloud) {
  using Range = tbb::blocked_range<std::size_t>;
  const auto add = [&](const Range& range, Bounds bounds) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) bounds.add(cloud.place_world(i));
    return bounds;
  };
  const auto join = [](Bounds a, const Bounds& b) { return a.add(b), a; };
  return tbb::parallel_reduce(Range(0, cloud.size()), Bounds{}, add, join);
}

Cloud make_cloud(Points&& points, bool oriented, bool measured, BuildStats& stats) {
  std::vector<std::uint32_t> usable = usable_points(points);
  stats.points_read += points.size();
  stats.dropped_non_finite += points.size() - usable.size();
  Cloud cloud = take_points(std::move(points), usable);
  cloud.oriented = oriented;
  cloud.measured = measured;
  if (usable.empty()) return cloud;
  release(usable);
  normalise_coordinates(cloud, drop_far_points(cloud, stats));
  put_in_order(cloud);
  count_given(cloud, stats);
  return cloud;
}

void keep_points(Cloud& cloud, const std::vector<std::uint32_t>& kept) {
  change_all(
      cloud,
      [&](auto& values) {  // in place: most points are kept, and few arrays find room beside all others
        if (values.empty()) return;
        for (std::size_t n = 0; n < kept.size(); ++n) values[n] = values[kept[n]];
        values.resize(kept.size());
      });
}

std::size_t drop_copies(Cloud& cloud) {
  const std::size_t before = cloud.size();
  const std::vector<std::uint32_t> kept =
      numbers_where(before, [&](std::size_t i) { return i == 0 || !are_alike(cloud, i - 1, i); });
  if (kept.size() < before) keep_points(cloud, kept);
  return before - cloud.size();
}

void add_copies(Cloud& cloud, const std::vector<std::uint32_t>& of) {
  std::vector<std::uint32_t> order(cloud.size());
  std::iota(order.begin(), order.end(), 0U);
  order.insert(order.end(), of.begin(), of.end());
  rearrange(cloud, order);
}

void put_in_order(Cloud& cloud) { rearrange(cloud, canonical_order(cloud)); }

void follow_positions(Cloud& cloud) {
  find_coordinates(cloud);
  put_in_order(cloud);
}

void move_points(Cloud& cloud, const std::vector<float>& lift) {
  if (cloud.position.empty()) {
    tbb::parallel_for(std::size_t{0}, cloud.size(), [&](std::size_t i) {
      cloud.coord[i] = rounded(glm::dvec3(cloud.coord[i]) + glm::dvec3(cloud.normal[i]) * double{lift[i]});
    });
  } else {
    tbb::parallel_for(std::size_t{0}, cloud.size(), [&](std::size_t i) {
      cloud.position[i] += glm::dvec3(cloud.normal[i]) * (lift[i] * cloud.half_extent_world);
    });
    find_coordinates(cloud);
  }
}

}  // namespace splatray
