#include "arrays.h"

#include <splatray.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

namespace {

namespace sr = splatray::api;

using Triangle = std::array<std::uint32_t, 3>;

std::vector<std::string> defects;

void expect(bool holds, const std::string& sentence) {
  if (!holds) defects.push_back(sentence);
}

/// Expects an Error of this kind whose sentence has `part` in it.
template <typename Call>
void expect_refused(sr::ErrorKind kind, const std::string& part, const Call& call) {
  try {
    call();
    defects.push_back("expected a refusal with '" + part + "', found none");
  } catch (const sr::Error& error) {
    expect(error.kind() == kind && std::string(error.what()).find(part) != std::string::npos,
           "expected '" + part + "' in a refusal, found '" + error.what() + "'");
  }
}

/// In float32 throughout, as files are read: colours between vertices come out the same.
float linear(int byte) {
  const float share = float(byte) / 255.0F;
  return share <= 0.04045F ? share / 12.92F : std::pow((share + 0.055F) / 1.055F, 2.4F);
}

/// A hilly square of 2 x 2 about (5e5, 4e6), `side` vertices a side: what a mesh's file has and arrays have.
struct Hill {
  std::vector<sr::Double3> vertices;
  std::vector<sr::Float3> normals, colors;
  std::vector<std::array<int, 3>> bytes;
  std::vector<double> heights, classes;
  std::vector<Triangle> triangles;

  explicit Hill(std::uint32_t side) {
    for (std::uint32_t i = 0; i < side; ++i)
      for (std::uint32_t j = 0; j < side; ++j) {
        const double x = 2.0 * i / (side - 1) - 1.0, y = 2.0 * j / (side - 1) - 1.0;
        vertices.push_back({5e5 + x, 4e6 + y, 0.25 * std::sin(3.0 * x) * y});
        normals.push_back({float(-0.75 * std::cos(3.0 * x) * y), float(-0.25 * std::sin(3.0 * x)), 1.0F});
        bytes.push_back({int(20 * i % 256), int(7 * j % 256), 128});
        colors.push_back({linear(bytes.back()[0]), linear(bytes.back()[1]), linear(128)});
        heights.push_back(x);
        classes.push_back(x < 0.0 ? 2.0 : 6.0);
      }
    for (std::uint32_t i = 0; i + 1 < side; ++i)
      for (std::uint32_t j = 0; j + 1 < side; ++j) {
        const std::uint32_t at = i * side + j;
        triangles.push_back({at, at + side, at + side + 1});
        triangles.push_back({at, at + side + 1, at + 1});
      }
  }

  [[nodiscard]] sr::Mesh mesh() const {
    return {
        .vertices = vertices, .triangles = triangles, .normals = normals, .colors = colors, .name = "hill"};
  }

  /// A PLY of the vertices, with triangles or, of a point set, with its attributes.
  void write(const std::filesystem::path& file, bool faces) const {
    std::ofstream out(file);
    out.precision(17);
    out << "ply\nformat ascii 1.0\nelement vertex " << vertices.size()
        << "\nproperty double x\nproperty double y\nproperty double z\nproperty float nx\nproperty float "
           "ny\nproperty "
           "float nz\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n";
    if (faces) out << "element face " << triangles.size() << "\nproperty list uchar uint vertex_indices\n";
    if (!faces) out << "property float intensity\nproperty uchar class\n";
    out << "end_header\n";
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      for (const double number : vertices[i]) out << number << ' ';
      for (const float number : normals[i]) out << number << ' ';
      for (const int byte : bytes[i]) out << byte << ' ';
      if (!faces) out << heights[i] << ' ' << classes[i];
      out << '\n';
    }
    if (faces)
      for (const auto& [a, b, c] : triangles) out << "3 " << a << ' ' << b << ' ' << c << '\n';
  }
};

