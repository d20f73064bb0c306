#include "tests/bench/regression/inputs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "app/library/camera_file.h"
#include "engine/base/srgb.h"
#include "preprocess/mesh/mesh_normals.h"
#include "tests/bench/regression/input_files.h"
#include "tests/bench/regression/source_mesh.h"
#include "tests/scan_sim/sim_meshes.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

constexpr double FOV_DEG = 30.0;

/// A view of a box from `dir` (unit) that holds its sphere.
Camera camera_of(const dvec3& low, const dvec3& high, const dvec3& dir) {
  Camera camera;
  camera.target = 0.5 * (low + high);
  camera.fov_y_deg = FOV_DEG;
  const double distance = 0.5 * glm::length(high - low) / std::sin(FOV_DEG * std::numbers::pi / 360.0);
  camera.eye = camera.target + distance * dir;
  return camera;
}

void write_views(const Mesh& mesh, const std::filesystem::path& folder) {
  const auto [low, high] = box_of(mesh);
  write_camera(camera_of(low, high, {0.0, 0.0, 1.0}), folder / "front.json");
  write_camera(camera_of(low, high, {0.0, 0.0, -1.0}), folder / "back.json");
  write_camera(camera_of(low, high, glm::normalize(dvec3(1.0, 0.6, 0.8))), folder / "oblique.json");
}

/// The vertices of triangles, one of each place, with their normals.
Points used_vertices(const Mesh& mesh) {
  const std::vector<glm::uint> weld = weld_positions(mesh.vertices.position);
  Mesh bare{mesh};
  bare.vertices.normal.clear();
  const std::vector<glm::vec3> normals = vertex_normals(bare, weld);
  std::vector<bool> used(weld.size());
  for (const glm::uvec3& triangle : mesh.triangles)
    for (int corner = 0; corner < 3; ++corner) used[weld[triangle[corner]]] = true;
  Points points;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) continue;
    points.position.push_back(mesh.vertices.position[i]);
    points.normal.push_back(normals[i]);
  }
  return points;
}

void write_both(Points points, const std::filesystem::path& folder) {
  write_ply_points(points, folder / "normals.ply");
  points.normal.clear();
  write_ply_points(points, folder / "bare.ply");
}

/// Normals of the planes through each cell's neighbours in its grid, towards the scanner, as scanners' software computes them; of
/// cells without neighbours towards the scanner itself.
void add_grid_normals(Points& points) {
  std::vector<std::vector<std::ptrdiff_t>> grids;
  for (const Station& station : points.stations)
    grids.emplace_back(std::size_t{station.rows} * station.columns, -1);
  for (std::size_t i = 0; i < points.size(); ++i)
    grids[points.station[i]][points.grid_cell[i]] = static_cast<std::ptrdiff_t>(i);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Station& station = points.stations[points.station[i]];
    const auto& grid = grids[points.station[i]];
    const std::uint32_t row = points.grid_cell[i] / station.columns,
                        column = points.grid_cell[i] % station.columns;
    const auto at = [&](std::uint32_t r, std::uint32_t c) {
      const std::ptrdiff_t found =
          r < station.rows && c < station.columns ? grid[std::size_t{r} * station.columns + c] : -1;
      return points.position[found < 0 ? i : static_cast<std::size_t>(found)];
    };
    const dvec3 to_sensor = *station.sensor_world - points.position[i];
    dvec3 normal =
        glm::cross(at(row, column + 1) - at(row, column - 1), at(row + 1, column) - at(row - 1, column));
    if (!(glm::length(normal) > 0.0)) normal = to_sensor;
    if (glm::dot(normal, to_sensor) < 0.0) normal = -normal;
    points.normal.emplace_back(glm::normalize(normal));
  }
}

/// Range images that see a box from all around.
SimulatedScan images_of(const Mesh& mesh) {
  constexpr double PIXELS = 220.0;
  const auto [low, high] = box_of(mesh);
  const double diagonal = glm::length(high - low);
  RangeImages images;
  images.distance = 2.0 * diagonal;
  images.pixels = static_cast<int>(PIXELS);
  images.fov_deg = 2.0 * std::atan(0.26) * 180.0 / std::numbers::pi;  // half a diagonal, and a little
  images.middle = 0.5 * (low + high);
  const double spacing = 2.0 * 0.26 * images.distance / PIXELS;
  images.misplaced = 0.3 * spacing;
  return range_images(TriangleTree(mesh), images,
                      {.noise = 0.15 * spacing, .divergence = 0.5 * spacing / images.distance});
}

