/// Measures as people write them on a command line.
#pragma once
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

/// What is to be measured.
struct GivenMeasure {
  MeasureKind kind = MeasureKind::distance;
  std::vector<GivenPlace> places;
  double reach = 0.0;  ///< of spheres and cylinders: how far around the place, world units
  std::string name{};  ///< Measure::name

  bool operator==(const GivenMeasure&) const = default;
};

/// Throws Expected unless there are as many places as the kind needs, and the reach of a sphere or cylinder is above 0.
void require_places(const GivenMeasure& given);

/// "X,Y,Z" or "X,Y,Z>DX,DY,DZ", with ; between them; behind the place of a sphere or cylinder the reach. Throws Expected.
[[nodiscard]] GivenMeasure read_measure(MeasureKind kind, const std::string& text);

}  // namespace splatray
