#include "app/library/measure/measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>

namespace splatray {
namespace {

constexpr double ROUNDED = 1e-4;        ///< of an error: three steps of a splat's normal (OCT_SCALE), radians
constexpr double OF_95_PERCENT = 1.96;  ///< standard deviations of a normal distribution

std::string formatted(double value, const char* format) {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

/// For printf: as many digits as the interval has two of.
std::string format_of(const MeasureValue& value) {
  if (!(value.within > 0.0)) return "%.9g";
  const int digits = std::clamp(1 - static_cast<int>(std::floor(std::log10(value.within))), 0, 12);
  return "%." + std::to_string(digits) + "f";
}

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
  return {name, value, OF_95_PERCENT * deviation, unit};
}

double level_part(const Places& points, const glm::dvec3& up) {
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

}  // namespace

const char* measure_name(MeasureKind kind) {
  static constexpr std::array NAMES = {"point", "distance", "height", "angle", "area", "sphere", "cylinder"};
  return NAMES.at(static_cast<std::size_t>(kind));
}

std::optional<MeasureKind> measure_kind(const std::string& name) {
  for (int kind = 0; kind < MEASURE_KINDS; ++kind)
    if (name == measure_name(static_cast<MeasureKind>(kind))) return static_cast<MeasureKind>(kind);
  return {};
}

std::size_t points_needed(MeasureKind kind) {
  static constexpr std::array<std::size_t, MEASURE_KINDS> NEEDED = {1, 2, 2, 3, 3, 1, 1};
  return NEEDED.at(static_cast<std::size_t>(kind));
}

bool is_open_ended(MeasureKind kind) { return kind == MeasureKind::distance || kind == MeasureKind::area; }

bool is_fitted(MeasureKind kind) { return kind == MeasureKind::sphere || kind == MeasureKind::cylinder; }

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
  if (measure.points.size() < points_needed(measure.kind)) return {};
  const auto value = [&measure](const char* name, const std::function<double(const Places&)>& of,
                                MeasureUnit unit = MeasureUnit::length) {
    return propagated(name, unit, measure, of);
  };
  const auto straight = value("straight", [](const Places& p) { return glm::distance(p.front(), p.back()); });
  const auto level = value("level", [&up](const Places& p) { return level_part(p, up); });
  const auto upright = [&](const char* name) {
    return value(name, [&up](const Places& p) { return height_above(p.front(), p.back(), up); });
  };
  switch (measure.kind) {
    case MeasureKind::point:
      return {value("x", [](const Places& p) { return p[0].x; }),
              value("y", [](const Places& p) { return p[0].y; }),
              value("z", [](const Places& p) { return p[0].z; })};
    case MeasureKind::distance: {
      std::vector<MeasureValue> values = {value("distance", [](const Places& p) { return path_length(p); })};
      if (measure.points.size() > 2) values.push_back(straight);
      values.insert(values.end(), {level, upright("upright")});
      return values;
    }
    case MeasureKind::height:
      return {upright("height"), level};
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
  }
  return {};
}

std::string value_text(const MeasureValue& value) {
  const char* unit = value.unit == MeasureUnit::degrees ? "\u00B0" : "";
  const std::string format = format_of(value), number = formatted(value.value, format.c_str()) + unit;
  if (!(value.within > 0.0)) return number;
  return number + " \u00B1" + formatted(value.within, format.c_str()) + unit;
}

std::string short_text(const Measure& measure, const glm::dvec3& up) {
  const std::vector<MeasureValue> values = values_of(measure, up);
  if (values.empty()) return {};
  if (measure.kind == MeasureKind::point) {
    std::string text;
    for (const MeasureValue& value : values)
      text += (text.empty() ? "" : ", ") + formatted(value.value, format_of(value).c_str());
    return text;
  }
  const std::string sign = measure.kind == MeasureKind::area ? "A " : (is_fitted(measure.kind) ? "R " : "");
  return sign + value_text(values.front());
}

std::string table_of(std::span<const Measure> measures, const glm::dvec3& up) {
  std::string text;
  for (const Measure& measure : measures) {
    for (const MeasureValue& value : values_of(measure, up))
      text += std::string(measure_name(measure.kind)) + "\t" + value.name + "\t" + value_text(value) + "\n";
    for (const SurfacePoint& point : measure.points) {
      text += "\tat";
      for (int axis = 0; axis < 3; ++axis) text += "\t" + formatted(point.place[axis], "%.12g");
      text += "\n";
    }
  }
  return text;
}

}  // namespace splatray