void write_wall(double thickness, const std::filesystem::path& folder) {
  const Mesh mesh = wall_mesh(thickness);
  const TriangleTree tree(mesh);
  const std::string name = "wall_" + std::to_string(std::lround(1000.0 * thickness));
  write_obj_mesh(mesh, folder / (name + ".obj"));
  const std::vector<dvec3> places{{0.4, -4.0, 1.3}, {-0.3, 4.0, 1.2}};
  for (const std::size_t stations : {1U, 2U}) {
    Tripod tripod{.sensors = {places.begin(), places.begin() + static_cast<std::ptrdiff_t>(stations)}};
    tripod.step_deg = 0.14;
    tripod.lowest_deg = -25.0;
    tripod.highest_deg = 15.0;
    const SimulatedScan scan = in_grid_order(scan_from_tripods(tree, tripod, {.noise = 0.0025}));
    const std::string file = name + "_" + std::to_string(stations);
    write_ptx(scan.points, folder / (file + ".ptx"));
    write_point_truth(scan, folder / file);
  }
}

}  // namespace

void write_model_inputs(const std::filesystem::path& mesh, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const Mesh source = source_mesh(mesh);
  write_both(used_vertices(source), folder);
  write_views(source, folder);
}

void write_raw_scan(const std::filesystem::path& mesh, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const Mesh source = mesh.empty() ? body_mesh() : source_mesh(mesh);
  SimulatedScan scan = images_of(source);
  add_grid_normals(scan.points);
  write_both(std::move(scan.points), folder);
  write_views(source, folder);
  write_obj_mesh(source, folder / "mesh.obj");
}

void write_room(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const Mesh mesh = room_mesh();
  const Tripod tripod{.sensors = {{-0.3, 0.2, 1.6}, {3.6, 1.0, 1.5}}, .step_deg = 0.4};
  const SimulatedScan scan = in_grid_order(scan_from_tripods(TriangleTree(mesh), tripod, {}));
  write_obj_mesh(mesh, folder / "room.obj");
  write_ptx(scan.points, folder / "room.ptx");
  write_ply_points(scan.points, folder / "room_bare.ply");
  write_point_truth(scan, folder / "room");
}

void write_walls(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (const double thickness : {0.01, 0.02, 0.05, 0.1, 0.2}) write_wall(thickness, folder);
}

void write_thinned(const std::filesystem::path& scan, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  ReadOptions options;
  const Points all = std::move(read_input({scan}, options).objects.front().points);
  for (const std::uint32_t part : {1U, 2U, 5U, 10U}) {
    std::mt19937 random(part);
    Points points;
    points.columns = {{std::string(COLUMN_CLASS), std::vector<double>{}},
                      {std::string(COLUMN_INTENSITY), std::vector<double>{}}};
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (random() % part != 0) continue;
      points.position.push_back(all.position[i]);
      if (!all.color.empty()) points.color.push_back(all.color[i]);
      for (Column& column : points.columns)
        if (const Column* from = find_column(all.columns, column.name))
          std::get<Pool<double>>(column.values).edit().push_back(from->number(i));
    }
    std::erase_if(points.columns, [](const Column& column) { return column.size() == 0; });
    write_las_points(points, folder / (std::to_string(part) + ".las"));
  }
}

void write_truth_of_colors(const std::filesystem::path& scan, const std::filesystem::path& folder) {
  constexpr double LEAST = 0.9;  // of a normal's length, which 8 bits leave
  const auto decoded = [](float linear) { return 2.0 * linear_to_srgb(linear) - 1.0; };
  SimulatedScan truth;
  const Input input = read_input({scan}, {});
  for (const glm::vec3& color : input.objects.front().points.color) {
    const dvec3 normal(decoded(color.r), decoded(color.g), decoded(color.b));
    const bool known = glm::length(normal) > LEAST;
    truth.normal.push_back(known ? glm::normalize(normal) : dvec3(0.0, 0.0, 1.0));
    truth.kind.push_back(known ? PointKind::surface : PointKind::leaf);
  }
  write_point_truth(truth, folder);
}

void write_bare(const std::filesystem::path& scan, const std::filesystem::path& path) {
  Points points = std::move(read_input({scan}, {}).objects.front().points);
  points.normal.clear();
  write_ply_points(points, path);
}

}  // namespace splatray::testing
