#include "preprocess/scan/sides.h"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "preprocess/scan/flight_track.h"
#include "preprocess/scan/occupancy.h"
#include "preprocess/surface/normals.h"

namespace splatray {
namespace {

const double GRAZING =
    std::sin(5.0 * std::numbers::pi / 180.0);  // sine of the angle between plane and line of sight

const double LEVEL = std::cos(45.0 * std::numbers::pi / 180.0);  // of a sheet's axis that is more up than not

/// Turns normals to where they are seen from. Those that are seen at a grazing angle do as most of their neighbours that
/// are not. `sensor_of` gives a place in the cloud's coordinates, or nothing.
template <typename SensorOf>
void turn_towards(Cloud& cloud, const Survey& survey, const std::vector<std::uint32_t>& points,
                  const SensorOf& sensor_of) {
  std::vector<std::uint8_t> sure(cloud.size());
  tbb::parallel_for(std::size_t{0}, cloud.size(),
                    [&](std::size_t i) { sure[i] = cloud.on_surface(i) ? 1 : 0; });
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t n) {
    const std::uint32_t i = points[n];
    const std::optional<glm::dvec3> sensor = sensor_of(i);
    if (!sensor) return;
    const glm::dvec3 to_sensor = *sensor - glm::dvec3(cloud.coord[i]);
    const double along = glm::dot(glm::dvec3(cloud.normal[i]), to_sensor);
    sure[i] = std::abs(along) > GRAZING * glm::length(to_sensor);
    if (along < 0.0) cloud.normal[i] = -cloud.normal[i];
  });
  const std::vector<glm::vec3> before = cloud.normal;
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t n) {
    const std::uint32_t i = points[n];
    if (sure[i] != 0) return;
    float votes = 0.0F;
    for (const std::uint32_t j : survey.around(i))
      if (j != i && sure[j] != 0) votes += glm::dot(before[i], before[j]);
    if (votes < 0.0F) cloud.normal[i] = -before[i];
  });
}

bool any_sensor(const Cloud& cloud) {
  return std::any_of(cloud.stations.begin(), cloud.stations.end(),
                     [](const Station& station) { return station.sensor_world.has_value(); });
}

/// Whether most of the cloud has more of it above or below along `axis`, as a cave or a room has and terrain has not.
bool has_layers(const Cloud& cloud, const Survey& survey, const glm::dvec3& axis) {
  constexpr std::size_t ASKED = 4096;
  constexpr double START = 3.0;  // of a ray, in cells off its point
  const Occupancy space(cloud, cell_edge(survey));
  const std::size_t asked = std::min(ASKED, cloud.size());
  std::size_t layered = 0;
  for (std::size_t n = 0; n < asked; ++n) {
    const glm::dvec3 point(cloud.coord[n * cloud.size() / asked]);
    const auto meets = [&](const glm::dvec3& dir) {
      return space.free_path(point + START * space.edge() * dir, dir).has_value();
    };
    layered += meets(axis) || meets(-axis) ? 1 : 0;
  }
  return 2 * layered > asked;
}

void turn_up(Cloud& cloud, const std::vector<std::uint32_t>& points, const glm::dvec3& axis) {
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t n) {
    glm::vec3& normal = cloud.normal[points[n]];
    if (glm::dot(glm::dvec3(normal), axis) < 0.0) normal = -normal;
  });
}

}  // namespace

std::string_view name_of(SideRung rung) {
  constexpr std::array<std::string_view, SIDE_RUNGS> NAMES{"given", "sensor", "track", "up", "votes"};
  return NAMES[static_cast<std::size_t>(rung)];
}

std::optional<glm::dvec3> open_sheet_axis(const Cloud& cloud, const Survey& survey, const glm::dvec3& up) {
  const std::optional<glm::dvec3> axis = sheet_axis(cloud, up);
  return axis && !has_layers(cloud, survey, *axis) ? axis : std::nullopt;
}

SidesFound turn_to_sides(Cloud& cloud, const Survey& survey, const std::vector<std::uint32_t>& estimated,
                         const glm::dvec3& up, const Stage& stage) {
  if (estimated.empty()) return {SideRung::given};
  if (cloud.track.empty() && any_sensor(cloud)) {
    turn_towards(cloud, survey, estimated, [&](std::uint32_t i) { return cloud.sensor_of(i); });
    return {SideRung::sensor};
  }
  if (const FlightTrack track(cloud, up); !track.empty()) {
    const Column& time = *find_column(cloud.columns, COLUMN_TIME);
    turn_towards(cloud, survey, estimated,
                 [&](std::uint32_t i) { return std::optional(cloud.in_cloud(track.at(time.number(i)))); });
    return {.rung = SideRung::track, .terrain = true};
  }
  if (const auto axis = open_sheet_axis(cloud, survey, up)) {
    turn_up(cloud, estimated, *axis);
    return {.rung = SideRung::up, .terrain = glm::dot(*axis, up) > LEVEL};
  }
  return {.rung = SideRung::votes, .unsure = turn_by_votes(cloud, survey, up, stage)};
}

}  // namespace splatray
