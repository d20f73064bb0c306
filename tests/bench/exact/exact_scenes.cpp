#include "tests/bench/exact/exact_scenes.h"

#include <array>

#include "data/models.h"
#include "preprocess/build.h"
#include "tests/hard/support/lattice_soup.h"
#include "tests/trace/scenes.h"

namespace splatray::testing {
namespace {

/// A built-in model, all objects matte.
Scene built_in(const std::string& name, std::uint64_t points) {
  std::vector<TestObject> objects;
  for (const auto& [object, cloud] : sample(models().at(name)({}), {.count = points}))
    objects.push_back({cloud, test_material(0)});
  return scene_of(objects);
}

}  // namespace

const std::vector<std::string>& exact_scene_names() {
  static const std::vector<std::string> names{"sphere",    "torus",  "room",   "bunny",
                                              "armadillo", "dragon", "lattice"};
  return names;
}

std::optional<Scene> exact_scene(const std::string& name, std::uint64_t points,
                                 const std::filesystem::path& data) {
  if (name == "lattice") return lattice_soup();
  if (models().contains(name)) return built_in(name, points);
  const std::filesystem::path file = data / "models" / (name + ".ply");
  if (!std::filesystem::exists(file)) return std::nullopt;
  return scene_of_file(file, points, BuildParams().leaf_size);
}

std::vector<Material> materials_with(const Scene& scene, Sides sides) {
  std::vector<Material> materials;
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    constexpr std::array FLAGS{0U, MATERIAL_TWO_SIDED, MATERIAL_DIELECTRIC};
    Material& material = materials.emplace_back(test_material(FLAGS[static_cast<std::size_t>(sides)]));
    material.mask_bit = static_cast<std::uint32_t>(i % 32);
  }
  return materials;
}

}  // namespace splatray::testing
