/// splatray-scan-table [FOLDER [NAME]]: what preprocess makes of scans whose truth is known, a line each: of simulated ones,
/// and of those of a data folder (SPLATRAY_DATA_DIR where none is named); only those whose names hold NAME. M/cpus: million points
/// a second of CPU time.
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <numeric>
#include <string>

#include "engine/scene/splat.h"
#include "preprocess/build.h"
#include "preprocess/scan/sides.h"
#include "tests/scan_sim/picture_errors.h"
#include "tests/scan_sim/ring_errors.h"
#include "tests/scan_sim/scan_cases.h"

namespace splatray::testing {
namespace {

constexpr double GRAZING_DEG = 5.0;  // points seen at less count for no side
constexpr std::uint32_t PIXELS = 512;
constexpr std::uint32_t RING_RAYS = 40000;

struct Scores {
  double lost_percent = 0.0, found_percent = 0.0;  ///< of the good points; of strays and mixed pixels
  double axis_median_deg = 0.0, axis_p95_deg = 0.0;
  double sides_percent = 0.0;                          ///< right ones, of what is not seen at a grazing angle
  double surface_percent = 0.0, leaves_percent = 0.0;  ///< whose kind is right, of what is drawn
};

double degrees(double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi; }

bool grazes(const SimulatedScan& scan, std::size_t i) {
  const Points& points = scan.points;
  if (points.stations.empty()) return false;
  const glm::dvec3 sensor = *points.stations[points.station.empty() ? 0 : points.station[i]].sensor_world;
  const glm::dvec3 to_sensor = glm::normalize(sensor - points.position[i]);
  return std::abs(90.0 - degrees(glm::dot(to_sensor, scan.normal[i]))) < GRAZING_DEG;
}

/// Scores whether the build sorted the points right.
void score_kinds(const SimulatedScan& scan, const Scene& scene, Scores& scores) {
  const Column& number = *find_column(scene.columns, "number");
  const Column* kinds = find_column(scene.columns, COLUMN_KIND);
  double all[2]{}, right[2]{};
  for (std::size_t s = 0; s < scene.data_pool.size(); ++s) {
    const PointKind truth = scan.kind[static_cast<std::size_t>(number.number(s))];
    if (truth != PointKind::surface && truth != PointKind::leaf) continue;
    const bool leaf = truth == PointKind::leaf;
    all[leaf] += 1.0;
    right[leaf] += (kinds != nullptr && kinds->number(s) > 0.0) == leaf ? 1.0 : 0.0;
  }
  scores.surface_percent = 100.0 * right[0] / std::max(all[0], 1.0);
  scores.leaves_percent = 100.0 * right[1] / std::max(all[1], 1.0);
}

Scores score(const SimulatedScan& scan, const Scene& scene) {
  Scores scores;
  std::vector<std::uint8_t> drawn(scan.size());
  std::vector<double> angles;
  double right = 0.0, judged = 0.0;
  const Column& number = *find_column(scene.columns, "number");
  for (std::size_t s = 0; s < scene.data_pool.size(); ++s) {
    const auto i = static_cast<std::size_t>(number.number(s));
    drawn[i] = 1;
    if (scan.kind[i] != PointKind::surface || scan.normal[i] == glm::dvec3(0.0)) continue;
    const double cosine = glm::dot(unpack_splat(scene.data_pool[s]).normal, glm::normalize(scan.normal[i]));
    angles.push_back(degrees(std::abs(cosine)));
    if (grazes(scan, i)) continue;
    judged += 1.0;
    right += cosine > 0.0 ? 1.0 : 0.0;
  }
  double good = 0.0, lost = 0.0, bad = 0.0, found = 0.0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const bool surface = scan.kind[i] == PointKind::surface || scan.kind[i] == PointKind::leaf;
    (surface ? good : bad) += 1.0;
    if (drawn[i] == 0) (surface ? lost : found) += 1.0;
  }
  std::sort(angles.begin(), angles.end());
  scores.lost_percent = 100.0 * lost / std::max(good, 1.0);
  scores.found_percent = 100.0 * found / std::max(bad, 1.0);
  scores.sides_percent = 100.0 * right / std::max(judged, 1.0);
  if (!angles.empty())
    scores.axis_median_deg = angles[angles.size() / 2],
    scores.axis_p95_deg = angles[angles.size() * 95 / 100];
  score_kinds(scan, scene, scores);
  return scores;
}

/// Seconds of CPU time that this process has taken.
double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::string rung_of(const BuildStats& stats) {
  for (std::size_t rung = 0; rung < SIDE_RUNGS; ++rung)
    if (stats.sides_by[rung] > 0) return std::string(name_of(static_cast<SideRung>(rung)));
  return "given";
}

void measure(ScanCase scan_case) {
  Input input;
  InputObject object;
  object.material = default_material();
  object.points = scan_case.scan.points;
  std::vector<double> numbers(scan_case.scan.size());
  std::iota(numbers.begin(), numbers.end(), 0.0);
  object.points.columns.push_back({"number", numbers});
  input.objects.push_back(std::move(object));
  input.up = scan_case.up;
  BuildStats stats;
  const double before = cpu_seconds();
  const Scene scene = build_scene(std::move(input), {}, 0, stats);
  const double million_a_second =
      1e-6 * static_cast<double>(scan_case.scan.size()) / (cpu_seconds() - before);
  const Scores scores = score(scan_case.scan, scene);
  std::printf("%-36s %8zu  %5.2f %6.1f  %6.2f %6.2f  %-6s %7.3f %7llu  %6.2f %6.2f  %6.3f %8.2f %6.2f",
              scan_case.name.c_str(), scan_case.scan.size(), scores.lost_percent, scores.found_percent,
              scores.axis_median_deg, scores.axis_p95_deg, rung_of(stats).c_str(), scores.sides_percent,
              static_cast<unsigned long long>(stats.sides_unsure), scores.surface_percent,
              scores.leaves_percent, stats.noise, stats.total_ms / 1e3, million_a_second);
  if (scan_case.mesh != nullptr) {
    const PictureErrors errors = picture_errors(scene, *scan_case.mesh, PIXELS);
    std::printf("  %6.2f %6.2f %9.2e %7.3f %7.3f", errors.normal_p95_deg, errors.normal_p99_deg,
                errors.depth_p95, errors.beyond_percent, errors.holes_percent);
  }
  if (scan_case.spinner) {
    const RingErrors errors = ring_errors(scene, *scan_case.rings_of, *scan_case.spinner, RING_RAYS);
    std::printf("  stripes %.2f %% (from above %.2f), edges %.1f %%, overlap %.2f, ellipses %.1f %%",
                errors.stripes_percent, errors.stripes_above_percent, errors.edges_percent, errors.overlap,
                100.0 * static_cast<double>(stats.ellipses) / static_cast<double>(stats.splats));
  }
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace
}  // namespace splatray::testing

int main(int argc, char** argv) {
  using namespace splatray::testing;
  std::printf("%-36s %8s  %5s %6s  %6s %6s  %-6s %7s %7s  %6s %6s  %6s %8s %6s  %6s %6s %9s %7s %7s\n",
              "scan", "points", "lost%", "found%", "axis50", "axis95", "sides", "right%", "unsure", "surf%",
              "leaf%", "noise", "build s", "M/cpus", "n95", "n99", "depth95", "beyond%", "holes%");
  const std::string wanted = argc > 2 ? argv[2] : "";
  const auto measure_all = [&](std::vector<ScanCase> cases) {
    for (ScanCase& scan_case : cases)
      if (scan_case.name.find(wanted) != std::string::npos) measure(std::move(scan_case));
  };
  measure_all(built_in_cases());
  const char* folder = argc > 1 ? argv[1] : std::getenv("SPLATRAY_DATA_DIR");
  if (folder != nullptr) measure_all(data_cases(folder));
  return 0;
}
