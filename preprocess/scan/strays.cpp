#include "preprocess/scan/strays.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <numbers>

#include "preprocess/base/parallel.h"
#include "preprocess/base/select.h"
#include "preprocess/scan/components.h"
#include "preprocess/scan/range_grid.h"

namespace splatray {
namespace {

constexpr float ISOLATED_REACH = 3.0F;  // of a stray's neighbours, in units of theirs
constexpr std::size_t LEAST_RANK =
    2;                              // which of the neighbours' distances: other strays may be the first two
constexpr float LINK_REACH = 1.3F;  // of points that hang together, in units of both their distances
constexpr std::size_t SMALL_PART = 16;
constexpr std::size_t PARTS_MOST = 10000;     // all points over those of a part that is no stray
constexpr std::size_t THIN_PARTS_MOST = 100;  // all points over those of a part that may be dust
constexpr float DUST_REACH = 4.0F;            // of dust's distances, in units of what is usual
constexpr double FAR_STEPS = 4.0;             // of the 8th neighbour, in steps of the scanner
constexpr double LINE_NOISES = 1.7;           // of a point off a line, in units of what is usual
constexpr double SECOND_OF_8 = 0.25;  // the median of the second least of 8 such distances, in the same units
const double SLANTED_PLANE =
    std::sin(15.0 * std::numbers::pi / 180.0);  // sine of the angle that a plane is seen at

/// Points that have no neighbour as near as their neighbours have.
void mark_isolated(const Survey& survey, std::vector<Stray>& strays) {
  tbb::parallel_for(std::size_t{0}, strays.size(), [&](std::size_t i) {
    // Whether that holds of the neighbour of LEAST_RANK: of more neighbours than that.
    std::size_t closer = 0;
    for (const std::uint32_t j : survey.around(i))
      closer += survey.reach[i] > ISOLATED_REACH * survey.reach[j] ? 1 : 0;
    if (closer > LEAST_RANK) strays[i] = Stray::isolated;
  });
}

/// Links of each point to its listed neighbours, a bit for each: of those as near as they are to others.
std::vector<std::uint16_t> find_links(const Cloud& cloud, const Survey& survey) {
  std::vector<std::uint16_t> links(cloud.size());
  tbb::parallel_for(std::size_t{0}, cloud.size(), [&](std::size_t i) {
    const auto listed = survey.around(i);
    for (std::size_t k = 0; k < Survey::LISTED; ++k) {
      const std::uint32_t j = listed[k];
      const glm::vec3 apart = cloud.coord[i] - cloud.coord[j];
      const float reach = LINK_REACH * std::min(survey.reach[i], survey.reach[j]);
      const bool linked = j != i && glm::dot(apart, apart) <= reach * reach;
      links[i] = static_cast<std::uint16_t>(links[i] | (linked ? 1U << k : 0U));
    }
  });
  return links;
}

/// What hangs together. Most links are within pieces of the cloud, which are joined in parallel.
Components find_components(const Cloud& cloud, const Survey& survey) {
  constexpr std::size_t PIECE = std::size_t{1} << 15;
  std::vector<std::uint16_t> links = find_links(cloud, survey);
  Components parts(cloud.size());
  const auto join_links = [&](std::size_t i, std::size_t begin, std::size_t end) {
    for (std::uint16_t left = links[i]; left != 0; left = static_cast<std::uint16_t>(left & (left - 1))) {
      const int k = std::countr_zero(left);
      const std::uint32_t j = survey.around(i, static_cast<std::size_t>(k));
      if (j < begin || j >= end) continue;
      parts.join(static_cast<std::uint32_t>(i), j);
      links[i] = static_cast<std::uint16_t>(links[i] & ~(1U << k));
    }
  };
  tbb::parallel_for(std::size_t{0}, (cloud.size() + PIECE - 1) / PIECE, [&](std::size_t piece) {
    const std::size_t begin = piece * PIECE, end = std::min(begin + PIECE, cloud.size());
    for (std::size_t i = begin; i < end; ++i) join_links(i, begin, end);
  });
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    if (i > 0 && cloud.coord[i] == cloud.coord[i - 1]) parts.join(i, i - 1);
    join_links(i, 0, cloud.size());
  }
  return parts;
}

float usual_reach(const Survey& survey) {
  std::vector<float> ranked = survey.reach;
  return median_or_zero(ranked);
}

struct ComponentSize {
  std::uint32_t points = 0, sparse = 0;  ///< in all; of them, far from their neighbours
};

/// Parts of few points that are far from all others, as far as these are from each other.
void mark_small_parts(const Cloud& cloud, const Survey& survey, std::vector<Stray>& strays) {
  Components parts = find_components(cloud, survey);
  const float sparse = DUST_REACH * usual_reach(survey);
  std::vector<ComponentSize> sizes(cloud.size());
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    ComponentSize& part = sizes[parts.find(i)];
    ++part.points;
    part.sparse += survey.reach[i] > sparse ? 1 : 0;
  }
  const std::size_t least = std::max(SMALL_PART, cloud.size() / PARTS_MOST);
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    const ComponentSize& part = sizes[parts.find(i)];
    const bool thin = part.points < cloud.size() / THIN_PARTS_MOST && 2 * part.sparse > part.points;
    if (part.points < least || thin) strays[i] = Stray::isolated;
  }
}

