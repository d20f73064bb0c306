#include "preprocess/scan/smooth/layers.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "preprocess/scan/smooth/surroundings.h"

namespace splatray {
namespace {

constexpr float SHEETS_COSINE = 0.9F;          // cosine of axes of parallel sheets
constexpr std::size_t ASKED_STRIDE = 32;       // every how many points show whether there are layers at all
constexpr double FEW_LAYERED = 0.001;          // of them: chance and noise make as many
constexpr std::size_t LEAST_SHEET_POINTS = 6;  // points of a sheet
constexpr double PARTED = 4.5;                 // means' distance over the deviation
constexpr double FAR_PARTED = 8.0;  // the same of sheets on the same side that are no noise of each other
// Fraction of the mean distance along the sheet: the means of what lies side by side are 1.3 apart, those of a few places all around 0.3.
constexpr float BESIDE = 0.65F;
constexpr float NO_SHEET = std::numeric_limits<float>::infinity();

/// A place seen from a point: how high over its plane, where in it, and the cosine between the normals.
struct SeenPlace {
  float height;
  glm::vec3 along;
  float cosine;
};

/// A point and the places around it with like axes, from the lowest to the highest.
std::vector<SeenPlace> look_around(const Cloud& cloud, std::uint32_t i, std::span<const Neighbour> nearest) {
  std::vector<SeenPlace> seen;
  seen.reserve(nearest.size() + 1);
  seen.push_back({0.0F, glm::vec3(0.0F), 1.0F});
  for (const Neighbour& neighbour : nearest) {
    const std::uint32_t j = neighbour.index();
    const float cosine = glm::dot(cloud.normal[i], cloud.normal[j]);
    if (!cloud.on_surface(j) || std::abs(cosine) < SHEETS_COSINE) continue;
    const glm::vec3 offset = cloud.coord[j] - cloud.coord[i];
    const float height = glm::dot(cloud.normal[i], offset);
    seen.push_back({height, offset - height * cloud.normal[i], cosine});
  }
  std::sort(seen.begin(), seen.end(),
            [](const SeenPlace& a, const SeenPlace& b) { return a.height < b.height; });
  return seen;
}

/// Sums over places.
struct Sheet {
  double count = 0.0, heights = 0.0, squares = 0.0;

  void add(const SeenPlace& seen, double by = 1.0) {
    count += by, heights += by * seen.height, squares += by * seen.height * seen.height;
  }
  [[nodiscard]] double mean() const { return heights / count; }
  [[nodiscard]] double variance() const { return std::max(squares / count - mean() * mean(), 0.0); }
};

/// Where the upper of two sheets begins.
struct Split {
  std::size_t first = 0;  ///< its first place; 0 = there is one sheet
  double parted = 0.0;    ///< the means' distance over the deviation
  double apart = 0.0;     ///< the means' distance
};

/// That with the least deviation within both.
Split find_split(const std::vector<SeenPlace>& seen) {
  if (seen.size() < 2 * LEAST_SHEET_POINTS) return {};
  Sheet low, high;
  for (const SeenPlace& place : seen) high.add(place);
  Split split;
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k + LEAST_SHEET_POINTS <= seen.size(); ++k) {
    low.add(seen[k - 1]), high.add(seen[k - 1], -1.0);
    const double within = low.count * low.variance() + high.count * high.variance();
    if (k < LEAST_SHEET_POINTS || !(within < best)) continue;
    best = within;
    const double deviation = std::sqrt(std::max(0.5 * (low.variance() + high.variance()), 1e-20));
    const double apart = high.mean() - low.mean();
    split = {k, apart / deviation, apart};
  }
  return split.parted > PARTED ? split : Split{};
}

/// Whether the two sheets' normals are on opposite sides.
bool are_opposite(const std::vector<SeenPlace>& seen, std::size_t split) {
  float low = 0.0F, high = 0.0F;
  for (std::size_t k = 0; k < seen.size(); ++k) (k < split ? low : high) += seen[k].cosine;
  return low * high < 0.0F;
}

/// Whether what lies above the split covers what lies below it, and is not what is beside that: its middle is there, too, and of
/// the nearer half of all places, seen from above, it has its part. The rims of a bent sheet have not.
bool covers(const std::vector<SeenPlace>& seen, std::size_t split) {
  glm::vec3 low(0.0F), high(0.0F);
  float far = 0.0F;
  std::vector<float> along(seen.size());
  for (std::size_t k = 0; k < seen.size(); ++k) {
    (k < split ? low : high) += seen[k].along;
    along[k] = glm::length(seen[k].along);
    far += along[k];
  }
  const auto count = static_cast<float>(seen.size());
  const glm::vec3 apart = high / (count - static_cast<float>(split)) - low / static_cast<float>(split);
  if (!(glm::length(apart) < BESIDE * far / count)) return false;
  std::vector<float> ranked = along;
  const float near = median_of(std::span(ranked));
  std::size_t below = 0, above = 0;
  for (std::size_t k = 0; k < seen.size(); ++k)
    if (along[k] <= near) ++(k < split ? below : above);
  return 4 * std::min(below, above) >= below + above;
}

/// Where the sheet of a point ends, seen from it; `step`: of the coordinates, across it, which makes layers of one sheet.
float end_of_sheet(const std::vector<SeenPlace>& seen, bool sides_known, float step) {
  const auto [first, parted, apart] = find_split(seen);
  if (first == 0 || apart < 2.0 * step || !covers(seen, first)) return NO_SHEET;
  if (sides_known && parted < FAR_PARTED && !are_opposite(seen, first)) return NO_SHEET;
  return 0.5F * (seen[first - 1].height + seen[first].height);
}

/// Finds where the sheets of these points end. Returns how many do.
std::size_t find_ends(const Cloud& cloud, const Survey& survey, const std::vector<std::uint32_t>& points,
                      bool sides_known, const Stage& stage, std::vector<float>& end) {
  std::atomic<std::size_t> ends = 0;
  const Surroundings surroundings(survey);
  survey.near->search().find_each(
      points.size(), [&](std::uint32_t n) { return surroundings.query(cloud, points[n]); },
      Surroundings::MOST, stage,
      [&](std::uint32_t n, std::span<const Neighbour> nearest) {
        end[points[n]] = end_of_sheet(look_around(cloud, points[n], nearest), sides_known,
                                      glm::dot(survey.step, glm::abs(cloud.normal[points[n]])));
        if (end[points[n]] < NO_SHEET && end[points[n]] > -NO_SHEET) ++ends;
      });
  return ends;
}

}  // namespace

std::vector<float> part_layers(Cloud& cloud, const Survey& survey, const std::vector<std::uint32_t>& points,
                               bool sides_known, const Stage& stage) {
  std::vector<std::uint32_t> asked;
  for (std::size_t n = 0; n < points.size(); n += ASKED_STRIDE) asked.push_back(points[n]);
  std::vector<float> end(cloud.size(), NO_SHEET);
  const std::size_t found = find_ends(cloud, survey, asked, sides_known, stage, end);
  if (static_cast<double>(found) < FEW_LAYERED * static_cast<double>(asked.size())) return {};
  find_ends(cloud, survey, points, sides_known, stage, end);
  if (sides_known) return end;
  for (const std::uint32_t i : points)
    if (end[i] > 0.0F && end[i] < NO_SHEET) cloud.normal[i] = -cloud.normal[i], end[i] = -end[i];
  return end;
}

}  // namespace splatray
