/// What is measured on a surface: lengths, heights, angles, areas, radii. World units of the file, float64, each value with how far off
/// it may be.
#pragma once
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/library/measure/plane_fit.h"
#include "app/library/measure/radius_fit.h"
#include "app/library/measure/volume_found.h"

namespace splatray {

/// A place on a surface.
struct SurfacePoint {
  glm::dvec3 place{0.0};  ///< world
  /// Standard deviation of the position, as a vector along which it would shift; 0 = exact.
  glm::dvec3 error{0.0};
  /// Which way it was moved along the surface from the place that was given, and how far: an error as the other is; 0 = not.
  glm::dvec3 sideways{0.0};

  bool operator==(const SurfacePoint&) const = default;
};

enum class MeasureKind {
  point,       ///< its coordinates
  distance,    ///< along two points and more
  horizontal,  ///< between two points, across the up direction
  vertical,    ///< of the second above the first, along the up direction
  angle,       ///< at the second of three
  area,        ///< of the polygon of three and more
  sphere,      ///< its radius
  cylinder,    ///< its radius
  plane,       ///< its tilt: the angle to a level one
  volume       ///< cut and fill over an outline, against a base
};
inline constexpr int MEASURE_KINDS = 10;
inline constexpr int MARKED_KINDS = 9;  ///< the first ones, which their points alone make
/// Standard deviations of a normal distribution to either side that hold 95 % of it.
inline constexpr double OF_95_PERCENT = 1.96;
[[nodiscard]] const char* measure_name(MeasureKind kind);
/// What a vertical measure was called before.
inline constexpr const char* OLD_VERTICAL = "height";
/// The kind of this name, or of an old one.
[[nodiscard]] std::optional<MeasureKind> measure_kind(const std::string& name);
/// Points that complete a measure; more may follow where `is_open_ended`.
[[nodiscard]] std::size_t points_needed(MeasureKind kind);
[[nodiscard]] bool is_open_ended(MeasureKind kind);
/// Whether it is of what lies around its point: spheres, cylinders and planes.
[[nodiscard]] bool is_fitted(MeasureKind kind);
/// Whether its points go all around: of areas and volumes.
[[nodiscard]] bool is_outline(MeasureKind kind);

/// A measure, maybe of too few points yet.
struct Measure {
  MeasureKind kind = MeasureKind::distance;
  std::vector<SurfacePoint> points;
  std::optional<RadiusFit> fit{};       ///< of spheres and cylinders
  std::optional<PlaneFit> plane{};      ///< of planes
  std::string name{};                   ///< given by who measures, UTF-8; may be empty
  std::optional<VolumeFound> volume{};  ///< of volumes

  bool operator==(const Measure&) const = default;
};

/// Adds a point to the last measure of a kind that takes more, else to a new one.
void add_point(std::vector<Measure>& measures, MeasureKind kind, const SurfacePoint& point);

/// Sum of the lengths from point to point.
[[nodiscard]] double path_length(std::span<const glm::dvec3> points);
/// Height of b above a; `up` of any length > 0.
[[nodiscard]] double height_above(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& up);
/// Angle at b, degrees 0..180; 0 where points coincide.
[[nodiscard]] double angle_deg(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);
/// Area of a polygon whose corners need not lie in one plane exactly: half the length of its vector area (Newell).
[[nodiscard]] double polygon_area(std::span<const glm::dvec3> points);

enum class MeasureUnit { length, area, degrees, volume };

/// A value, and the half-width of its 95 % confidence interval, as errors of points propagate to
/// it (JCGM 100:2008, sec. 5): of the surface, as smooth_error has it, not of the scans' registration and scale.
struct MeasureValue {
  std::string name;
  double value = 0.0;
  double within = 0.0;
  MeasureUnit unit = MeasureUnit::length;
  /// The widest interval among the measure's values of its unit, for a value whose own is none or next to none beside it; 0 = none.
  double beside = 0.0;
};
/// What a measure says: of a distance also its horizontal and vertical part, of an area also its perimeter. Empty while points
/// are missing.
[[nodiscard]] std::vector<MeasureValue> values_of(const Measure& measure, const glm::dvec3& up);

}  // namespace splatray
