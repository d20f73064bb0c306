#include "tests/scan_sim/scan_cases.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "engine/base/error.h"
#include "engine/base/srgb.h"
#include "preprocess/read/formats.h"
#include "tests/scan_sim/sim_meshes.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

std::shared_ptr<const TriangleTree> tree_of(const Mesh& mesh) { return std::make_shared<TriangleTree>(mesh); }

std::shared_ptr<const TriangleTree> read_tree(const std::filesystem::path& path) {
  ReadOptions options;
  options.keep_meshes = true;
  return tree_of(read_input({path}, options).objects.at(0).meshes.at(0));
}

/// The dragon's merged range scans: normals of the range grids are the truth of sides; scanners' places from a table.
ScanCase posed_dragon(const std::filesystem::path& folder) {
  ReadOptions options;
  options.scans.attributes = {"scan_id"};
  Input input = read_input({folder / "scans/dragon_stand_merged.ply"}, options);
  ScanCase dragon;
  dragon.name = "dragon, 15 scans";
  dragon.up = {0.0, 1.0, 0.0};
  dragon.mesh = read_tree(folder / "models/dragon.ply");
  Points& points = input.objects.at(0).points;
  const Column* scan_id = find_column(points.columns, "scan_id");
  std::ifstream table(folder / "scans/dragon_stand_posed.csv");
  std::string line;
  std::getline(table, line);
  while (scan_id != nullptr && std::getline(table, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream row(line);
    std::string skip;
    dvec3 place;
    row >> skip >> skip >> skip >> skip >> place.x >> place.y >> place.z;
    points.stations.push_back({"", place});
  }
  for (std::size_t i = 0; scan_id != nullptr && i < points.size(); ++i)
    points.station.push_back(static_cast<std::uint16_t>(scan_id->number(i)));
  points.columns.clear();
  dragon.scan.normal.assign(points.normal.begin(), points.normal.end());
  dragon.scan.kind.assign(points.size(), PointKind::surface);
  dragon.scan.points = std::move(points);
  return dragon;
}

/// A room whose colours are its scanner software's normals; the station is put into its middle.
ScanCase vaulted_room(const std::filesystem::path& folder) {
  Points points = read_input({folder / "scans/vaulted_room.laz"}, {}).objects.at(0).points;
  ScanCase room;
  room.name = "vaulted room";
  dvec3 sum(0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto decoded = [](float linear) { return 2.0 * linear_to_srgb(linear) - 1.0; };
    const dvec3 normal(decoded(points.color[i].x), decoded(points.color[i].y), decoded(points.color[i].z));
    room.scan.normal.push_back(glm::length(normal) > 0.9 ? glm::normalize(normal) : dvec3(0.0));
    sum += points.position[i];
  }
  points.color.clear();
  points.columns.clear();
  points.station.clear();
  points.grid_cell.clear();
  points.stations = {{"", sum / static_cast<double>(points.size())}};
  room.scan.kind.assign(points.size(), PointKind::surface);
  room.scan.points = std::move(points);
  return room;
}

}  // namespace

ScanCase street_sweep(int rings) {
  static const std::shared_ptr<const TriangleTree> street = tree_of(street_mesh());
  Spinner spinner{.sensor = {0.0, 0.5, 1.8}, .rings = rings};
  if (rings <= 16) spinner.lowest_deg = -15.0;  // as those of so few have
  ScanCase sweep;
  sweep.name = "street, " + std::to_string(rings) + " rings";
  sweep.scan = scan_by_spinner(*street, spinner, {.noise = 0.015});
  sweep.spinner = spinner;
  sweep.rings_of = street;
  return sweep;
}

SimulatedScan corner_by_depth_camera(DepthCamera camera) {
  camera.sensor = {3.2, 3.0, 1.4};
  const dvec3 ahead = glm::normalize(dvec3(0.9, 1.0, 0.6) - camera.sensor);
  const dvec3 right = glm::normalize(glm::cross(ahead, dvec3(0.0, 0.0, 1.0)));
  camera.axes = {right, glm::cross(ahead, right), ahead};
  return scan_by_depth_camera(TriangleTree(corner_mesh()), camera, {.noise = 0.0005, .divergence = 1e-3});
}

