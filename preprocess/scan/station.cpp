#include "preprocess/scan/station.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

#include "engine/base/release.h"
#include "engine/image/point_sample.h"
#include "preprocess/base/parallel.h"
#include "preprocess/base/select.h"
#include "preprocess/scan/occupancy.h"
#include "preprocess/scan/sides.h"

namespace splatray {
namespace {

constexpr std::size_t PATCHES = 4096, FIRST_PATCHES = 512, START_PLACES = 2048;
constexpr std::size_t LOOKED_AROUND = 6;  ///< places that are looked around
constexpr double ALIKE = 0.35;            ///< natural logarithms of densities, to both sides
constexpr double SEEN_COSINE = 0.1;       ///< flatter sights say nothing of density
constexpr double EXPLAINED = 0.5, GAIN = 0.2;
/// Scans from one place have 0.17 to 0.47, what was gone around 0.7 and more.
constexpr double TOO_EVEN = 0.6;
constexpr double FINEST_MOVE = 1e-3;  ///< cloud coordinates

/// A flat part of the surface.
struct Patch {
  glm::dvec3 place, normal;
  double density;  ///< natural logarithm of points per area, but for a constant
};

std::vector<Patch> flat_patches(const Cloud& cloud, const Survey& survey) {
  const auto flat = numbers_where(cloud.size(), [&](std::size_t i) {
    return survey.wide[i] > 0.0F && (survey.flatness.empty() || survey.flatness[i] < Survey::FLAT);
  });
  std::vector<Patch> patches;
  const std::size_t asked = std::min(PATCHES, flat.size());
  for (std::size_t n = 0; n < asked; ++n) {
    const std::uint32_t i = flat[n * flat.size() / asked];
    patches.push_back(
        {glm::dvec3(cloud.coord[i]), glm::dvec3(cloud.normal[i]), -2.0 * std::log(double(survey.wide[i]))});
  }
  return patches;
}

/// The largest share of `all` whose values lie within ALIKE of one constant.
double share_alike(std::vector<double>& values, std::size_t all) {
  std::sort(values.begin(), values.end());
  std::size_t most = 0, first = 0;
  for (std::size_t last = 0; last < values.size(); ++last) {
    while (values[last] - values[first] > 2.0 * ALIKE) ++first;
    most = std::max(most, last + 1 - first);
  }
  return static_cast<double>(most) / static_cast<double>(all);
}

/// A place where a scanner may have stood.
struct Candidate {
  glm::dvec3 place{0.0};
  glm::dvec3 axis{0.0};  ///< unit, that it turns about; zero: its pulses are as dense in all directions
  double explained = 0.0;
};

/// What is left of a patch's density once the way to a scanner is taken out; nothing where it is seen too flatly.
std::optional<double> rest_of(const Patch& patch, const Candidate& scanner) {
  constexpr double LEAST_SINE = 0.01;
  const glm::dvec3 to = scanner.place - patch.place;
  const double away = glm::length(to), along = std::abs(glm::dot(to, patch.normal));
  if (!(along > SEEN_COSINE * away)) return {};
  const double rest = patch.density + std::log(away * away * away / along);
  if (scanner.axis == glm::dvec3(0.0)) return rest;
  return rest + std::log(std::max(glm::length(glm::cross(to, scanner.axis)) / away, LEAST_SINE));
}

/// The share of the patches that a scanner explains and `sees`.
template <class Sees>
double explained_by(std::span<const Patch> patches, const Candidate& scanner, const Sees& sees) {
  std::vector<double> rests;
  for (const Patch& patch : patches)
    if (const auto rest = rest_of(patch, scanner); rest && sees(patch)) rests.push_back(*rest);
  return share_alike(rests, patches.size());
}

/// The same, whatever stands between them.
double explained_by(std::span<const Patch> patches, const Candidate& scanner) {
  return explained_by(patches, scanner, [](const Patch&) { return true; });
}

/// The same of those alone that lie in free sight.
double explained_in_sight(std::span<const Patch> patches, const Occupancy& space, const Candidate& scanner) {
  constexpr double NEAR = 4.0;  // cells before a patch where a way to it may end
  return explained_by(patches, scanner, [&](const Patch& patch) {
    const glm::dvec3 way = patch.place - scanner.place;
    const auto free = space.free_path(scanner.place, glm::normalize(way));
    return !free || *free > glm::length(way) - NEAR * space.edge();
  });
}

/// Moves along the axes while that helps, ever less far (Hooke and Jeeves 1961, without pattern moves).
Candidate settled(std::span<const Patch> patches, Candidate from, double move) {
  from.explained = explained_by(patches, from);
  while (move > FINEST_MOVE) {
    Candidate best = from;
    for (int axis = 0; axis < 3; ++axis)
      for (const double by : {-move, move}) {
        Candidate next = from;
        next.place[axis] += by;
        next.explained = explained_by(patches, next);
        if (next.explained > best.explained) best = next;
      }
    if (best.explained > from.explained)
      from = best;
    else
      move *= 0.5;
  }
  return from;
}

/// Those places of the free space that explain most of some of the patches.
std::vector<Candidate> first_candidates(std::span<const Patch> patches, const Occupancy& space) {
  std::vector<Patch> some;
  for (std::size_t n = 0; n < patches.size(); n += PATCHES / FIRST_PATCHES) some.push_back(patches[n]);
  std::vector<Candidate> candidates;
  for (const glm::dvec3& place : space.free_places(START_PLACES)) {
    candidates.push_back({place});
    for (int axis = 0; axis < 3; ++axis) {
      candidates.push_back({place});
      candidates.back().axis[axis] = 1.0;
    }
  }
  tbb::parallel_for(std::size_t{0}, candidates.size(),
                    [&](std::size_t n) { candidates[n].explained = explained_by(some, candidates[n]); });
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.explained > b.explained; });
  candidates.resize(std::min(LOOKED_AROUND, candidates.size()));
  return candidates;
}

