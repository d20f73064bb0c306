#include "app/view/model/measure.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace splatray {
namespace {

/// Six digits of a value; coordinates have all that may matter.
std::string number(double value, const char* format = "%.6g") {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

constexpr const char* COORDINATE = "%.12g";

}  // namespace

const char* measure_name(MeasureKind kind) {
  static constexpr std::array NAMES = {"distance", "height", "angle", "area"};
  return NAMES.at(static_cast<std::size_t>(kind));
}

std::size_t points_needed(MeasureKind kind) {
  return kind == MeasureKind::distance || kind == MeasureKind::height ? 2 : 3;
}

bool is_open_ended(MeasureKind kind) { return kind == MeasureKind::distance || kind == MeasureKind::area; }

void add_point(std::vector<Measure>& measures, MeasureKind kind, const glm::dvec3& point) {
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
  const std::vector<glm::dvec3>& points = measure.points;
  if (points.size() < points_needed(measure.kind)) return {};
  const double vertical = height_above(points.front(), points.back(), up);
  const double straight = glm::distance(points.front(), points.back());
  const double level = std::sqrt(std::max(straight * straight - vertical * vertical, 0.0));
  switch (measure.kind) {
    case MeasureKind::distance: {
      std::vector<MeasureValue> values = {{"distance", number(path_length(points))}};
      if (points.size() > 2) values.push_back({"straight", number(straight)});
      values.push_back({"level", number(level)});
      values.push_back({"upright", number(vertical)});
      return values;
    }
    case MeasureKind::height:
      return {{"height", number(vertical)}, {"level", number(level)}};
    case MeasureKind::angle:
      return {{"angle", number(angle_deg(points[0], points[1], points[2])) + "\u00B0"}};
    case MeasureKind::area: {
      std::vector<glm::dvec3> round = points;
      round.push_back(points.front());
      return {{"area", number(polygon_area(points))}, {"perimeter", number(path_length(round))}};
    }
  }
  return {};
}

std::string short_text(const Measure& measure, const glm::dvec3& up) {
  const std::vector<MeasureValue> values = values_of(measure, up);
  return values.empty() ? std::string() : values.front().text;
}

std::string table_of(std::span<const Measure> measures, const glm::dvec3& up) {
  std::string text;
  for (const Measure& measure : measures) {
    for (const MeasureValue& value : values_of(measure, up)) text += value.name + "\t" + value.text + "\n";
    for (const glm::dvec3& point : measure.points)
      text += "point\t" + number(point.x, COORDINATE) + "\t" + number(point.y, COORDINATE) + "\t" +
              number(point.z, COORDINATE) + "\n";
  }
  return text;
}

}  // namespace splatray
