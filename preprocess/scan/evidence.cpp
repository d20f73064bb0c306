#include "preprocess/scan/evidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <span>

#include "preprocess/base/select.h"
#include "preprocess/scan/plane_fit.h"
#include "preprocess/surface/neighbours.h"

namespace splatray {
namespace {

/// The neighbourhoods that are tried: the least that a plane is told from chance by, and what averages out noise that is as wide as
/// the least one.
constexpr std::array<std::size_t, 3> CELL_SIZES{12, 20, 32};
/// In units of the median radius. Discs of even samples, whose radii differ less than these (CLOSED in radius.cpp), are not asked.
constexpr float LARGE = 2.0F;
constexpr double FLAT =
    0.2;  // least deviation / second: half of what tells surfaces from scatter, Survey::FLAT
constexpr double SPREAD =
    0.25;  // second deviation / first: below it places lie in one line, across which nothing was seen
constexpr double ON_PLANE_COSINE = 0.8;  // of the disc's normal and the plane's
constexpr double MOST_SLOPE = 0.35;   // height over the disc's plane / distance, of a neighbour that is on it
constexpr double NEAR_SHARE = 0.75;   // of a neighbourhood that must be on it
constexpr std::size_t SECTORS = 8, FILLED = 4;
/// From this share of the area of discs on, that nothing shows, a scan is sparse: 0.34 to 0.52 of sweeps, rooms and streets in which distant
/// clutter becomes plates, at most 0.13 of scans of bodies, interiors and terrain that are closed.
constexpr double SPARSE = 0.25;
constexpr std::size_t VOTERS = 16;  // nearest places of which the large ones say whether a disc is like them

/// In how many sectors around a point neighbours lie on its disc's plane, and how many do.
struct Surrounding {
  std::size_t sectors = 0, near = 0;
};

Surrounding surrounding_of(const Cloud& cloud, std::uint32_t point, std::span<const Neighbour> nearest) {
  const glm::dvec3 normal(cloud.normal[point]);
  const glm::dvec3 side = std::abs(normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(normal, side)), v = glm::cross(normal, u);
  std::array<bool, SECTORS> filled{};
  Surrounding surrounding;
  for (const Neighbour& neighbour : nearest) {
    const glm::dvec3 offset(cloud.coord[neighbour.index()] - cloud.coord[point]);
    if (std::abs(glm::dot(offset, normal)) > MOST_SLOPE * glm::length(offset)) continue;
    ++surrounding.near;
    const double turn = std::atan2(glm::dot(offset, v), glm::dot(offset, u)) / (2.0 * std::numbers::pi) + 0.5;
    filled[static_cast<std::size_t>(turn * SECTORS) % SECTORS] = true;
  }
  surrounding.sectors = static_cast<std::size_t>(std::count(filled.begin(), filled.end(), true));
  return surrounding;
}

bool is_flat(const Cloud& cloud, std::uint32_t point, std::span<const Neighbour> nearest) {
  Offsets offsets;
  for (const Neighbour& neighbour : nearest) offsets.add(cloud.coord[neighbour.index()] - cloud.coord[point]);
  const Covariance covariance = covariance_of(offsets, offsets.count);
  const glm::dvec3 variances = variances_of(covariance);
  if (!(variances.x < FLAT * FLAT * variances.y && variances.y > SPREAD * SPREAD * variances.z)) return false;
  const glm::dvec3 axis = least_axis_of(covariance, variances);
  return std::abs(glm::dot(axis, glm::dvec3(cloud.normal[point]))) > ON_PLANE_COSINE;
}

/// `nearest` ascend.
bool is_shown(const Cloud& cloud, std::uint32_t point, std::span<const Neighbour> nearest) {
  return std::any_of(CELL_SIZES.begin(), CELL_SIZES.end(), [&](std::size_t size) {
    if (size > nearest.size()) return false;
    const auto some = nearest.first(size);
    const float radius = cloud.radius[point];
    if (radius * radius > some.back().distance_squared() || !is_flat(cloud, point, some)) return false;
    const Surrounding surrounding = surrounding_of(cloud, point, some);
    return surrounding.sectors >= FILLED &&
           static_cast<double>(surrounding.near) >= NEAR_SHARE * static_cast<double>(size);
  });
}

/// What is known of a disc.
enum class Disc : std::uint8_t { small, shown, bare };

/// Calls visit(n, point, its `count` nearest places, ascending) for the n-th of some large discs.
template <typename Visit>
void visit_around(const Cloud& cloud, const NeighbourSearch& search, const std::vector<std::uint32_t>& points,
                  std::size_t count, const Stage& stage, const Visit& visit) {
  const auto query = [&](std::uint32_t n) -> NeighbourSearch::Query {
    const float guess = 2.0F * cloud.radius[points[n]];
    return {cloud.coord[points[n]], guess * guess, std::numeric_limits<float>::infinity()};
  };
  search.find_each(points.size(), query, count, stage, [&](std::uint32_t n, std::span<Neighbour> nearest) {
    if (!std::is_sorted(nearest.begin(), nearest.end())) std::sort(nearest.begin(), nearest.end());
    visit(n, points[n], nearest);
  });
}

/// Those of the large discs that nothing around them shows.
std::vector<std::uint32_t> find_bare(const Cloud& cloud, const std::vector<std::uint32_t>& large,
                                     const Stage& stage) {
  const NeighbourSearch search(cloud, Sites::oriented_surface);
  std::vector<Disc> discs(cloud.size(), Disc::small);
  visit_around(cloud, search, large, CELL_SIZES.back(), stage,
               [&](std::uint32_t, std::uint32_t i, std::span<const Neighbour> nearest) {
                 discs[i] = is_shown(cloud, i, nearest) ? Disc::shown : Disc::bare;
               });
  std::vector<std::uint32_t> bare;
  std::copy_if(large.begin(), large.end(), std::back_inserter(bare),
               [&](std::uint32_t i) { return discs[i] == Disc::bare; });
  std::vector<std::uint8_t> alone(bare.size());
  visit_around(cloud, search, bare, VOTERS, stage,
               [&](std::uint32_t n, std::uint32_t, std::span<const Neighbour> nearest) {
                 const auto are = [&](Disc disc) {
                   return std::count_if(nearest.begin(), nearest.end(), [&](const Neighbour& neighbour) {
                     return discs[neighbour.index()] == disc;
                   });
                 };
                 alone[n] = are(Disc::bare) + 1 >= are(Disc::shown) ? 1 : 0;
               });
  std::size_t n = 0;
  std::erase_if(bare, [&](std::uint32_t) { return alone[n++] == 0; });
  return bare;
}

/// Summed squares of radii.
double area_of(const Cloud& cloud, const std::vector<std::uint32_t>& points) {
  double area = 0.0;
  for (const std::uint32_t i : points)
    area += static_cast<double>(cloud.radius[i]) * static_cast<double>(cloud.radius[i]);
  return area;
}

/// The discs on surfaces, without ellipses.
struct DiscAreas {
  std::size_t count = 0;
  float usual = 0.0F;  ///< median radius
  double area = 0.0;   ///< area_of all discs, those on no surface too
};

DiscAreas measure_discs(const Cloud& cloud, const std::vector<std::uint32_t>& computed) {
  std::vector<std::uint32_t> discs;
  std::copy_if(computed.begin(), computed.end(), std::back_inserter(discs),
               [&](std::uint32_t i) { return !cloud.is_ellipse(i); });
  DiscAreas areas{.area = area_of(cloud, discs)};
  std::erase_if(discs, [&](std::uint32_t i) { return !cloud.on_surface(i); });
  std::vector<float> radii = gather(cloud.radius, discs);
  areas.count = radii.size();
  areas.usual = median_or_zero(radii);
  return areas;
}

}  // namespace

std::uint64_t make_dots(Cloud& cloud, const std::vector<std::uint32_t>& computed, const Stage& stage) {
  const DiscAreas discs = measure_discs(cloud, computed);
  if (discs.count < FEWEST_TELLING) return 0;
  const float most = LARGE * discs.usual;
  std::vector<std::uint32_t> large, scattered;
  for (const std::uint32_t i : computed) {
    if (!(cloud.radius[i] > most)) continue;
    const bool ends = !cloud.clip.empty() && cloud.clip[i].lines() > 0;
    if (!cloud.on_surface(i))
      scattered.push_back(i);
    else if (!ends && !cloud.is_ellipse(i))
      large.push_back(i);
  }
  const auto are_much = [&](const std::vector<std::uint32_t>& some) {
    return area_of(cloud, some) + area_of(cloud, scattered) > SPARSE * discs.area;
  };
  if (!are_much(large)) return 0;  // without a search, as most scans end here
  const std::vector<std::uint32_t> bare = large.empty() ? large : find_bare(cloud, large, stage);
  if (!are_much(bare)) return 0;
  for (const std::uint32_t i : bare) cloud.radius[i] = discs.usual;
  for (const std::uint32_t i : scattered) cloud.radius[i] = most;
  return bare.size() + scattered.size();
}

}  // namespace splatray
