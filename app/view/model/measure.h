/// Lengths, heights, angles and areas between points that a person chose on the surface. World units of the file, float64.
#pragma once
#include <array>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

namespace splatray {

enum class MeasureKind {
  distance,  ///< along two points and more
  height,    ///< of the second above the first, along the up direction
  angle,     ///< at the second of three
  area       ///< of the polygon of three and more
};
inline constexpr int MEASURE_KINDS = 4;
[[nodiscard]] const char* measure_name(MeasureKind kind);
/// Points that complete a measure; more may follow where `is_open_ended`.
[[nodiscard]] std::size_t points_needed(MeasureKind kind);
[[nodiscard]] bool is_open_ended(MeasureKind kind);

/// A measure, maybe of too few points yet.
struct Measure {
  MeasureKind kind = MeasureKind::distance;
  std::vector<glm::dvec3> points;  ///< world

  bool operator==(const Measure&) const = default;
};

/// Adds a point to the last measure of a kind that takes more, else to a new one.
void add_point(std::vector<Measure>& measures, MeasureKind kind, const glm::dvec3& point);

/// Sum of the lengths from point to point.
[[nodiscard]] double path_length(std::span<const glm::dvec3> points);
/// Of b above a; `up` of any length > 0.
[[nodiscard]] double height_above(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& up);
/// At b, degrees 0..180; 0 where points coincide.
[[nodiscard]] double angle_deg(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);
/// Of a polygon, whose corners need not lie in one plane exactly: half the length of its vector area (Newell).
[[nodiscard]] double polygon_area(std::span<const glm::dvec3> points);

/// What a measure says, a name and a value each: of a distance also its horizontal and vertical part, of an area also its perimeter.
/// Empty while points are missing.
struct MeasureValue {
  std::string name;
  std::string text;
};
[[nodiscard]] std::vector<MeasureValue> values_of(const Measure& measure, const glm::dvec3& up);
/// The value that stands beside the marks in the picture.
[[nodiscard]] std::string short_text(const Measure& measure, const glm::dvec3& up);
/// For the clipboard: a line for each value and each point, tabs between.
[[nodiscard]] std::string table_of(std::span<const Measure> measures, const glm::dvec3& up);

}  // namespace splatray
