/// Small scenes for the tracing tests, preprocessed in memory.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "data/oriented_points.h"
#include "engine/scene/scene.h"

namespace splatray::testing {

/// One object of a test scene.
struct TestObject {
  OrientedPoints points;
  Material material;
};

/// A grey one-sided material with `flags`; a dielectric has ior 1.5 and a slight tint.
[[nodiscard]] Material test_material(std::uint32_t flags);

/// The objects as a scene, preprocessed with this leaf size.
[[nodiscard]] Scene scene_of(const std::vector<TestObject>& objects,
                             std::uint32_t leaf_size = BuildParams().leaf_size);

/// A file or glTF scene, preprocessed; `points` > 0 samples that many on its meshes. Files that a scene names
/// are looked for in `data_path`.
[[nodiscard]] Scene scene_of_file(const std::filesystem::path& path, std::uint64_t points,
                                  std::uint32_t leaf_size, const std::filesystem::path& data_path = {});

/// Writes the point files of a built-in scene (data/models.h), `points` in all, to folder/<model>.
void write_model(const std::string& model, std::uint64_t points, const std::filesystem::path& folder);

/// The folder with models/, scans/, gltf/ and env/ (variable SPLATRAY_DATA_DIR); nothing when it is not set.
[[nodiscard]] std::optional<std::filesystem::path> data_folder();

}  // namespace splatray::testing
