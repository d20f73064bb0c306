#include "tests/scan_sim/scanner.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <random>

#include "preprocess/base/parallel.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

constexpr int AROUND = 6;            // rays of a beam about its middle
constexpr double JUMP_NOISES = 5.0;  // of a beam's range from its middle's plane: it meets two surfaces
constexpr double LEAST_JUMP = 0.01;  // of the range, the same

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

/// A beam's answer.
struct Return {
  double range = 0.0;       ///< with noise
  double true_range = 0.0;  ///< of the beam's middle
  dvec3 normal{0.0};
  PointKind kind = PointKind::surface;
  double last_range = 0.0;  ///< of the farthest surface in the beam where there are two, else 0
  std::uint32_t triangle = 0, last_triangle = 0;  ///< that the middle and the farthest ray met
};

/// Two directions across a unit vector.
std::pair<dvec3, dvec3> across(const dvec3& dir) {
  const dvec3 side = std::abs(dir.x) < 0.6 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
  const dvec3 u = glm::normalize(glm::cross(dir, side));
  return {u, glm::cross(dir, u)};
}

/// Sends one beam: the range is the mean over what its rays meet, near its middle's surface or between two.
std::optional<Return> send(const TriangleTree& mesh, const dvec3& sensor, const dvec3& dir, const Beam& beam,
                           std::mt19937_64& random) {
  const auto middle = mesh.first_hit(sensor, dir);
  if (!middle) return {};
  const double cosine = -glm::dot(middle->normal, dir);
  const auto [u, v] = across(dir);
  double sum = middle->distance, farthest = 0.0;
  std::uint32_t farthest_triangle = 0;
  int count = 1;
  bool jumps = false;
  for (int i = 0; i < AROUND; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / AROUND;
    const dvec3 ray = glm::normalize(dir + beam.divergence * (std::cos(angle) * u + std::sin(angle) * v));
    const auto hit = mesh.first_hit(sensor, ray);
    if (!hit) continue;
    const double on_plane = middle->distance * cosine / std::max(-glm::dot(middle->normal, ray), 1e-6);
    const double apart = std::abs(hit->distance - on_plane);
    if (apart > std::max(JUMP_NOISES * beam.noise, LEAST_JUMP * middle->distance)) jumps = true;
    if (hit->distance > farthest) farthest = hit->distance, farthest_triangle = hit->triangle;
    sum += hit->distance;
    ++count;
  }
  Return answer;
  answer.true_range = middle->distance;
  answer.normal = mesh.smooth_normal(*middle);
  const double mean = sum / count;
  const bool mixed = jumps && std::abs(mean - middle->distance) > JUMP_NOISES * beam.noise;
  answer.kind = mixed ? PointKind::mixed : PointKind::surface;
  std::normal_distribution<double> noise(0.0, beam.noise);
  answer.range = (mixed ? mean : middle->distance) + noise(random);
  answer.last_range = mixed ? farthest : 0.0;
  answer.triangle = middle->triangle;
  answer.last_triangle = farthest_triangle;
  std::uniform_real_distribution<double> share(0.0, 1.0);
  if (share(random) < beam.stray_share) {
    answer.kind = PointKind::stray;
    answer.range = middle->distance * (0.05 + 0.9 * share(random));
  }
  return answer;
}

/// A station's answers by cell, row after row.
using Answers = std::vector<std::optional<Return>>;
using Direction = std::function<dvec3(std::uint32_t row, std::uint32_t column)>;

Answers send_all(const TriangleTree& mesh, const dvec3& sensor, const Station& station,
                 const Direction& direction, const Beam& beam, std::uint64_t salt) {
  Answers answers(std::size_t{station.rows} * station.columns);
  tbb::parallel_for(0U, station.rows, [&](std::uint32_t row) {
    std::mt19937_64 random(beam.seed * 1000003 + salt * 100003 + row);
    for (std::uint32_t column = 0; column < station.columns; ++column)
      answers[std::size_t{row} * station.columns + column] =
          send(mesh, sensor, direction(row, column), beam, random);
  });
  return answers;
}

