#include "tests/trace/scenes.h"

#include <cstdlib>

#include "data/models.h"
#include "engine/scene/phong.h"
#include "preprocess/build.h"

namespace splatray::testing {

Material test_material(std::uint32_t flags) {
  Material material{};
  material.phong.diffuse = vec3(0.7F, 0.6F, 0.5F);
  material.phong.specular = 0.1F;
  material.phong.shininess = 30.0F;
  material.phong.tint = (flags & MATERIAL_DIELECTRIC) != 0 ? vec3(0.95F, 1.0F, 0.97F) : vec3(0.0F);
  material.ior = 1.5F;
  material.flags = flags;
  follow_phong(material);
  return material;
}

Scene scene_of(const std::vector<TestObject>& objects, std::uint32_t leaf_size) {
  Input input;
  for (const TestObject& object : objects) {
    InputObject& added = input.objects.emplace_back();
    added.name = "object " + std::to_string(input.objects.size());
    added.points.position = object.points.position;
    for (const glm::dvec3& normal : object.points.normal) added.points.normal.emplace_back(normal);
    for (const glm::dvec3& color : object.points.color) added.points.color.emplace_back(color);
    added.material = object.material;
    follow_phong(added.material);
    added.oriented = true;
  }
  BuildParams params;
  params.leaf_size = leaf_size;
  BuildStats stats;
  return build_scene(std::move(input), params, 0, stats);
}

Scene scene_of_file(const std::filesystem::path& path, std::uint64_t points, std::uint32_t leaf_size,
                    const std::filesystem::path& data_path) {
  ReadOptions options;
  options.samples = points;
  if (!data_path.empty()) options.data_paths.push_back(data_path);
  BuildParams params;
  params.leaf_size = leaf_size;
  BuildStats stats;
  return build_scene(read_input({path}, options), params, 0, stats);
}

void write_model(const std::string& model, std::uint64_t points, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / model);
  for (const auto& [object, cloud] : sample(models().at(model)({}), {.count = points}))
    write_ply(cloud, folder / model / (object + ".ply"));
}

std::optional<std::filesystem::path> data_folder() {
  const char* folder = std::getenv("SPLATRAY_DATA_DIR");
  if (folder == nullptr || *folder == '\0') return std::nullopt;
  return folder;
}

}  // namespace splatray::testing
