/// Runs the examples and compares the library with closed forms. Works in the folder named by its argument; exit 1 with a
/// sentence for each finding. `memory` in place of the folder: what needs none.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <thread>

#include "arrays.h"
#include "examples.h"
#include "reentrance.h"

namespace {

namespace sr = splatray::api;

int findings = 0;

void expect(bool holds, const std::string& sentence) {
  if (holds) return;
  ++findings;
  std::fprintf(stderr, "%s\n", sentence.c_str());
}

/// The kind of Error that a call throws; nothing where it throws none.
template <typename Call>
std::optional<sr::ErrorKind> kind_of_error(const Call& call) {
  try {
    call();
    return {};
  } catch (const sr::Error& error) {
    expect(std::string(error.what()).size() > 10, "an error says nothing");
    return error.kind();
  }
}

template <typename Call>
void expect_error(sr::ErrorKind kind, const Call& call, const std::string& name) {
  const auto found = kind_of_error(call);
  expect(found == kind, name + ": found " + (found ? std::to_string(int(*found)) : "no error") +
                            ", expected kind " + std::to_string(int(kind)));
}

/// Points of the plane z = height about (x, y), 0.1 apart, facing up.
struct Plane {
  std::vector<sr::Double3> positions;
  std::vector<sr::Float3> normals;
  Plane(double x, double y, double height) {
    for (int i = -20; i <= 20; ++i)
      for (int j = -20; j <= 20; ++j) positions.push_back({x + 0.1 * i, y + 0.1 * j, height});
    normals.assign(positions.size(), {0.0F, 0.0F, 1.0F});
  }
  [[nodiscard]] sr::Points points() const {
    return {.positions = positions, .normals = normals, .name = "plane"};
  }
};

/// Largest |t - expected| of oblique rays on a plane, and whether each names the point next to it; expected for a plane at
/// `height`.
double plane_error(const Plane& plane, double height, double distance) {
  const sr::Scene scene = sr::make_scene(plane.points());
  const sr::Double3 direction{0.3, -0.2, -1.0};
  const double length = std::sqrt(0.3 * 0.3 + 0.2 * 0.2 + 1.0);
  std::vector<sr::Double3> origins, directions;
  for (const sr::Double3& p : plane.positions) {
    origins.push_back({p[0] - 0.3 * distance, p[1] + 0.2 * distance, p[2] + distance});
    directions.push_back(direction);
  }
  const sr::Hits hits = sr::trace(scene, origins, directions);
  double error = 0.0;
  for (std::size_t i = 0; i < origins.size(); ++i) {
    const bool hit = hits.object[i] == 0 && hits.splat[i] >= 0 && hits.normal[i][2] > 0.999F;
    expect(hit, "a ray on a plane was lost");
    if (!hit) continue;
    error = std::max(error, std::abs(hits.t[i] - (origins[i][2] - height) * length));
    const sr::Double3& named = plane.positions.at(std::size_t(hits.point[i]));
    const sr::Scene::Splat splat = scene.splat(std::size_t(hits.splat[i]));
    for (int axis = 0; axis < 3; ++axis)
      expect(std::abs(named[axis] - splat.center[axis]) < 1e-5, "a hit's point is not its splat");
    expect(
        std::hypot(named[0] - plane.positions[i][0], named[1] - plane.positions[i][1]) <= splat.radius + 1e-5,
        "a ray hit a splat that it does not meet");
  }
  return error;
}

void check_rays() {
  constexpr double BOUND = 5e-6;  // 1e-6 of the plane's diagonal
  for (const double distance : {0.01, 3.0, 1e4}) {
    expect(plane_error(Plane(0.0, 0.0, 0.0), 0.0, distance) < BOUND, "t is off on a plane at the origin");
    expect(plane_error(Plane(5e5, 4e6, 250.0), 250.0, distance) < BOUND, "t is off on a plane far out");
  }
  expect(plane_error(Plane(0.0, 0.0, 0.0), 1e-5, 3.0) > BOUND,
         "a plane 1e-5 lower was not distinguished from the right one");
  const sr::Scene scene = sr::make_scene(Plane(0.0, 0.0, 0.0).points());
  const std::vector<sr::Double3> origins = {{0, 0, 1}, {9, 9, 1}, {0, 0, -1}},
                                 directions = {{0, 0, 1}, {0, 0, -1}, {0, 0, -1}};
  const sr::Hits missed = sr::trace(scene, origins, directions);
  for (int i = 0; i < 3; ++i)
    expect(
        std::isinf(missed.t[i]) && missed.object[i] == -1 && missed.splat[i] == -1 && missed.point[i] == -1,
        "a ray that misses hit something");
  const std::vector<sr::Double3> no_rays;
  const std::vector<sr::Double3> at_plane = {{0.1, 0.1, 1}, {9, 9, 1}}, downwards = {{0, 0, -2}, {0, 0, -2}};
  const double near[] = {0.9}, far[] = {1.1, 1.1}, none_ahead[] = {-1.0};
  using Met = std::vector<std::uint8_t>;
  expect(sr::occluded(scene, at_plane, downwards) == Met{1, 0}, "any hit is not a hit");
  expect(sr::occluded(scene, at_plane, downwards, near) == Met{0, 0}, "a ray goes on behind its end");
  expect(sr::occluded(scene, at_plane, downwards, far) == Met{1, 0}, "a ray ends before its end");
  expect(sr::trace(scene, at_plane, downwards, near).object[0] == -1, "trace goes on behind t_max");
  expect(sr::trace(scene, at_plane, downwards, far).object[0] == 0, "trace ends before t_max");
  const std::vector<sr::Float3> single = {{0.1F, 0.1F, 1.0F}}, down = {{0.0F, 0.0F, -1.0F}};
  expect(sr::occluded(scene, single, down) == Met{1} &&
             std::abs(sr::trace(scene, single, down).t[0] - 1.0) < 1e-6,
         "rays of float32 hit something else");
  expect_error(
      sr::ErrorKind::usage, [&] { (void)sr::occluded(scene, at_plane, downwards, none_ahead); },
      "t_max below 0");
  expect(sr::trace(scene, no_rays, no_rays).t.empty(), "no rays gave hits");
}

void check_errors(const std::filesystem::path& folder) {
  using Kind = sr::ErrorKind;
  const Plane plane(0.0, 0.0, 0.0);
  sr::Scene scene = sr::make_scene(plane.points());
  const std::vector<sr::Double3> one = {{0, 0, 1}}, none = {{0, 0, 0}}, nan = {{0, 0, std::nan("")}};
  expect_error(
      Kind::input, [&] { (void)sr::open(folder / "missing.ply"); }, "missing file");
  expect_error(
      Kind::usage, [&] { (void)sr::open(std::vector<std::filesystem::path>{}); }, "no file");
  std::ofstream(folder / "text.ply") << "not a ply\n";
  expect_error(
      Kind::input, [&] { (void)sr::open(folder / "text.ply"); }, "no PLY");
  expect_error(
      Kind::input, [&] { (void)sr::make_scene(sr::Points{}); }, "no points");
  expect_error(
      Kind::input, [&] { (void)sr::make_scene(sr::Points{.positions = nan}); }, "no finite point");
  expect_error(
      Kind::usage,
      [&] { (void)sr::make_scene(sr::Points{.positions = one, .radii = std::vector<float>(2)}); }, "radii");
  expect_error(
      Kind::usage, [&] { (void)sr::trace(scene, one, none); }, "no direction");
  expect_error(
      Kind::usage, [&] { (void)sr::trace(scene, nan, one); }, "NaN");
  expect_error(
      Kind::usage, [&] { (void)sr::trace(scene, one, {}); }, "sizes");
  for (const auto& [name, text] : {std::pair{"resolution", "0x1"},
                                   {"samples", "0"},
                                   {"lights", "some"},
                                   {"blend", "soft"},
                                   {"object", "plane:glow=1"},
                                   {"look", "nice"},
                                   {"tone", "bright"},
                                   {"light", "0,0,1,-1,0,0"},
                                   {"no-such-field", "1"}})
    expect_error(
        Kind::usage,
        [&, name = name, text = text] {
          (void)sr::Request{{name, text}};
        },
        name);
  const auto refused = [&](Kind kind, const sr::Request& request, const std::string& name) {
    expect_error(
        kind, [&] { (void)sr::render(scene, request); }, name);
  };
  refused(Kind::usage, {{"eye", "0,0,0"}, {"target", "0,0,0"}}, "eye is target");
  refused(Kind::usage, {{"target", "0,0,0"}}, "target alone");
  refused(Kind::usage, {{"object", "other:hidden=on"}}, "another object");
  refused(Kind::input, {{"resolution", "8x8"}, {"environment", "missing.hdr"}}, "environment");
  expect_error(
      Kind::input, [] { (void)sr::Request::from_json("{\"samples\": []}"); }, "JSON of no request");
  expect_error(
      Kind::input, [&] { (void)sr::Request::of_picture(folder / "text.ply"); }, "no picture");
  expect_error(
      Kind::usage, [&] { (void)sr::frame(scene, {.elevation_deg = 91.0}); }, "elevation");
  expect_error(
      Kind::usage, [&] { (void)sr::named_material("wood"); }, "material");
  expect_error(
      Kind::usage, [&] { sr::Image{}.save(folder / "empty.png"); }, "empty image");
  expect_error(
      Kind::usage,
      [&] {
        sr::render(scene, {{"resolution", "8x8"}}).save(folder / "a.tif");
      },
      "extension");
  expect_error(
      Kind::failed,
      [&] {
        sr::render(scene, {{"resolution", "8x8"}}).save(folder / "no" / "a.png");
      },
      "no folder");
  expect_error(
      Kind::no_device,
      [&] {
        (void)sr::make_scene(plane.points(), {{"device", "no such device"}}).device();
      },
      "device");
  const sr::Scene other = std::move(scene);
  expect_error(
      Kind::usage, [&] { (void)scene.splats(); }, "moved from");
  struct Own {};
  bool passed_on = false;
  try {
    (void)sr::render(other, {{"resolution", "64x64"}}, [](const char*, double) -> bool { throw Own{}; });
  } catch (const Own&) {
    passed_on = true;
  }
  expect(passed_on, "what progress threw did not come out");
}

/// All fields can be set by what they are now, and JSON holds what was set.
void check_requests(const sr::Scene& scene, const std::filesystem::path& folder) {
  sr::Request request = {{"samples", 3},     {"resolution", "16x9"}, {"environment_strength", 0.5},
                         {"denoise", false}, {"sun", "0,0,1"},       {"light", "1,2,3"}};
  request.set_camera(sr::frame(scene)).add_material("sphere", {.roughness = 0.25F});
  const sr::Request same = sr::Request::from_json(request.json());
  expect(same.json() == request.json() && same.get("lights").empty() && same.get("sun").size() == 1,
         "a request did not come back from its JSON");
  expect(sr::render(scene, same).pixels == sr::render(scene, request).pixels, "its picture is another");
  for (const sr::FieldInfo& field : sr::Request::fields()) {
    expect(!field.help.empty() && !field.group.empty(), field.name + " says nothing");
    const std::vector<std::string> texts = request.get(field.name);
    sr::Request again = request;  // "light" replaces suns, too
    for (std::size_t i = 0; i < texts.size(); ++i)
      i == 0 ? again.set(field.name, texts[i]) : again.add(field.name, texts[i]);
    expect(again.get(field.name) == texts, field.name + " set to what it is is another");
  }
  scene.save(folder / "request.soct");
  const sr::Request whole = sr::Request(request).set("inputs", (folder / "request.soct").string());
  expect(sr::make_picture(whole).pixels == sr::render(scene, request).pixels,
         "make_picture gave another picture");
}

void check_pictures(const std::filesystem::path& folder) {
  const sr::Scene scene = scene_of_arrays();
  expect(scene.splats() == 20000 && scene.objects() == std::vector<std::string>{"sphere"},
         "the sphere's splats or name");
  const sr::Image gold = gold_at_night(scene);
  sr::Image again, more;
  std::thread first([&] { again = gold_at_night(scene); });
  std::thread second([&] { more = gold_at_night(scene_of_arrays()); });
  first.join();
  second.join();
  expect(gold.pixels == again.pixels && gold.pixels == more.pixels, "two threads made two pictures");
  expect(gold.pixels != sr::render(scene, {{"resolution", "320x180"}}).pixels,
         "gold at night is the default look");
  scene.save(folder / "sphere.soct");
  const sr::Image of_file = picture_of_a_file(folder / "sphere.soct");
  expect(of_file.pixels == sr::render(scene, {{"resolution", "320x180"}}).pixels,
         "the scene's file is another scene");
  turntable(scene, folder);
  expect(std::filesystem::file_size(folder / "turn7.png") > 100, "no picture of the turntable");
  check_requests(scene, folder);
  const std::vector<unsigned char> png = of_file.png();
  expect(png.size() > 8 && png[1] == 'P' && png[2] == 'N' && png[3] == 'G', "png() gave no PNG");
  expect(!give_up_after(scene, 0.0).empty() && give_up_after(scene, 0.0) != "done", "cancelling did nothing");
}

/// The ball's middle lies at the world's origin: the pose and K of the example project it to (78, 60).
void check_photograph() {
  const sr::Scene scene = ball_on_a_floor();
  const sr::Image photo = as_photographed(scene);
  double low = 1e9, high = -1e9;
  const std::size_t row = 60;
  for (std::size_t x = 0; x < photo.width; ++x)
    if (photo.pixels[row * photo.width + x][3] > 0.5F)
      low = std::min(low, double(x)), high = std::max(high, double(x));
  // Of a ball, the silhouette's middle lies a little farther out than its own.
  expect(std::abs((low + high) / 2.0 - 78.0) < 1.0, "the ball is photographed elsewhere than K says");
  expect(std::abs((high - low) / 2.0 - 200.0 / std::sqrt(64.25 - 1.0)) < 1.5,
         "the ball is photographed in another size");
}

/// A scan is shown in a look without materials, until it is given one.
void check_materials_of_scans() {
  const Plane plane(0.0, 0.0, 0.0);
  const sr::Scene scan = sr::make_scene({.positions = plane.positions, .scanned = true});
  const sr::Request small = {{"resolution", "32x32"}, {"samples", 1}};
  const auto with = [&](const sr::Material& material, const char* look) {
    return sr::render(scan, sr::Request(small).add_material("0", material).set("look", look)).pixels;
  };
  const sr::Material own = scan.materials().front(), gold = sr::named_material("gold");
  expect(sr::render(scan, small).pixels == with(own, "auto"), "its own material changes a scan's picture");
  expect(with(gold, "auto") == with(gold, "lit"), "a scan of gold is not shown lit");
  expect(with(gold, "auto") != with(own, "auto"), "a scan of gold looks as it did");
}

/// A camera on the equator and a scanner beside the sphere of radius 1: closed forms within a thousandth.
void check_depth_and_ranges() {
  const sr::Scene scene = scene_of_arrays();
  const sr::Double3 center{500000.0, 4000000.0, 100.0};
  const auto images = depth_of_poses(
      scene, {{.eye = {center[0] + 3.0, center[1], center[2]}, .target = center, .up = {0, 0, 1}}});
  const std::size_t middle = std::size_t(60) * 160 + 80;
  expect(std::abs(images[0].depth[middle] - 2.0F) < 2e-3F && images[0].normal[middle][0] > 0.99F &&
             images[0].object[middle] == 0,
         "depth or normal of the sphere's middle");
  expect(std::isinf(images[0].depth[0]) && images[0].object[0] == -1, "the corner is not empty");
  const std::vector<float> ranges = simulated_lidar(scene, {center[0] - 3.0, center[1], center[2]});
  expect(std::abs(ranges[0] - 2.0F) < 2e-3F, "range ahead");
  const double side = 10.0 * 3.14159265358979 / 180.0;
  const double expected = 3.0 * std::cos(side) - std::sqrt(1.0 - 9.0 * std::sin(side) * std::sin(side));
  expect(std::abs(ranges[10] - expected) < 2e-3, "range 10 degrees aside");
  expect(std::isinf(ranges[90]), "range away from the sphere");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::filesystem::path folder = argv[1];
  try {
    if (folder == "memory") return gold_at_night(scene_of_arrays()).pixels.empty() ? 1 : 0;
    check_rays();
    check_errors(folder);
    check_pictures(folder);
    check_materials_of_scans();
    check_photograph();
    check_depth_and_ranges();
    for (const std::string& defect : find_array_defects(folder)) expect(false, defect);
    alarm(240);  // a defect may be a call that never ends
    const std::string defect = find_reentrance_defect();
    expect(defect.empty(), defect);
  } catch (const sr::Error& error) {
    std::fprintf(stderr, "error of kind %d: %s\n", int(error.kind()), error.what());
    return 1;
  }
  return findings == 0 ? 0 : 1;
}
