#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <span>

#include "preprocess/base/select.h"
#include "preprocess/scan/line/lines.h"

namespace splatray {
namespace {

constexpr std::size_t STEPS_ASKED = 1000;  // that show how alike they look from a place
constexpr std::size_t STARTS = 400;        // points that the place may be near: most lie around the scanner
constexpr std::size_t BEST = 6;            // of them that are looked around
constexpr double FIRST_MOVE = 0.1, LAST_MOVE = 1e-5;  // cloud coordinates
constexpr int MOST_MOVES = 200;                       // enough to cross the cloud ten times
constexpr double MOST_UNLIKE =
    0.06;  // median deviation of the angles over their median: rings are 0.02, scans by rows 0.2 and more

const glm::dvec3 NO_AXIS(0.0);

/// A step along a line: both its ends.
struct LineStep {
  glm::dvec3 from, to;
};

std::vector<LineStep> some_steps(const Cloud& cloud, const std::vector<LinePlace>& places) {
  const auto on_lines = numbers_where(places.size(), [&](std::size_t i) { return places[i].step > 0.0F; });
  const std::size_t stride = on_lines.size() / STEPS_ASKED + 1;
  std::vector<LineStep> steps;
  for (std::size_t n = 0; n < on_lines.size(); n += stride) {
    const std::uint32_t i = on_lines[n];
    steps.push_back({glm::dvec3(cloud.coord[i]), glm::dvec3(cloud.coord[places[i].next])});
  }
  return steps;
}

/// How little alike steps look from a place: the median deviation of the angles that they are seen under, over their median. With an
/// axis the angles are those about it, and steps that rise or fall are unlike too, as a ring is seen at one elevation.
double unlikeness(std::span<const LineStep> steps, const glm::dvec3& eye, const glm::dvec3& axis) {
  std::vector<double> angles(steps.size()), rises(steps.size());
  for (std::size_t n = 0; n < steps.size(); ++n) {
    const glm::dvec3 from = glm::normalize(steps[n].from - eye), to = glm::normalize(steps[n].to - eye);
    const double low = glm::dot(from, axis), high = glm::dot(to, axis);
    const double turned = std::sqrt((1.0 - low * low) * (1.0 - high * high));
    angles[n] = glm::length(glm::cross(from, to));
    if (axis != glm::dvec3(0.0))
      angles[n] = turned > 0.0 ? std::abs(glm::dot(axis, glm::cross(from, to))) / turned : 0.0;
    rises[n] = high - low;
  }
  std::vector<double> ranked = angles;
  const double usual = median_of(std::span(ranked));
  if (!(usual > 0.0)) return std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < steps.size(); ++n) ranked[n] = std::hypot(angles[n] - usual, rises[n]) / usual;
  return median_of(std::span(ranked));
}

/// A place and how little alike steps look from there.
struct Eye {
  double unlike;
  glm::dvec3 place;
};

bool is_among(const glm::dvec3& place) {
  const glm::dvec3 off = glm::abs(place);
  return std::max({off.x, off.y, off.z}) <= 1.0;
}

/// Moves along the axes while that helps, ever less far (Hooke and Jeeves 1961, without pattern moves), but not out of the cloud: from
/// ever farther away all steps look ever more alike.
Eye settle(std::span<const LineStep> steps, const glm::dvec3& axis, const glm::dvec3& start) {
  Eye eye{unlikeness(steps, start, axis), start};
  double move = FIRST_MOVE;
  for (int round = 0; round < MOST_MOVES && move > LAST_MOVE; ++round) {
    Eye best = eye;
    for (int side = 0; side < 3; ++side) {
      for (const double by : {-move, move}) {
        glm::dvec3 place = eye.place;
        place[side] += by;
        if (!is_among(place)) continue;
        const double unlike = unlikeness(steps, place, axis);
        if (unlike < best.unlike) best = {unlike, place};
      }
    }
    if (best.unlike < eye.unlike)
      eye = best;
    else
      move *= 0.5;
  }
  return eye;
}

}  // namespace

std::optional<glm::dvec3> find_spinning_sensor(const Cloud& cloud, const std::vector<LinePlace>& places) {
  const std::vector<LineStep> steps = some_steps(cloud, places);
  if (steps.size() < STEPS_ASKED / 4) return {};
  std::vector<Eye> eyes(std::min(STARTS, cloud.size()));
  const auto try_all = [&](const auto& eye_of) {
    tbb::parallel_for(std::size_t{0}, eyes.size(), [&](std::size_t n) { eyes[n] = eye_of(n); });
    std::sort(eyes.begin(), eyes.end(), [](const Eye& a, const Eye& b) { return a.unlike < b.unlike; });
  };
  try_all([&](std::size_t n) {
    const glm::dvec3 place(cloud.coord[n * cloud.size() / eyes.size()]);
    return Eye{unlikeness(steps, place, NO_AXIS), place};
  });
  eyes.resize(std::min(BEST, eyes.size()));
  try_all([&](std::size_t n) { return settle(steps, NO_AXIS, eyes[n].place); });
  const Eye best = settle(steps, axis_of_lines(places), eyes.front().place);
  return is_among(best.place) && best.unlike < MOST_UNLIKE ? std::optional(best.place) : std::nullopt;
}

}  // namespace splatray
