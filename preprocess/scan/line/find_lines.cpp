#include "preprocess/scan/line/lines.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "preprocess/scan/plane_fit.h"
#include "preprocess/surface/neighbours.h"

namespace splatray {
namespace {

constexpr double THIN_LINE = 0.12;             // second variance / first of places on a line
constexpr std::size_t FEW_PLACES = 6;          // places that may make a line where more reach the next line
constexpr double THINNEST = 0.03;              // of so few, of which some lie so by chance
constexpr std::size_t POINTS_ASKED = 20000;    // points that show whether there are lines
constexpr float SHARE_ON_LINES = 0.1F;         // share of a cloud's points on lines that is worth a look
constexpr float UNEVEN_STEPS = 2.5F;           // one step over the other, of steps that are alike
constexpr float MOST_STEP_RATIO = 3.0F;        // the steps of lines beside each other
constexpr float PARALLEL_LINES_COSINE = 0.8F;  // cosine of their directions
constexpr float OPPOSITE = -0.2F;              // cosine of the ways to lines on either side
constexpr float LEAST_GAP = 1.5F;              // steps
constexpr float MOST_GAP = 40.0F;              // steps: there is no surface between lines further apart
constexpr std::array<std::size_t, 3> LINE_STRIDES{4, 16, 64};
constexpr std::size_t LOOKED_AT = 48;

const glm::vec3 NO_WAY(0.0F);

/// Places of a point's neighbours relative to it, and their numbers.
struct ListedPlaces {
  Offsets offsets;
  std::array<std::uint32_t, Offsets::MOST> number;