void add_point(SimulatedScan& scan, const dvec3& sensor, const dvec3& dir, const Return& answer) {
  scan.points.position.push_back(sensor + dir * answer.range);
  scan.position.push_back(sensor + dir * answer.true_range);
  scan.normal.push_back(answer.normal);
  scan.kind.push_back(answer.kind);
  scan.triangle.push_back(answer.triangle);
}

void add_station(SimulatedScan& scan, const TriangleTree& mesh, Station station, const Direction& direction,
                 const Beam& beam) {
  const auto number = static_cast<std::uint16_t>(scan.points.stations.size());
  const dvec3 sensor = *station.sensor_world;
  const Answers answers = send_all(mesh, sensor, station, direction, beam, number);
  for (std::uint32_t cell = 0; cell < answers.size(); ++cell) {
    if (!answers[cell]) continue;
    add_point(scan, sensor, direction(cell / station.columns, cell % station.columns), *answers[cell]);
    scan.points.station.push_back(number);
    scan.points.grid_cell.push_back(cell);
  }
  scan.points.stations.push_back(std::move(station));
}

dvec3 polar(const glm::dmat3& axes, double azimuth, double elevation) {
  return axes * dvec3(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                      std::sin(elevation));
}

}  // namespace

SimulatedScan scan_from_tripods(const TriangleTree& mesh, const Tripod& tripod, const Beam& beam) {
  SimulatedScan scan;
  for (const dvec3& sensor : tripod.sensors) {
    Station station;
    station.sensor_world = sensor;
    station.rows = static_cast<std::uint32_t>((tripod.highest_deg - tripod.lowest_deg) / tripod.step_deg);
    station.columns = static_cast<std::uint32_t>(360.0 / tripod.step_deg);
    const Direction direction = [&](std::uint32_t row, std::uint32_t column) {
      return polar(tripod.axes, radians(tripod.step_deg * column),
                   radians(tripod.lowest_deg + tripod.step_deg * (row + 0.5)));
    };
    add_station(scan, mesh, std::move(station), direction, beam);
  }
  return scan;
}

SimulatedScan scan_by_spinner(const TriangleTree& mesh, const Spinner& spinner, const Beam& beam) {
  SimulatedScan scan;
  Station station;
  station.sensor_world = spinner.sensor;
  station.rows = static_cast<std::uint32_t>(spinner.rings);
  station.columns = static_cast<std::uint32_t>(spinner.columns);
  const double step = (spinner.highest_deg - spinner.lowest_deg) / (spinner.rings - 1);
  const Direction direction = [&](std::uint32_t row, std::uint32_t column) {
    return polar(spinner.axes, 2.0 * std::numbers::pi * column / spinner.columns,
                 radians(spinner.lowest_deg + step * row));
  };
  add_station(scan, mesh, std::move(station), direction, beam);
  return scan;
}

SimulatedScan scan_from_air(const TriangleTree& mesh, const Flight& flight, const Beam& beam) {
  SimulatedScan scan;
  std::vector<std::uint8_t> number, of;
  std::vector<double> time;
  const auto add = [&](const dvec3& sensor, const dvec3& dir, const Return& answer, int which, int returns,
                       double at) {
    add_point(scan, sensor, dir, answer);
    number.push_back(static_cast<std::uint8_t>(which));
    of.push_back(static_cast<std::uint8_t>(returns));
    time.push_back(at);
  };
  std::mt19937_64 random(beam.seed);
  const int lines = static_cast<int>((flight.to_x - flight.from_x) / flight.spacing);
  const int across_track = static_cast<int>(2.0 * flight.swath / flight.spacing);
  for (int line = 0; line < lines; ++line) {
    for (int i = 0; i < across_track; ++i) {
      const double share = double(i) / across_track;
      const double x = flight.from_x + flight.spacing * (line + share);
      const dvec3 sensor(x, flight.y, flight.height);
      const dvec3 ground(x, flight.y + flight.swath * (2.0 * share - 1.0), 0.0);
      const dvec3 dir = glm::normalize(ground - sensor);
      const auto answer = send(mesh, sensor, dir, beam, random);
      if (!answer) continue;
      const double at = 1000.0 + (x - flight.from_x) / flight.speed;
      if (answer->last_range == 0.0 || answer->kind == PointKind::stray) {
        add(sensor, dir, *answer, 1, 1, at);
        continue;
      }
      Return near = *answer, far = *answer;  // pulses separate the two surfaces of an edge
      near.kind = far.kind = PointKind::surface;
      near.range = near.true_range;
      far.range = far.true_range = far.last_range;
      far.triangle = far.last_triangle;
      add(sensor, dir, near, 1, 2, at);
      add(sensor, dir, far, 2, 2, at);
    }
  }
  scan.points.columns = {{std::string(COLUMN_RETURN), number},
                         {std::string(COLUMN_RETURNS), of},
                         {std::string(COLUMN_TIME), time}};
  return scan;
}

