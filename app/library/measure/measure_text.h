/// Measures as people write them on a command line.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/library/measure/measure.h"

namespace splatray {

/// A place as it is given: a point, moved to the nearest surface if that is near, or a ray, whose first hit counts.
struct GivenPlace {
  glm::dvec3 place{0.0};                ///< world
  std::optional<glm::dvec3> direction;  ///< of a ray from there

  bool operator==(const GivenPlace&) const = default;
};

/// What a volume is measured against.
struct GivenBase {
  enum class Kind {
    height,   ///< a level plane
    plane,    ///< through a place, across a normal
    corners,  ///< the plane that fits best through the outline's corners on the surface
    earlier   ///< another scan
  };
  Kind kind = Kind::height;
  double height = 0.0;                 ///< along the up axis, world units
  glm::dvec3 place{0.0}, normal{0.0};  ///< of a plane, world
  std::filesystem::path earlier{};     ///< what reads as a scene

  bool operator==(const GivenBase&) const = default;
};
/// z=HEIGHT, plane=X,Y,Z,NX,NY,NZ, corners or earlier=FILE. Throws Expected.
[[nodiscard]] GivenBase read_base(const std::string& text);

/// What is to be measured.
struct GivenMeasure {
  MeasureKind kind = MeasureKind::distance;
  std::vector<GivenPlace> places;
  double reach = 0.0;               ///< of spheres and cylinders: how far around the place, world units
  std::string name{};               ///< Measure::name
  std::optional<GivenBase> base{};  ///< of volumes

  bool operator==(const GivenMeasure&) const = default;
};

/// Throws Expected unless there are as many places as the kind needs, the reach of a sphere or cylinder is above 0, and a volume has a base
/// and no outline or one of three places and more.
void require_places(const GivenMeasure& given);

/// "X,Y,Z" or "X,Y,Z>DX,DY,DZ", with ; between them; behind the place of a sphere or cylinder the reach, behind those of a
/// volume its base. Throws Expected.
[[nodiscard]] GivenMeasure read_measure(MeasureKind kind, const std::string& text);

}  // namespace splatray
