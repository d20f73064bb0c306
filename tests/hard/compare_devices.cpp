// compare_devices NAME NAME: renders the scenes of data/scenes and traces rays on two devices and prints, as
// Markdown tables, how many pixels and hits differ. Models come from the folder SPLATRAY_DATA_DIR names.
#include <cstdio>
#include <iostream>

#include "app/library/commit.h"
#include "data/shapes.h"
#include "engine/base/error.h"
#include "tests/hard/support/clouds.h"
#include "tests/hard/support/device_scene.h"
#include "tests/hard/support/lattice_soup.h"
#include "tests/temp_folder.h"
#include "tests/trace/agreement.h"
#include "tests/trace/rays.h"

namespace splatray::testing {
namespace {

constexpr std::uint64_t SPLATS = 20000;
constexpr std::size_t RAYS = 50000;

struct NamedScene {
  std::string name;
  Scene scene;
};

/// The scenes of data/scenes that can be made here.
std::vector<NamedScene> all_scenes() {
  const std::filesystem::path folder(SPLATRAY_SCENES);
  const TempFolder points;
  std::vector<NamedScene> scenes;
  for (const std::string name : {"demo", "room"}) {
    write_model(name, SPLATS, points.path());
    scenes.push_back({name, scene_of_file(folder / (name + ".gltf"), SPLATS, 10, points.path())});
  }
  if (const auto data = data_folder())
    for (const std::string name :
         {"table1_dragon", "table1_david", "reflective_buddha", "refractive_dragon", "teapot"})
      scenes.push_back({name, scene_of_file(folder / (name + ".gltf"), SPLATS, 10, *data)});
  scenes.push_back({"splats on cell planes", lattice_soup()});
  return scenes;
}

/// Primary rays of the scene, and the mirrored, diffuse and refracted ones from what `device` hits first.
std::vector<RayQuery> rays_of(const Scene& scene) {
  std::vector<RayQuery> rays = random_primary_rays(scene, RAYS, 1);
  const BruteForce brute(scene);
  const std::vector<RayQuery> few(rays.begin(), rays.begin() + RAYS / 10);
  const std::vector<RayQuery> more = secondary_rays(scene, few, all_nearest(brute, few, {}), 2);
  rays.insert(rays.end(), more.begin(), more.end());
  return rays;
}

void compare_hits(const NamedScene& named, DeviceScene& a, DeviceScene& b) {
  const std::vector<RayQuery> rays = rays_of(named.scene);
  const std::vector<RayHit> of_a = a.intersect(rays);
  const std::vector<RayHit> of_b = b.intersect(rays);
  std::cout << "| " << named.name << " | rays | " << rays.size() << " | " << different_bits(of_a, of_b)
            << " | " << device_agreement(rays, of_a, of_b) << " |\n";
}

void compare_pictures(const NamedScene& named, DeviceScene& a, DeviceScene& b) {
  const View view{default_camera(named.scene, 4.0 / 3.0), 96, 72};
  Settings settings;
  settings.samples = 4;
  const Image of_a = a.render(view, settings, studio_environment());
  const Image of_b = b.render(view, settings, studio_environment());
  std::size_t visible = 0;
  float largest = 0.0F;
  for (std::size_t i = 0; i < of_a.rgba.size(); ++i) {
    const vec4 difference = glm::abs(of_a.rgba[i] - of_b.rgba[i]);
    const float most = std::max({difference.x, difference.y, difference.z, difference.w});
    visible += most > 1.0F / 255.0F ? 1 : 0;
    largest = std::max(largest, most);
  }
  std::cout << "| " << named.name << " | pixels | " << of_a.rgba.size() << " | "
            << different_bits(of_a.rgba, of_b.rgba) << " | by more than 1/255: " << visible
            << ", largest difference " << short_number(double(largest)) << " |\n";
}

int run(int argc, char** argv) {
  if (argc != 3) throw Error(ExitCode::usage, "expected the names of two devices");
  const std::unique_ptr<Device> a = open_device(argv[1]);
  const std::unique_ptr<Device> b = open_device(argv[2]);
  std::cout << "Devices: " << a->info().name << " (" << a->info().driver << "), " << b->info().name << " ("
            << b->info().driver << "), of commit " << COMMIT
            << ".\n\n| scene | what | of | differ in some bit | of them |\n"
            << "| --- | --- | --- | --- | --- |\n";
  for (const NamedScene& named : all_scenes()) {
    DeviceScene on_a(named.scene, *a);
    DeviceScene on_b(named.scene, *b);
    compare_hits(named, on_a, on_b);
    compare_pictures(named, on_a, on_b);
  }
  return static_cast<int>(ExitCode::done);
}

}  // namespace
}  // namespace splatray::testing

int main(int argc, char** argv) {
  return splatray::run_main("compare_devices", splatray::testing::run, argc, argv);
}