SimulatedScan wood_scan(const TriangleTree& mesh) {
  return scan_from_air(mesh, {.from_x = -30.0, .to_x = 30.0, .swath = 30.0}, {.noise = 0.02});
}

void mark_leaves(SimulatedScan& scan, std::uint32_t first) {
  for (std::size_t i = 0; i < scan.size(); ++i)
    if (scan.kind[i] == PointKind::surface && scan.triangle[i] >= first) scan.kind[i] = PointKind::leaf;
}

SimulatedScan range_images(const TriangleTree& mesh, const RangeImages& images, const Beam& beam) {
  SimulatedScan scan;
  std::mt19937_64 random(beam.seed);
  std::normal_distribution<double> shift(0.0, images.misplaced);
  for (int view = 0; view < images.views; ++view) {
    const double angle = 2.0 * std::numbers::pi * view / images.views;
    const double lift = view % 3 == 0 ? 0.5 : view % 3 == 1 ? 0.0 : -0.4;
    const dvec3 outwards = glm::normalize(dvec3(std::sin(angle), lift, std::cos(angle)));
    const dvec3 sensor = images.middle + images.distance * outwards;
    const dvec3 forward = -outwards;
    const dvec3 right = glm::normalize(glm::cross(forward, dvec3(0, 1, 0)));
    const dvec3 up = glm::cross(right, forward);
    const double edge = std::tan(radians(0.5 * images.fov_deg));
    const Direction direction = [&](std::uint32_t row, std::uint32_t column) {
      const double x = 2.0 * (column + 0.5) / images.pixels - 1.0,
                   y = 2.0 * (row + 0.5) / images.pixels - 1.0;
      return glm::normalize(forward + edge * (x * right + y * up));
    };
    Station station;
    station.sensor_world = sensor;
    station.rows = station.columns = static_cast<std::uint32_t>(images.pixels);
    const std::size_t first = scan.size();
    add_station(scan, mesh, std::move(station), direction, beam);
    const dvec3 moved(shift(random), shift(random), shift(random));
    for (std::size_t i = first; i < scan.size(); ++i) scan.points.position[i] += moved;
  }
  return scan;
}

SimulatedScan scan_by_depth_camera(const TriangleTree& mesh, const DepthCamera& camera, const Beam& beam) {
  SimulatedScan scan;
  Station station;
  station.sensor_world = camera.sensor;
  station.rows = camera.rows, station.columns = camera.columns;
  const Direction direction = [&](std::uint32_t row, std::uint32_t column) {
    const double x = column - 0.5 * (camera.columns - 1.0), y = row - 0.5 * (camera.rows - 1.0);
    return glm::normalize(camera.axes * dvec3(x, y, camera.focal));
  };
  add_station(scan, mesh, std::move(station), direction, beam);
  std::mt19937_64 random(beam.seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  for (dvec3& position : scan.points.position) {
    const dvec3 away = position - camera.sensor;
    const double depth = glm::dot(away, camera.axes[2]);
    double inverse = 1.0 / depth + camera.inverse_noise * noise(random);
    if (camera.step > 0.0) inverse = camera.step * std::max(std::round(inverse / camera.step), 1.0);
    position = camera.sensor + away / (depth * inverse);
  }
  return scan;
}

}  // namespace splatray::testing