ScanCase without_stations(ScanCase scan_case) {
  scan_case.name += ", no places";
  Points& points = scan_case.scan.points;
  points.stations.clear();
  points.station.clear();
  points.grid_cell.clear();
  return scan_case;
}

ScanCase without_normals(ScanCase scan_case) {
  scan_case.name += ", no normals";
  scan_case.scan.points.normal.clear();
  return scan_case;
}

std::vector<ScanCase> built_in_cases() {
  std::vector<ScanCase> cases;
  const TriangleTree room(room_mesh());
  cases.push_back({"room, tripods",
                   scan_from_tripods(room, {.sensors = {{-0.3, 0.2, 1.6}, {4.9, 3.4, 1.7}}}, {}), nullptr});
  cases.push_back(without_stations(cases.back()));
  cases.push_back({"corner, depth camera", corner_by_depth_camera(), nullptr});
  cases.push_back(
      {"hills, from the air", scan_from_air(TriangleTree(terrain_mesh()), {}, {.noise = 0.03}), nullptr});
  for (const int rings : {16, 32, 64, 128}) {
    cases.push_back(street_sweep(rings));
    cases.push_back(without_stations(cases.back()));
  }
  Wood wood = wood_mesh();
  ScanCase hill{"wood on a hill, from the air", wood_scan(TriangleTree(std::move(wood.mesh))), nullptr};
  mark_leaves(hill.scan, wood.first_leaf);
  cases.push_back(std::move(hill));
  const auto body = tree_of(body_mesh());
  const Beam range_beam{.noise = 0.0015, .divergence = 1e-4};
  cases.push_back(
      {"body, range images", range_images(*body, {.misplaced = 0.002}, range_beam), body, {0.0, 1.0, 0.0}});
  cases.push_back(without_stations(cases.back()));
  return cases;
}

std::vector<ScanCase> data_cases(const std::filesystem::path& folder) {
  std::vector<ScanCase> cases;
  if (std::filesystem::exists(folder / "models/sibenik.ply")) {
    const Tripod tripod{.sensors = {{8.0, 1.7, 0.0}, {19.0, 1.7, 1.0}, {2.0, 2.84, 0.0}},
                        .axes = {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}};
    const auto church = read_tree(folder / "models/sibenik.ply");
    cases.push_back({"church, tripods", scan_from_tripods(*church, tripod, {}), nullptr, {0.0, 1.0, 0.0}});
    cases.push_back(without_stations(cases.back()));
  }
  if (std::filesystem::exists(folder / "models/ice_cave.ply")) {
    const Spinner spinner{.sensor = {0.0, -0.5, 8.0}, .axes = {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}};
    const auto cave = read_tree(folder / "models/ice_cave.ply");
    cases.push_back({"cave, spinner",
                     scan_by_spinner(*cave, spinner, {.noise = 0.01}),
                     nullptr,
                     {0.0, -1.0, 0.0},
                     spinner,
                     cave});
    cases.push_back(without_stations(cases.back()));
  }
  if (std::filesystem::exists(folder / "models/bunny.ply")) {
    const auto bunny = read_tree(folder / "models/bunny.ply");
    const RangeImages images{.distance = 0.5,
                             .pixels = 150,
                             .fov_deg = 20.0,
                             .misplaced = 0.0002,
                             .middle = {-0.017, 0.110, -0.0015}};
    const Beam beam{.noise = 0.00015, .divergence = 1e-4};
    cases.push_back({"bunny, range images", range_images(*bunny, images, beam), bunny, {0.0, 1.0, 0.0}});
    cases.push_back(without_stations(cases.back()));
  }
  if (std::filesystem::exists(folder / "scans/dragon_stand_merged.ply")) {
    const ScanCase dragon = posed_dragon(folder);
    cases.push_back(dragon);
    cases.push_back(without_normals(dragon));
    cases.push_back(without_stations(without_normals(dragon)));
  }
  const std::filesystem::path room = folder / "scans/vaulted_room.laz";
  if (std::filesystem::exists(room) && find_format(room) != nullptr) {
    cases.push_back(vaulted_room(folder));
    cases.push_back(without_stations(cases.back()));
  }
  return cases;
}

}  // namespace splatray::testing
