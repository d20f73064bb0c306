/// Scans of known surfaces, with the errors that scanners make.
#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "preprocess/points.h"
#include "tests/scans/solids.h"

namespace splatray::testing {

/// What a simulated point is of.
enum class PointKind : std::uint8_t { surface, mixed, stray };

/// How a scanner measures: rows of elevation by columns around the vertical axis z.
struct Scanner {
  std::uint32_t rows, columns;
  double low_deg, high_deg;  ///< elevations of the first and the last row
  double noise = 0.0;        ///< standard deviation along the beam, world units
  double beam_deg = 0.0;     ///< width of the beam: where its rim meets something else, ranges mix; 0 = none
  double jump = 0.1;         ///< least difference of ranges in a beam that gives a mixed pixel, world units
  double stray_share = 0.0;  ///< of the beams: a range at random
};

/// A terrestrial scanner: even steps of `step_deg` from 60 degrees below the horizon to the zenith.
[[nodiscard]] Scanner terrestrial(double step_deg, double noise);
/// A spinning sensor of 64 rings from -25 to 15 degrees, `columns` around.
[[nodiscard]] Scanner spinning(std::uint32_t columns, double noise);

/// Points as a reader delivers them, and the truth beside them.
struct SimulatedScan {
  Points points;  ///< with stations, their sensors and grids
  std::vector<glm::vec3>
      normal;  ///< true normals, towards the scanner; of strays and mixed pixels those of the surface behind
  std::vector<PointKind> kind;
};

/// What a beam meets.
using Cast = std::function<SolidHit(const glm::dvec3& origin, const glm::dvec3& dir)>;

/// Scans from each of the places, in the order of rows and columns; the same for the same seed.
[[nodiscard]] SimulatedScan simulate(const Cast& cast, const Scanner& scanner,
                                     const std::vector<glm::dvec3>& sensors, std::uint64_t seed);
[[nodiscard]] SimulatedScan simulate(const std::vector<Solid>& solids, const Scanner& scanner,
                                     const std::vector<glm::dvec3>& sensors, std::uint64_t seed);

}  // namespace splatray::testing