std::string bytes_of(const sr::Scene& scene, const std::filesystem::path& file) {
  scene.save(file);
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A mesh of arrays is the scene of its file, byte for byte: with points at its vertices, and by area.
void check_meshes(const std::filesystem::path& folder) {
  for (const std::uint32_t side : {20U, 150U}) {
    const Hill hill(side);
    hill.write(folder / "hill.ply", true);
    sr::Request request = {{"up", "0,0,1"}};
    if (side == 20) request.set("mesh-points", 5000);
    const std::string file = bytes_of(sr::open(folder / "hill.ply", request), folder / "file.soct");
    const sr::Scene scene = sr::make_scene(hill.mesh(), request);
    expect(bytes_of(scene, folder / "arrays.soct") == file,
           "a mesh of arrays is another scene than its file");
    Hill moved = hill;
    moved.vertices[7][2] += 1e-3;
    expect(bytes_of(sr::make_scene(moved.mesh(), request), folder / "arrays.soct") != file,
           "a mesh with a vertex elsewhere passes for the right one");
  }
}

/// Meshes and points in one scene: rays name the object, and of points the point.
void check_mixed() {
  const Hill hill(20);
  const std::vector<sr::Double3> places = {{5e5, 4e6, 1.0}, {5e5 + 0.01, 4e6, 1.0}, {5e5, 4e6 + 0.01, 1.0}};
  const std::vector<sr::Float3> up(3, {0.0F, 0.0F, 1.0F});
  const std::vector<float> radii(3, 0.02F);
  const std::vector<sr::Object> objects = {hill.mesh(),
                                           sr::Points{.positions = places, .normals = up, .radii = radii}};
  const sr::Scene scene = sr::make_scene(objects, {{"mesh-points", 5000}});
  expect(scene.objects() == std::vector<std::string>{"hill", "points"}, "the names of a mesh and points");
  const std::vector<sr::Double3> origins = {{5e5, 4e6, 3.0}, {5e5 + 0.5, 4e6 + 0.5, 3.0}},
                                 down(2, {0.0, 0.0, -1.0});
  const sr::Hits hits = sr::trace(scene, origins, down);
  expect(hits.object == std::vector<std::int32_t>{1, 0} && hits.point[0] >= 0 && hits.point[1] == -1,
         "rays on a mesh and points name the wrong object or point");
  expect(std::abs(hits.t[0] - 2.0) < 1e-5 && std::abs(hits.t[1] - 3.0 + 0.25 * std::sin(1.5) * 0.5) < 2e-3,
         "rays on a mesh and points have the wrong length");
}

/// Attributes of points show and hide as those of a file do.
void check_attributes(const std::filesystem::path& folder) {
  const Hill hill(60);
  hill.write(folder / "points.ply", false);
  const std::vector<sr::Attribute> attributes = {{"intensity", hill.heights}, {"class", hill.classes}};
  const sr::Points points{.positions = hill.vertices,
                          .normals = hill.normals,
                          .colors = hill.colors,
                          .attributes = attributes,
                          .name = "points",
                          .scanned = true};
  const sr::Request small = {{"resolution", "48x48"}, {"samples", 1}};
  std::vector<sr::Image> shown;
  for (const auto& [name, value] :
       {std::pair{"color-by", "intensity"}, {"color-by", "class"}, {"hide-class", "6"}}) {
    const sr::Request request = {{"up", "0,0,1"}, {name, value}};
    shown.push_back(sr::render(sr::make_scene(points, request), small));
    expect(shown.back().pixels == sr::render(sr::open(folder / "points.ply", request), small).pixels,
           std::string(name) + " " + value + " shows arrays unlike their file");
  }
  expect(shown[0].pixels != shown[1].pixels && shown[1].pixels != shown[2].pixels,
         "attributes change no picture");
}

/// Attributes of vertices: whole numbers are the nearest corner's, so that a class hides its half.
void check_attributes_of_meshes() {
  const Hill hill(20);
  const std::vector<sr::Attribute> attributes = {{"class", hill.classes}};
  sr::Mesh mesh = hill.mesh();
  mesh.attributes = attributes;
  const std::vector<sr::Double3> origins = {{5e5 - 0.5, 4e6, 3.0}, {5e5 + 0.5, 4e6, 3.0}},
                                 down(2, {0.0, 0.0, -1.0});
  for (const char* hidden : {"6", "2"}) {
    const sr::Hits hits =
        sr::trace(sr::make_scene(mesh, {{"mesh-points", 5000}, {"hide-class", hidden}}), origins, down);
    expect(hits.object ==
               (hidden[0] == '6' ? std::vector<std::int32_t>{0, -1} : std::vector<std::int32_t>{-1, 0}),
           std::string("hide-class ") + hidden + " hides the wrong half of a mesh");
  }
}

/// Arrays that make no sense are refused in a sentence; what files may have, such as flat triangles, passes.
void check_refusals() {
  using Kind = sr::ErrorKind;
  const Hill hill(5);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [&](Kind kind, const char* part, const auto& change) {
    expect_refused(kind, part, [&] {
      Hill wrong = hill;
      sr::Mesh mesh = wrong.mesh();
      change(wrong, mesh);
      (void)sr::make_scene(mesh, {{"mesh-points", 100}});
    });
  };
  refused(Kind::usage, "without triangles", [](Hill&, sr::Mesh& mesh) { mesh.triangles = {}; });
  refused(Kind::usage, "vertex 25 in triangle 3, expected a number below 25",
          [](Hill& wrong, sr::Mesh&) { wrong.triangles[3][1] = 25; });
  refused(Kind::usage, "vertex 4294967295",
          [](Hill& wrong, sr::Mesh&) { wrong.triangles[0][0] = 0xFFFFFFFF; });
  refused(Kind::usage, "3 normals",
          [](Hill& wrong, sr::Mesh& mesh) { mesh.normals = std::span(wrong.normals).first(3); });
  refused(Kind::usage, "colors up to 200", [](Hill& wrong, sr::Mesh&) { wrong.colors[2][1] = 200.0F; });
  refused(Kind::usage, "zero character", [](Hill&, sr::Mesh& mesh) { mesh.name = std::string("a\0b", 3); });
  refused(Kind::usage, "2 values of the attribute 'heat'", [](Hill& wrong, sr::Mesh& mesh) {
    mesh.attributes = {{"heat", std::span(wrong.heights).first(2)}};
  });
  refused(Kind::usage, "named 'point'", [](Hill& wrong, sr::Mesh& mesh) {
    mesh.attributes = {{"point", wrong.heights}};
  });
  refused(Kind::usage, "two attributes named 'heat'", [](Hill& wrong, sr::Mesh& mesh) {
    mesh.attributes = {{"heat", wrong.heights}, {"heat", wrong.heights}};
  });
  refused(Kind::usage, "32 attributes", [](Hill& wrong, sr::Mesh& mesh) {
    for (int i = 0; i < 32; ++i) mesh.attributes.push_back({"a" + std::to_string(i), wrong.heights});
  });
  refused(Kind::usage, "in the attribute 'class', expected whole numbers", [](Hill& wrong, sr::Mesh& mesh) {
    mesh.attributes = {{"class", wrong.heights}};
  });
  refused(Kind::input, "point", [nan](Hill& wrong, sr::Mesh&) {
    for (auto& v : wrong.vertices) v[0] = nan;
  });
  const std::vector<sr::Object> none;
  expect_refused(Kind::input, "point", [&] { (void)sr::make_scene(none); });

  Hill odd = hill;
  odd.vertices[0][1] = nan;
  odd.triangles.push_back({3, 3, 3});
  const sr::Scene scene = sr::make_scene(odd.mesh(), {{"mesh-points", 100}});
  expect(!scene.notes().empty() && scene.notes()[0].find("not finite") != std::string::npos,
         "no note of triangles that were left out");
  odd.triangles = {{3, 3, 3}, {3, 4, 3}};
  expect(sr::make_scene(odd.mesh()).splats() > 0, "a mesh of flat triangles has no splat");
}

/// A small disc is seen where the pose and K of its camera project it to, off-centre and with fx other than fy.
void check_poses() {
  constexpr std::uint32_t WIDTH = 96, HEIGHT = 64;
  const double c = std::cos(0.4), s = std::sin(0.4);
  // Turned about z by 0.4 and looking down: x right, y down, z ahead.
  const std::array<std::array<double, 4>, 4> pose = {
      {{c, s, 0.0, 7.0}, {s, -c, 0.0, -3.0}, {0.0, 0.0, -1.0, 5.0}, {0.0, 0.0, 0.0, 1.0}}};
  const std::array<sr::Double3, 3> k = {{{110.0, 0.0, 30.25}, {0.0, 80.0, 45.5}, {0.0, 0.0, 1.0}}};
  const sr::Camera camera = sr::camera_from_pose(pose, k, WIDTH, HEIGHT);
  for (const auto& [u, v] : {std::pair{20.0, 12.0}, {70.5, 40.25}, {10.0, 55.0}}) {
    const double depth = 4.0, x = (u - k[0][2]) / k[0][0] * depth, y = (v - k[1][2]) / k[1][1] * depth;
    const std::vector<sr::Double3> place = {
        {pose[0][0] * x + pose[0][1] * y + 7.0, pose[1][0] * x + pose[1][1] * y - 3.0, 5.0 - depth}};
    const std::vector<sr::Float3> normal = {{0.0F, 0.0F, 1.0F}};
    const std::vector<float> radius = {0.1F};
    const sr::Scene scene = sr::make_scene({.positions = place, .normals = normal, .radii = radius});
    sr::Request request = {{"resolution", std::to_string(WIDTH) + "x" + std::to_string(HEIGHT)},
                           {"samples", 256}};
    const sr::Image image = sr::render(scene, request.set_camera(camera));
    double sum = 0.0, sum_u = 0.0, sum_v = 0.0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      const double coverage = image.pixels[i][3];
      sum += coverage;
      sum_u += coverage * double(i % WIDTH);
      sum_v += coverage * double(i / WIDTH);
    }
    const double off = std::hypot(sum_u / sum - u, sum_v / sum - v);
    expect(sum > 5.0 && off < 0.1,
           "a disc is seen " + std::to_string(off) + " pixels from where K and the pose project it to");
  }
  auto wrong = pose;
  wrong[0][0] *= 1.5;
  expect_refused(sr::ErrorKind::usage, "no rotation",
                 [&] { (void)sr::camera_from_pose(wrong, k, WIDTH, HEIGHT); });
  wrong = pose;
  for (auto& row : wrong) row[0] = -row[0];
  expect_refused(sr::ErrorKind::usage, "no rotation",
                 [&] { (void)sr::camera_from_pose(wrong, k, WIDTH, HEIGHT); });
  wrong = pose;
  wrong[3][0] = 1.0;
  expect_refused(sr::ErrorKind::usage, "last row",
                 [&] { (void)sr::camera_from_pose(wrong, k, WIDTH, HEIGHT); });
  auto skewed = k;
  skewed[0][1] = 2.0;
  expect_refused(sr::ErrorKind::usage, "skew",
                 [&] { (void)sr::camera_from_pose(pose, skewed, WIDTH, HEIGHT); });
  skewed = k;
  skewed[1][1] = -80.0;
  expect_refused(sr::ErrorKind::usage, "focal",
                 [&] { (void)sr::camera_from_pose(pose, skewed, WIDTH, HEIGHT); });
  expect_refused(sr::ErrorKind::usage, "pixels", [&] { (void)sr::camera_from_pose(pose, k, 0, HEIGHT); });
}

}  // namespace

std::vector<std::string> find_array_defects(const std::filesystem::path& folder) {
  check_meshes(folder);
  check_mixed();
  check_attributes(folder);
  check_attributes_of_meshes();
  check_refusals();
  check_poses();
  return defects;
}