/// The world's origin, cloud coordinates.
glm::dvec3 world_origin(const Cloud& cloud) { return cloud.in_cloud(glm::dvec3(0.0)); }

/// Whether all lies on rings around the world's origin, as in a scanner's own frame.
bool is_spun_around_origin(const Cloud& cloud) {
  if (cloud.stations.size() > 1) return false;
  std::vector<std::uint32_t> all(cloud.size());
  std::iota(all.begin(), all.end(), 0U);
  return find_ring_axis(cloud, all, world_origin(cloud)).has_value();
}

/// Whether all was seen from the world's origin, as a depth camera's frame has it.
bool is_in_camera_frame(const Cloud& cloud, const glm::dvec3& up) {
  constexpr std::size_t MOST = 1U << 16;
  if (cloud.stations.size() > 1) return false;
  PointSample sample;
  for (std::size_t i = 0; i < cloud.size(); i += cloud.size() / MOST + 1)
    sample.position.push_back(cloud.place_world(i));
  return is_seen_along_z(sample, up);
}

}  // namespace

std::optional<StationFound> find_scanner_place(const Cloud& cloud, const Survey& survey) {
  const std::vector<Patch> patches = flat_patches(cloud, survey);
  if (patches.size() < PATCHES) return {};
  std::vector<double> densities;
  for (const Patch& patch : patches) densities.push_back(patch.density);
  const double even = share_alike(densities, patches.size());
  if (even > TOO_EVEN) return {};
  const Occupancy space(cloud, cell_edge(survey));
  std::vector<Candidate> candidates = first_candidates(patches, space);
  if (candidates.empty() || candidates.front().explained < even + 0.5 * GAIN) return {};
  tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t n) {
    Candidate& candidate = candidates[n];
    candidate = settled(patches, candidate, 2.0 / std::cbrt(double(START_PLACES)));
    candidate.explained = explained_in_sight(patches, space, candidate);
  });
  Candidate best;
  for (const Candidate& candidate : candidates)
    if (candidate.explained > best.explained) best = candidate;
  if (best.explained < EXPLAINED || best.explained < even + GAIN) return {};
  return StationFound{best.place, best.explained, even};
}

double find_station(Cloud& cloud, const Survey& survey, const std::vector<LinePlace>& lines,
                    const glm::dvec3& up) {
  const bool known = std::any_of(cloud.stations.begin(), cloud.stations.end(),
                                 [](const Station& station) { return station.sensor_world.has_value(); });
  if (known) return 0.0;
  std::optional<glm::dvec3> sensor;
  if (is_spun_around_origin(cloud)) sensor = world_origin(cloud);
  if (!sensor && !lines.empty()) sensor = find_spinning_sensor(cloud, lines);
  if (!sensor && is_in_camera_frame(cloud, up)) sensor = world_origin(cloud);
  double explained = 0.0;
  const bool asked = !sensor && cloud.track.empty() && !survey.flatness.empty();
  if (asked && (!open_sheet_axis(cloud, survey, up) || is_room(cloud, survey, up))) {
    if (const auto found = find_scanner_place(cloud, survey)) {
      sensor = found->sensor;
      explained = found->explained;
    }
  }
  if (!sensor) return 0.0;
  cloud.stations = {Station{"", cloud.center_world + cloud.half_extent_world * *sensor}};
  release(cloud.station);
  release(cloud.grid_cell);
  return explained;
}

}  // namespace splatray
