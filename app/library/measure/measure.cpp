#include "app/library/measure/measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

namespace splatray {
namespace {

constexpr double ROUNDED = 1e-4;  ///< of an error: three steps of a splat's normal (OCT_SCALE), radians
/// Share of the widest interval beside it, below which an interval comes of the error of the normal, a degree.
constexpr double NEGLIGIBLE = 0.02;
constexpr double ANY_ANGLE_DEG = 180.0;  ///< the interval of an angle of which nothing is known

using Places = std::vector<glm::dvec3>;

Places places_of(const Measure& measure) {
  Places places;
  for (const SurfacePoint& point : measure.points) places.push_back(point.place);
  return places;
}

/// A value of the points' places and its interval: each of a point's errors moves it by so much, this way or the other.
MeasureValue propagated(const char* name, MeasureUnit unit, const Measure& measure,
                        const std::function<double(const Places&)>& value_of) {
  Places places = places_of(measure);
  const double value = value_of(places);
  double variance = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const glm::dvec3 place = places[i];
    for (const glm::dvec3& error : {measure.points[i].error, measure.points[i].sideways}) {
      double most = 0.0;
      largest = std::max(largest, glm::length(error));
      for (const double way : {1.0, -1.0}) {
        places[i] = place + way * error;
        most = std::max(most, std::abs(value_of(places) - value));
      }
      variance += most * most;
    }
    places[i] = place;
  }
  // Across all errors a length is as exact as it was given; what is left of them there are rounded normals.
  const double deviation = std::sqrt(variance);
  if (unit == MeasureUnit::length && deviation < ROUNDED * largest) return {name, value, 0.0, unit};
  const double within = OF_95_PERCENT * deviation;
  return {name, value, unit == MeasureUnit::degrees ? std::min(within, ANY_ANGLE_DEG) : within, unit};
}

double horizontal_part(const Places& points, const glm::dvec3& up) {
  const glm::dvec3 along = points.back() - points.front();
  return glm::length(along - glm::dot(along, glm::normalize(up)) * glm::normalize(up));
}

double perimeter(Places points) {
  points.push_back(points.front());
  return path_length(points);
}

std::vector<MeasureValue> radius_values(const Measure& measure) {
  if (!measure.fit) return {};
  return {{"radius", measure.fit->radius, OF_95_PERCENT * measure.fit->radius_error, MeasureUnit::length},
          {"residual", measure.fit->residual, 0.0, MeasureUnit::length}};
}

std::vector<MeasureValue> plane_values(const Measure& measure, const glm::dvec3& up) {
  if (!measure.plane) return {};
  const glm::dvec3 level = glm::normalize(up), normal = measure.plane->normal;
  const double tilt = std::atan2(glm::length(glm::cross(normal, level)), std::abs(glm::dot(normal, level)));
  constexpr double OF_RADIANS = 180.0 / std::numbers::pi;
  return {{"tilt", OF_RADIANS * tilt, OF_RADIANS * OF_95_PERCENT * measure.plane->turn_error,
           MeasureUnit::degrees},
          {"residual", measure.plane->residual, 0.0, MeasureUnit::length}};
}

std::vector<MeasureValue> volume_values(const Measure& measure) {
  if (!measure.volume) return {};
  const VolumeFound& found = *measure.volume;
  return {{"cut", found.cut, found.cut_within, MeasureUnit::volume},
          {"fill", found.fill, found.fill_within, MeasureUnit::volume},
          {"net", found.net(), found.net_within, MeasureUnit::volume},
          {"covered", found.area, 0.0, MeasureUnit::area},
          {"uncovered", found.uncovered, 0.0, MeasureUnit::area}};
}

std::vector<MeasureValue> own_values(const Measure& measure, const glm::dvec3& up) {
  if (measure.points.size() < points_needed(measure.kind)) return {};
  const auto value = [&measure](const char* name, const std::function<double(const Places&)>& of,
                                MeasureUnit unit = MeasureUnit::length) {
    return propagated(name, unit, measure, of);
  };
  const auto straight = value("straight", [](const Places& p) { return glm::distance(p.front(), p.back()); });
  const auto horizontal = value("horizontal", [&up](const Places& p) { return horizontal_part(p, up); });
  const auto vertical =
      value("vertical", [&up](const Places& p) { return height_above(p.front(), p.back(), up); });
  switch (measure.kind) {
    case MeasureKind::point:
      return {value("x", [](const Places& p) { return p[0].x; }),
              value("y", [](const Places& p) { return p[0].y; }),
              value("z", [](const Places& p) { return p[0].z; })};
    case MeasureKind::distance: {
      std::vector<MeasureValue> values = {value("distance", [](const Places& p) { return path_length(p); })};
      if (measure.points.size() > 2) values.push_back(straight);
      values.insert(values.end(), {horizontal, vertical});
      return values;
    }
    case MeasureKind::horizontal:
      return {horizontal, vertical};
    case MeasureKind::vertical:
      return {vertical, horizontal};
    case MeasureKind::angle:
      return {value(
          "angle", [](const Places& p) { return angle_deg(p[0], p[1], p[2]); }, MeasureUnit::degrees)};
    case MeasureKind::area:
      return {value(
                  "area", [](const Places& p) { return polygon_area(p); }, MeasureUnit::area),
              value("perimeter", perimeter)};
    case MeasureKind::sphere:
    case MeasureKind::cylinder:
      return radius_values(measure);
    case MeasureKind::plane:
      return plane_values(measure, up);
    case MeasureKind::volume:
      return volume_values(measure);
  }
  return {};
}

}  // namespace

