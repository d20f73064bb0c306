#include "preprocess/scan/noise.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <span>

#include "preprocess/base/parallel.h"
#include "preprocess/base/select.h"

namespace splatray {
namespace {

constexpr float AGREEING_COSINE = 0.9F;         // cosine of normals of one smooth surface
constexpr std::size_t MOST_OF_MEDIAN = 200000;  // points that give the median well enough

constexpr std::size_t MOST_PAIRED = 8192;  // points whose pairs show it well enough
constexpr std::size_t NEAREST = 8;         // the nearest of so many pairs
constexpr std::size_t DENSEST = 4;         // and the densest of so many points
constexpr float LOWEST = 1e-6F;            // height over the 8th place's distance that rounding leaves

// Noisy clouds, raw and simulated, have 0.06 and more and a slope of at most 0.4; clean ones, vertices and samples of meshes
// and surveys of mountains, have slopes of 0.58 and more, whatever their heights. Terrain with trees, thinned until no two
// points are of one tree, has 0.28 and more.
constexpr double NOISY_HEIGHT = 0.05, ROUGH_SLOPE = 0.5, ROUGH_TERRAIN_SLOPE = 0.15;

constexpr std::size_t MOST_SORTED = 65536;  // coordinates that show their step

/// What a point and its nearest places disagree about, and what rounding hides of it, in cloud coordinates; 0 where nothing is
/// known.
float disagreement(const Cloud& cloud, const Survey& survey, std::uint32_t i) {
  float sum = 0.0F, count = 0.0F;
  const auto listed = survey.around(i);
  for (const std::uint32_t j : std::span(listed).first(Survey::RING)) {
    if (!cloud.on_surface(j)) continue;
    if (glm::dot(cloud.normal[i], cloud.normal[j]) < AGREEING_COSINE) continue;
    const float height = 0.5F * glm::dot(cloud.normal[i] + cloud.normal[j], cloud.coord[j] - cloud.coord[i]);
    sum += height * height;
    count += 1.0F;
  }
  if (!(count > 0.0F)) return 0.0F;
  const float rounded = glm::dot(survey.step, glm::abs(cloud.normal[i]));
  return std::sqrt(std::max(sum / count, rounded * rounded / 12.0F));
}

/// How far two places are apart, and the height of one over the other's plane; both over the distance to the RING-th place.
struct Pair {
  float apart, height;
};

void add_pairs(const Cloud& cloud, const Survey& survey, std::uint32_t i, std::vector<Pair>& pairs) {
  if (!(survey.reach[i] > 0.0F)) return;
  const float by = 1.0F / survey.reach[i];
  for (const std::uint32_t j : survey.around(i)) {
    if (j == i || !cloud.on_surface(j) || glm::dot(cloud.normal[i], cloud.normal[j]) < AGREEING_COSINE)
      continue;
    const glm::vec3 offset = cloud.coord[j] - cloud.coord[i];
    const float height = 0.5F * std::abs(glm::dot(cloud.normal[i] + cloud.normal[j], offset));
    pairs.push_back({by * glm::length(offset), by * height});
  }
}

/// The medians of some pairs.
Pair median_pair(std::span<const Pair> pairs) {
  std::vector<float> apart, height;
  for (const Pair& pair : pairs) apart.push_back(pair.apart), height.push_back(pair.height);
  return {median_of(std::span(apart)), median_of(std::span(height))};
}

/// The slope of log height over log distance, by least squares over parts of the pairs, which are in order of their distance.
double slope_of(std::span<const Pair> pairs) {
  constexpr std::size_t PARTS = 6;
  glm::dvec2 sum(0.0), products(0.0);
  for (std::size_t part = 0; part < PARTS; ++part) {
    const std::size_t first = part * pairs.size() / PARTS, last = (part + 1) * pairs.size() / PARTS;
    const Pair pair = median_pair(pairs.subspan(first, last - first));
    const glm::dvec2 at(std::log(pair.apart), std::log(std::max(pair.height, LOWEST)));
    sum += at, products += at.x * at;
  }
  products -= sum.x * sum / double{PARTS};
  return products.y / products.x;
}

/// The median over at most about `most` of the points.
template <typename NoiseOf>
double median(const std::vector<std::uint32_t>& points, std::size_t most, const NoiseOf& noise_of) {
  const std::size_t stride = points.size() / most + 1;
  std::vector<float> noise(points.size() / stride);
  tbb::parallel_for(std::size_t{0}, noise.size(),
                    [&](std::size_t n) { noise[n] = noise_of(points[n * stride]); });
  return median_or_zero(noise);
}

std::vector<std::uint32_t> estimated_points(const Cloud& cloud, const Survey& survey) {
  return numbers_where(cloud.size(),
                       [&](std::size_t i) { return survey.estimated[i] != 0 && cloud.on_surface(i); });
}

/// The numbers among `points` of each station's points.
std::vector<std::vector<std::uint32_t>> by_station(const Cloud& cloud, std::vector<std::uint32_t> points) {
  std::vector<std::vector<std::uint32_t>> lists(std::max<std::size_t>(cloud.stations.size(), 1));
  if (cloud.station.empty()) return lists[0] = std::move(points), lists;
  for (const std::uint32_t i : points) lists[cloud.station[i]].push_back(i);
  return lists;
}

/// Along each axis, world units, of these points; 0 where the file's coordinates are gone.
glm::dvec3 step_world(const Cloud& cloud, const std::vector<std::uint32_t>& points) {
  if (cloud.position.empty()) return glm::dvec3(0.0);
  const std::size_t stride = points.size() / MOST_SORTED + 1;
  glm::dvec3 step(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> places;
    for (std::size_t n = 0; n < points.size(); n += stride) places.push_back(cloud.position[points[n]][axis]);
    std::sort(places.begin(), places.end());
    double least = 0.0;
    for (std::size_t i = 1; i < places.size(); ++i) {
      const double apart = places[i] - places[i - 1];
      if (apart > 0.0 && (least == 0.0 || apart < least)) least = apart;
    }
    step[axis] = least;
  }
  return step;
}

}  // namespace

glm::vec3 coordinate_step(const Cloud& cloud) {
  const auto all = numbers_where(cloud.size(), [](std::size_t) { return true; });
  return glm::vec3(step_world(cloud, all) / cloud.half_extent_world);
}

std::vector<double> station_step_world(const Cloud& cloud) {
  std::vector<double> steps;
  const auto all = numbers_where(cloud.size(), [](std::size_t) { return true; });
  for (const auto& points : by_station(cloud, all)) {
    const glm::dvec3 step = step_world(cloud, points);
    steps.push_back(std::max({step.x, step.y, step.z}));
  }
  return steps;
}

PairHeights pair_heights(const Cloud& cloud, const Survey& survey, const std::vector<std::uint32_t>& points) {
  if (points.size() < FEWEST_TELLING) return {};
  std::vector<float> reach;
  for (std::size_t n = 0; n < points.size(); n += points.size() / MOST_SORTED + 1)
    reach.push_back(survey.reach[points[n]]);
  select_nth(std::span(reach), reach.size() / DENSEST, std::identity());
  const float densest = reach[reach.size() / DENSEST];
  std::vector<Pair> pairs;
  std::vector<float> rounded;
  const std::size_t stride = points.size() / DENSEST / MOST_PAIRED + 1;
  for (std::size_t n = 0; n < points.size(); n += stride) {
    const std::uint32_t i = points[n];
    if (survey.reach[i] > densest || !(survey.reach[i] > 0.0F)) continue;
    add_pairs(cloud, survey, i, pairs);
    rounded.push_back(glm::dot(survey.step, glm::abs(cloud.normal[i])) / survey.reach[i]);
  }
  if (pairs.size() < FEWEST_TELLING) return {};
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.apart < b.apart; });
  const Pair nearest = median_pair(std::span(pairs).first(pairs.size() / NEAREST));
  const float usual = median_of(std::span(reach).first(reach.size() / DENSEST));
  const double floor = median_of(std::span(rounded)) / std::sqrt(12.0);
  return {nearest.height, slope_of(pairs), usual * std::max(double{nearest.height}, floor), floor};
}

bool is_noise(const PairHeights& heights, bool terrain) {
  if (heights.rounded > NOISY_HEIGHT) return true;
  return heights.near > NOISY_HEIGHT && heights.slope < (terrain ? ROUGH_TERRAIN_SLOPE : ROUGH_SLOPE);
}

double measure_noise(const Cloud& cloud, const Survey& survey) {
  return median(estimated_points(cloud, survey), MOST_OF_MEDIAN, [&](auto i) {
    return survey.reach[i] > 0.0F ? disagreement(cloud, survey, i) / survey.reach[i] : 0.0F;
  });
}

std::vector<double> station_noise_world(const Cloud& cloud, const Survey& survey) {
  std::vector<double> noise;
  for (const auto& points : by_station(cloud, estimated_points(cloud, survey)))
    noise.push_back(cloud.half_extent_world / std::numbers::sqrt2 *
                    median(points, MOST_OF_MEDIAN, [&](auto i) { return disagreement(cloud, survey, i); }));
  return noise;
}

}  // namespace splatray
