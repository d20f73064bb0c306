#include "preprocess/scan/flight_track.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>

#include "preprocess/base/bounds.h"
#include "preprocess/base/parallel.h"

namespace splatray {
namespace {

constexpr double BIN = 0.5;               // seconds
constexpr std::size_t LEAST_PULSES = 15;  // of a bin
constexpr double LEAST_FLIGHT_HEIGHT =
    0.25;  // of the sensor, in units of the diagonal of what it saw in a bin
constexpr double LEAST_SPREAD =
    1e-4;  // determinant of the mean of I - d d^T: below this the lines are parallel

/// A pulse's first and last return.
struct Pulse {
  double time;
  glm::dvec3 first, last;
};

std::vector<Pulse> find_pulses(const Cloud& cloud, const Column& number, const Column& returns,
                               const Column& time) {
  auto some = numbers_where(cloud.size(), [&](std::size_t i) {
    const double of = returns.number(i), which = number.number(i);
    return of >= 2.0 && (which == 1.0 || which == of) && std::isfinite(time.number(i));
  });
  std::sort(some.begin(), some.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto key = [&](std::uint32_t i) { return std::tuple(time.number(i), number.number(i), i); };
    return key(a) < key(b);
  });
  std::vector<Pulse> pulses;
  for (std::size_t k = 0; k + 1 < some.size(); ++k) {
    const std::uint32_t a = some[k], b = some[k + 1];
    const bool one_pulse =
        time.number(a) == time.number(b) && number.number(a) == 1.0 && number.number(b) > 1.0;
    if (one_pulse && cloud.coord[a] != cloud.coord[b])
      pulses.push_back({time.number(a), cloud.place_world(a), cloud.place_world(b)});
  }
  return pulses;
}

/// Where the lines of the pulses meet, relative to `middle`; false where they are too nearly parallel.
bool meet(std::span<const Pulse> pulses, const glm::dvec3& middle, glm::dvec3& place) {
  glm::dmat3 matrix(0.0);
  glm::dvec3 right(0.0);
  double weights = 0.0;
  for (const Pulse& pulse : pulses) {
    const glm::dvec3 along = pulse.first - pulse.last;
    const double weight = glm::dot(along, along);
    const glm::dmat3 across = glm::dmat3(weight) - glm::outerProduct(along, along);  // weight (I - d d^T)
    matrix += across;
    right += across * (pulse.first - middle);
    weights += weight;
  }
  if (!(weights > 0.0) || !(glm::determinant(matrix / weights) > LEAST_SPREAD)) return false;
  place = glm::inverse(matrix / weights) * (right / weights);
  return true;
}

}  // namespace

FlightTrack::FlightTrack(const Cloud& cloud, const glm::dvec3& up) {
  const Column* number = find_column(cloud.columns, COLUMN_RETURN);
  const Column* returns = find_column(cloud.columns, COLUMN_RETURNS);
  const Column* time = find_column(cloud.columns, COLUMN_TIME);
  if (time != nullptr && !cloud.track.empty()) places_ = cloud.track;
  if (number == nullptr || returns == nullptr || time == nullptr || !places_.empty()) return;
  const std::vector<Pulse> pulses = find_pulses(cloud, *number, *returns, *time);
  for (std::size_t begin = 0; begin < pulses.size();) {
    std::size_t end = begin;
    Bounds bounds;
    double times = 0.0;
    // The first belongs to the bin even where half a second is less than the time's last bit.
    for (; end < pulses.size() && (end == begin || pulses[end].time < pulses[begin].time + BIN); ++end) {
      bounds.add(pulses[end].first);
      times += pulses[end].time;
    }
    const std::span<const Pulse> bin = std::span(pulses).subspan(begin, end - begin);
    const glm::dvec3 middle = 0.5 * (bounds.low + bounds.high);
    glm::dvec3 place;
    if (bin.size() >= LEAST_PULSES && meet(bin, middle, place) &&
        glm::dot(place, up) > LEAST_FLIGHT_HEIGHT * glm::length(bounds.high - bounds.low))
      places_.push_back({times / static_cast<double>(bin.size()), middle + place});
    begin = end;
  }
}

glm::dvec3 FlightTrack::at(double time) const {
  const auto after =
      std::lower_bound(places_.begin(), places_.end(), time,
                       [](const TrackPlace& place, double value) { return place.time < value; });
  if (after == places_.begin()) return places_.front().sensor_world;
  if (after == places_.end()) return places_.back().sensor_world;
  const TrackPlace& before = *(after - 1);
  const double share = (time - before.time) / (after->time - before.time);
  return glm::mix(before.sensor_world, after->sensor_world, share);
}

}  // namespace splatray