const char* measure_name(MeasureKind kind) {
  static constexpr std::array NAMES = {"point", "distance", "horizontal", "vertical", "angle",
                                       "area",  "sphere",   "cylinder",   "plane",    "volume"};
  return NAMES.at(static_cast<std::size_t>(kind));
}

std::optional<MeasureKind> measure_kind(const std::string& name) {
  for (int kind = 0; kind < MEASURE_KINDS; ++kind)
    if (name == measure_name(static_cast<MeasureKind>(kind))) return static_cast<MeasureKind>(kind);
  return name == OLD_VERTICAL ? std::optional(MeasureKind::vertical) : std::nullopt;
}

std::size_t points_needed(MeasureKind kind) {
  static constexpr std::array<std::size_t, MEASURE_KINDS> NEEDED = {1, 2, 2, 2, 3, 3, 1, 1, 1, 0};
  return NEEDED.at(static_cast<std::size_t>(kind));
}

bool is_open_ended(MeasureKind kind) { return kind == MeasureKind::distance || is_outline(kind); }

bool is_outline(MeasureKind kind) { return kind == MeasureKind::area || kind == MeasureKind::volume; }

bool is_fitted(MeasureKind kind) {
  return kind == MeasureKind::sphere || kind == MeasureKind::cylinder || kind == MeasureKind::plane;
}

void add_point(std::vector<Measure>& measures, MeasureKind kind, const SurfacePoint& point) {
  const bool goes_on = !measures.empty() && measures.back().kind == kind &&
                       (is_open_ended(kind) || measures.back().points.size() < points_needed(kind));
  if (!goes_on) measures.push_back({kind, {}});
  measures.back().points.push_back(point);
}

double path_length(std::span<const glm::dvec3> points) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += glm::distance(points[i - 1], points[i]);
  return length;
}

double height_above(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& up) {
  return glm::dot(b - a, glm::normalize(up));
}

double angle_deg(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 to_a = a - b, to_c = c - b;
  return std::atan2(glm::length(glm::cross(to_a, to_c)), glm::dot(to_a, to_c)) * 180.0 / std::numbers::pi;
}

double polygon_area(std::span<const glm::dvec3> points) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
    sum += glm::cross(points[i] - points[0], points[i + 1] - points[0]);
  return 0.5 * glm::length(sum);
}

std::vector<MeasureValue> values_of(const Measure& measure, const glm::dvec3& up) {
  std::vector<MeasureValue> values = own_values(measure, up);
  for (MeasureValue& value : values) {
    double widest = 0.0;
    for (const MeasureValue& other : values)
      if (other.unit == value.unit) widest = std::max(widest, other.within);
    if (value.within > NEGLIGIBLE * widest) continue;
    value.within = 0.0;
    value.beside = widest;
  }
  return values;
}

}  // namespace splatray