  ListedPlaces(const Cloud& cloud, std::uint32_t point, std::span<const std::uint32_t> listed) {
    for (const std::uint32_t other : listed) {
      if (other == point) continue;
      number[offsets.count] = other;
      offsets.add(cloud.coord[other] - cloud.coord[point]);
    }
  }
  [[nodiscard]] glm::vec3 offset(std::size_t j) const { return {offsets.x[j], offsets.y[j], offsets.z[j]}; }
};

/// The greatest axis of a neighbourhood that is thin, by powers.
glm::vec3 axis_of(const ListedPlaces& around, std::size_t count) {
  glm::vec3 axis = around.offset(count - 1);
  for (int round = 0; round < 4; ++round) {
    glm::vec3 sum(0.0F);
    for (std::size_t j = 0; j < count; ++j) sum += around.offset(j) * glm::dot(around.offset(j), axis);
    const float length = glm::length(sum);
    if (!(length > 0.0F)) return NO_WAY;
    axis = sum / length;
  }
  return axis;
}

/// Finds the next point, and how far it is on the side where that is further, unless the line ends there.
void find_step(const ListedPlaces& around, LinePlace& place) {
  constexpr float FAR = std::numeric_limits<float>::max();
  float nearest[2] = {FAR, FAR};  // behind, ahead
  std::uint32_t number[2] = {0, 0};
  for (std::size_t j = 0; j < around.offsets.count; ++j) {
    const glm::vec3 offset = around.offset(j);
    const float way = glm::dot(offset, place.along);
    if (2.0F * std::abs(way) < glm::length(offset - way * place.along)) continue;  // across: of the next line
    const int side = way > 0.0F ? 1 : 0;
    if (std::abs(way) < nearest[side]) nearest[side] = std::abs(way), number[side] = around.number[j];
  }
  const float less = std::min(nearest[0], nearest[1]), more = std::max(nearest[0], nearest[1]);
  place.step = more <= UNEVEN_STEPS * less ? more : less < FAR ? less : 0.0F;
  place.next = number[nearest[1] < nearest[0] ? 1 : 0];
}

LinePlace place_of(const Cloud& cloud, std::uint32_t i, std::span<const std::uint32_t> listed) {
  const ListedPlaces around(cloud, i, listed);
  LinePlace place;
  for (const auto& [count, thin] :
       {std::pair(around.offsets.count, THIN_LINE), std::pair(FEW_PLACES, THINNEST)}) {
    if (count < FEW_PLACES || count > around.offsets.count || place.along != NO_WAY) continue;
    const glm::dvec3 variances = variances_of(covariance_of(around.offsets, count));
    if (variances.y < thin * variances.z) place.along = axis_of(around, count);
  }
  if (place.along != NO_WAY) find_step(around, place);
  return place;
}

/// Whether a point lies on a line, as close to the next point as that is to others of the same line.
bool is_on_line(const Cloud& cloud, const Survey& survey, std::uint32_t i) {
  const LinePlace place = place_of(cloud, i, survey.around(i));
  if (!(place.step > 0.0F)) return false;
  const LinePlace next = place_of(cloud, place.next, survey.around(place.next));
  return std::abs(glm::dot(place.along, next.along)) >= PARALLEL_LINES_COSINE &&
         place.step <= UNEVEN_STEPS * next.step;
}

/// Whether as many of the points lie on lines as is worth a look.
bool has_lines(const Cloud& cloud, const Survey& survey) {
  const std::size_t stride = cloud.size() / POINTS_ASKED + 1, asked = cloud.size() / stride;
  const auto found = numbers_where(asked, [&](std::size_t n) {
    return is_on_line(cloud, survey, static_cast<std::uint32_t>(n * stride));
  });
  return static_cast<float>(found.size()) > SHARE_ON_LINES * static_cast<float>(asked);
}

/// A line beside a point's, perhaps.
struct Way {
  glm::vec3 across{0.0F};  ///< zero = it is none
  std::uint32_t other = 0;
};

/// The way to the line of another point that is across rather than along.
Way way_to(const Cloud& cloud, const std::vector<LinePlace>& places, std::uint32_t i, std::uint32_t j) {
  const LinePlace &place = places[i], &other = places[j];
  const glm::vec3 offset = cloud.coord[j] - cloud.coord[i];
  const float along = glm::dot(offset, place.along);
  const glm::vec3 across = offset - place.along * along;
  const float gap = glm::length(across);
  const bool beside = gap >= std::abs(along) && gap >= LEAST_GAP * place.step && gap <= MOST_GAP * place.step;
  const bool like = std::abs(glm::dot(place.along, other.along)) >= PARALLEL_LINES_COSINE &&
                    other.step <= MOST_STEP_RATIO * place.step && place.step <= MOST_STEP_RATIO * other.step;
  return beside && like ? Way{across, j} : Way{};
}

/// Takes the nearest lines on either side.
void take_beside(LinePlace& place, std::span<const Way> ways) {
  const auto take = [&](std::size_t side, const Way& way) {
    const float now =
        place.beside[side] == NO_WAY ? std::numeric_limits<float>::max() : glm::length(place.beside[side]);
    if (glm::length(way.across) < now) place.beside[side] = way.across, place.other[side] = way.other;
  };
  for (const Way& way : ways)
    if (way.across != NO_WAY) take(0, way);
  if (place.beside[0] == NO_WAY) return;
  const glm::vec3 first = glm::normalize(place.beside[0]);
  for (const Way& way : ways)
    if (way.across != NO_WAY && glm::dot(way.across, first) < OPPOSITE * glm::length(way.across))
      take(1, way);
}

void look_among_listed(const Cloud& cloud, const Survey& survey, std::vector<LinePlace>& places) {
  tbb::parallel_for(std::size_t{0}, cloud.size(), [&](std::size_t n) {
    if (!(places[n].step > 0.0F)) return;
    const auto i = static_cast<std::uint32_t>(n);
    std::array<Way, Survey::LISTED> ways;
    std::size_t count = 0;
    for (const std::uint32_t j : survey.around(i)) ways[count++] = way_to(cloud, places, i, j);
    take_beside(places[i], std::span(ways).first(count));
  });
}

/// Looks for lines further off among every `stride`-th point on lines, of which as many are near as on the next ones.
void look_among_fewer(const Cloud& cloud, const std::vector<std::uint32_t>& on_lines, std::size_t stride,
                      std::vector<LinePlace>& places, const Stage& stage) {
  Cloud thin;
  std::vector<std::uint32_t> number;
  for (std::size_t n = 0; n < on_lines.size(); n += stride) {
    number.push_back(on_lines[n]);
    thin.coord.push_back(cloud.coord[on_lines[n]]);
  }
  std::vector<std::uint32_t> open;
  for (const std::uint32_t i : on_lines)
    if (places[i].beside[1] == NO_WAY) open.push_back(i);
  if (open.empty()) return;
  const NeighbourSearch search(thin, Sites::positions);
  const auto query = [&](std::uint32_t n) -> NeighbourSearch::Query {
    const float reach = 0.5F * LOOKED_AT * static_cast<float>(stride) * places[open[n]].step;
    return {cloud.coord[open[n]], reach * reach, std::numeric_limits<float>::infinity()};
  };
  search.find_each(open.size(), query, LOOKED_AT, stage, [&](std::uint32_t n, std::span<Neighbour> nearest) {
    std::array<Way, LOOKED_AT> ways;
    for (std::size_t j = 0; j < nearest.size(); ++j)
      ways[j] = way_to(cloud, places, open[n], number[nearest[j].index()]);
    take_beside(places[open[n]], std::span(ways).first(nearest.size()));
  });
}

}  // namespace

std::vector<std::uint32_t> points_on_lines(const Cloud& cloud, const Survey& survey,
                                           const std::vector<std::uint32_t>& points) {
  if (points.empty() || !has_lines(cloud, survey)) return {};
  const auto on_line = [&](std::size_t n) { return is_on_line(cloud, survey, points[n]); };
  return gather(points, numbers_where(points.size(), on_line));
}

std::vector<LinePlace> find_lines(const Cloud& cloud, const Survey& survey, const Stage& stage) {
  if (cloud.size() == 0 || !has_lines(cloud, survey)) return {};
  std::vector<LinePlace> places(cloud.size());
  parallel_each(stage, cloud.size(), [&](std::size_t i) {
    places[i] = place_of(cloud, static_cast<std::uint32_t>(i), survey.around(i));
  });
  const auto on_lines = numbers_where(cloud.size(), [&](std::size_t i) { return places[i].step > 0.0F; });
  look_among_listed(cloud, survey, places);
  for (const std::size_t stride : LINE_STRIDES) look_among_fewer(cloud, on_lines, stride, places, stage);
  return places;
}

}  // namespace splatray
