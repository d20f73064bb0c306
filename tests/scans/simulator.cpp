#include "tests/scans/simulator.h"

#include <cmath>
#include <numbers>
#include <random>

namespace splatray::testing {
namespace {

constexpr double DEGREE = std::numbers::pi / 180.0;
constexpr double STRAYS_FROM = 0.2, STRAYS_TO = 1.6;  // ranges of strays, in units of the true one

glm::dvec3 direction(double azimuth, double elevation) {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

/// One station's beams.
class Beams {
 public:
  Beams(const Cast& cast, const Scanner& scanner, const glm::dvec3& sensor, std::uint64_t seed)
      : cast_(cast), scanner_(scanner), sensor_(sensor), random_(seed) {}

  void send(std::uint32_t row, std::uint32_t column, std::uint16_t station, SimulatedScan& scan) {
    const double share = scanner_.rows > 1 ? static_cast<double>(row) / (scanner_.rows - 1.0) : 0.0;
    const double elevation = DEGREE * (scanner_.low_deg + share * (scanner_.high_deg - scanner_.low_deg));
    const double azimuth = 2.0 * std::numbers::pi * column / scanner_.columns;
    const glm::dvec3 dir = direction(azimuth, elevation);
    const SolidHit hit = cast_(sensor_, dir);
    const double noise = normal_(random_), mix = unit_(random_), rim = unit_(random_), stray = unit_(random_);
    if (!hit.found()) return;
    double range = hit.t + scanner_.noise * noise;
    PointKind kind = PointKind::surface;
    const double turn = 2.0 * std::numbers::pi * rim;
    const double half = 0.5 * DEGREE * scanner_.beam_deg;
    const SolidHit other =
        scanner_.beam_deg > 0.0
            ? cast_(sensor_, direction(azimuth + half * std::cos(turn) / std::cos(elevation),
                                       elevation + half * std::sin(turn)))
            : hit;
    if (other.found() && std::abs(other.t - hit.t) > scanner_.jump) {
      range = glm::mix(hit.t, other.t, mix);
      kind = PointKind::mixed;
    }
    if (stray < scanner_.stray_share) {
      range = hit.t * glm::mix(STRAYS_FROM, STRAYS_TO, mix);
      kind = PointKind::stray;
    }
    scan.points.position.push_back(sensor_ + range * dir);
    scan.points.station.push_back(station);
    scan.points.grid_cell.push_back(row * scanner_.columns + column);
    scan.normal.emplace_back(hit.normal);
    scan.kind.push_back(kind);
  }

 private:
  const Cast& cast_;
  const Scanner& scanner_;
  glm::dvec3 sensor_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> unit_;
};

}  // namespace

Scanner terrestrial(double step_deg, double noise) {
  Scanner scanner{.rows = static_cast<std::uint32_t>(150.0 / step_deg),
                  .columns = static_cast<std::uint32_t>(360.0 / step_deg),
                  .low_deg = -60.0,
                  .high_deg = 90.0 - step_deg,
                  .noise = noise};
  scanner.beam_deg = 0.5 * step_deg;
  scanner.stray_share = 1e-3;
  return scanner;
}

Scanner spinning(std::uint32_t columns, double noise) {
  Scanner scanner{.rows = 64, .columns = columns, .low_deg = -25.0, .high_deg = 15.0, .noise = noise};
  scanner.beam_deg = 0.1;
  scanner.stray_share = 1e-3;
  return scanner;
}

SimulatedScan simulate(const Cast& cast, const Scanner& scanner, const std::vector<glm::dvec3>& sensors,
                       std::uint64_t seed) {
  SimulatedScan scan;
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    scan.points.stations.push_back(
        {"station " + std::to_string(s + 1), sensors[s], scanner.rows, scanner.columns});
    Beams beams(cast, scanner, sensors[s], seed + s);
    for (std::uint32_t row = 0; row < scanner.rows; ++row)
      for (std::uint32_t column = 0; column < scanner.columns; ++column)
        beams.send(row, column, static_cast<std::uint16_t>(s), scan);
  }
  return scan;
}

SimulatedScan simulate(const std::vector<Solid>& solids, const Scanner& scanner,
                       const std::vector<glm::dvec3>& sensors, std::uint64_t seed) {
  const Cast cast = [&](const glm::dvec3& origin, const glm::dvec3& dir) {
    return nearest_hit(solids, origin, dir);
  };
  return simulate(cast, scanner, sensors, seed);
}

}  // namespace splatray::testing
