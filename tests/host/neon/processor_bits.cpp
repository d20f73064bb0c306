/// processor_bits BITS FOLDER SCENE...: writes what the host's device makes of the scenes by vectors of at most so many bits, each answer a
/// file of 32-bit words in FOLDER, so that answers of several processors can be compared.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/device/device.h"
#include "engine/file/scene_file.h"
#include "engine/image/denoise.h"
#include "engine/table/albedo_table.h"
#include "tests/gpu/shown_tracer.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

constexpr std::uint32_t WIDTH = 96, HEIGHT = 64;

/// What is written is named after the scene and what it is.
class Answers {
 public:
  Answers(std::filesystem::path folder, std::string scene)
      : folder_(std::move(folder)), scene_(std::move(scene)) {}

  template <class Value>
  void write(const std::string& what, std::span<const Value> values) const {
    std::ofstream file(folder_ / (scene_ + "." + what), std::ios::binary);
    file.write(reinterpret_cast<const char*>(values.data()),
               static_cast<std::streamsize>(values.size_bytes()));
    if (!file.flush()) throw Error(ExitCode::failed, scene_ + "." + what + ": cannot be written");
  }

 private:
  std::filesystem::path folder_;
  std::string scene_;
};

/// Rays from around a scene into the box of its centres; by sums, products and square roots alone, which are the same everywhere.
std::vector<RayQuery> rays_into(const Scene& scene, std::size_t count) {
  std::mt19937_64 random(1);
  const auto part = [&] { return std::ldexp(static_cast<double>(random() >> 11U), -53); };
  const auto place = [&](const dvec3& low, const dvec3& high) {
    const double x = part(), y = part(), z = part();
    return low + (high - low) * dvec3(x, y, z);
  };
  const double edge = std::ldexp(1.0, int{LATTICE_BITS});
  const dvec3 low = scene.root.to_root(scene.bounds_min_world),
              high = scene.root.to_root(scene.bounds_max_world);
  std::vector<RayQuery> rays(count);
  for (RayQuery& ray : rays) {
    const dvec3 eye = place(dvec3(-edge), dvec3(2.0 * edge));
    ray.origin = vec3(eye);
    ray.dir = vec3(glm::normalize(place(low, high) - eye));
    ray.from_object = NO_OBJECT;
  }
  return rays;
}

/// On from the hits, as a mirror sends them.
std::vector<RayQuery> mirrored(std::span<const RayQuery> rays, std::span<const RayHit> hits) {
  std::vector<RayQuery> next;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (hits[i].object == NO_OBJECT) continue;
    const dvec3 dir(rays[i].dir), normal(hits[i].normal);
    RayQuery& ray = next.emplace_back();
    ray.origin = vec3(dvec3(rays[i].origin) + double(hits[i].t) * dir);
    ray.dir = vec3(glm::normalize(dir - 2.0 * glm::dot(dir, normal) * normal));
    ray.from_normal = hits[i].normal;
    ray.from_object = hits[i].object;
  }
  return next;
}

void write_hits(const Scene& scene, ShownTracer& tracer, const Answers& answers) {
  std::vector<RayQuery> rays = rays_into(scene, 20000);
  for (const char* what : {"hits", "mirrored"}) {
    const std::vector<RayHit> hits = tracer.intersect(rays, Settings());
    answers.write<RayHit>(what, hits);
    rays = mirrored(rays, hits);
  }
}

void write_pictures(const View& view, ShownTracer& tracer, const Answers& answers) {
  for (const auto& [name, look, samples] :
       {std::tuple("paper", LOOK_PAPER, 2U), std::tuple("ao", LOOK_AO, 2U), std::tuple("scan", LOOK_SCAN, 2U),
        std::tuple("clay", LOOK_CLAY, 4U), std::tuple("lit", LOOK_LIT, 4U)}) {
    Settings settings;
    settings.look = look;
    settings.samples = samples;
    settings.aov = look == LOOK_PAPER;
    settings.albedo = settings.estimate_error = look == LOOK_LIT;
    if (settings.albedo) settings.aov = true;
    const Image image = tracer.render(view, settings);
    answers.write<vec4>(name, image.rgba);
    if (look == LOOK_PAPER) answers.write<AovPixel>("seen", image.aov);
    if (look == LOOK_LIT) answers.write<vec4>("filtered", denoised(image, image.albedo).rgba);
  }
}

/// Below a sky, and beside a lamp where the scene has no light of its own.
void write_scene_answers(const Device& device, std::uint32_t bits, const std::filesystem::path& path,
                         const std::filesystem::path& folder) {
  const Scene scene = read_scene(path);
  const Answers answers(folder, path.stem().string());
  const View view{default_camera(scene, double(WIDTH) / HEIGHT), WIDTH, HEIGHT};
  ShownTracer tracer(device, {.vector_bits = bits});
  tracer.upload(scene);
  tracer.set_environment(studio_environment());
  if (tracer.look.lights.empty()) tracer.look.lights = default_lights(scene, view.camera);
  write_hits(scene, tracer, answers);
  write_pictures(view, tracer, answers);
}

int run(int argc, char** argv) {
  if (argc < 4) throw Error(ExitCode::usage, "usage: processor_bits BITS FOLDER SCENE...");
  const auto bits = static_cast<std::uint32_t>(std::strtoul(argv[1], nullptr, 10));
  const std::filesystem::path folder = argv[2];
  std::filesystem::create_directories(folder);
  Answers(folder, "tables").write<float>("albedo", ALBEDO_TABLE);
  const auto device = open_device(HOST_DEVICE);
  for (int i = 3; i < argc; ++i) write_scene_answers(*device, bits, argv[i], folder);
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace splatray::testing

int main(int argc, char** argv) {
  return splatray::run_main("processor_bits", splatray::testing::run, argc, argv);
}