/// What one station, whose sensor is known, shows of its points.
void mark_seen_from(const Cloud& cloud, const Survey& survey, const Station& station,
                    const std::vector<std::uint32_t>& points, std::vector<Stray>& strays) {
  const glm::dvec3 sensor = cloud.in_cloud(*station.sensor_world);
  const RangeGrid grid(cloud, station, points);
  std::vector<float> steps(points.size()), second(grid.empty() ? 0 : points.size());
  std::vector<std::array<float, 8>> off(second.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t n) {
    steps[n] = static_cast<float>(survey.reach[points[n]] /
                                  glm::distance(glm::dvec3(cloud.coord[points[n]]), sensor));
    if (grid.empty()) return;
    off[n] = grid.off_lines(points[n]);
    std::array<float, 8> ranked = off[n];
    std::nth_element(ranked.begin(), ranked.begin() + 1, ranked.end());
    second[n] = ranked[1];
  });
  std::vector<float> ranked_steps = steps;
  const double step =
      median_or_zero(ranked_steps) / std::numbers::sqrt2;  // of a square lattice's 8th neighbour
  const double noise = median_or_zero(second) / SECOND_OF_8;
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t n) {
    const std::uint32_t i = points[n];
    if (steps[n] > FAR_STEPS * step) strays[i] = Stray::isolated;
    if (grid.empty() || strays[i] != Stray::no) return;
    // Without noise, as of generated grids, points are on lines exactly.
    const auto on_lines = std::count_if(off[n].begin(), off[n].end(), [&](float distance) {
      return distance < LINE_NOISES * noise || distance == 0.0F;
    });
    const glm::dvec3 dir = glm::normalize(glm::dvec3(cloud.coord[i]) - sensor);
    const bool slanted = std::abs(glm::dot(dir, glm::dvec3(cloud.normal[i]))) < SLANTED_PLANE;
    if (on_lines < (slanted ? 2 : 1)) strays[i] = Stray::mixed;
  });
}

}  // namespace

std::vector<Stray> find_strays(const Cloud& cloud, const Survey& survey, const GridSurface& grids) {
  std::vector<Stray> strays(cloud.size(), Stray::no);
  if (cloud.size() < FEWEST_TELLING) return strays;
  mark_isolated(survey, strays);
  mark_small_parts(cloud, survey, strays);
  for (std::size_t s = 0; s < cloud.stations.size(); ++s) {
    if (!cloud.stations[s].sensor_world) continue;
    const auto points = numbers_where(
        cloud.size(), [&](std::size_t i) { return cloud.station_of(i) == s && !grids.has(cloud, i); });
    mark_seen_from(cloud, survey, cloud.stations[s], points, strays);
  }
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (grids.has(cloud, i)) strays[i] = Stray::no;
  return strays;
}

}  // namespace splatray
