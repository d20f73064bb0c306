/// The scenes on which answers are compared with brute force.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace splatray::testing {

/// The names of all: "sphere", "torus", "room", "bunny", "armadillo", "dragon" and "lattice" (tests/hard/support/lattice_soup.h).
[[nodiscard]] const std::vector<std::string>& exact_scene_names();

/// About `points` even samples of it, preprocessed as the program does by default ("lattice" has its own number). Nothing for a
/// real model that is not in `data`. Throws Error.
[[nodiscard]] std::optional<Scene> exact_scene(const std::string& name, std::uint64_t points,
                                               const std::filesystem::path& data);

/// How the objects of a scene look, which decides which sides of its discs count.
enum class Sides { one, both, glass };
/// The scene's materials, all of them with such sides.
[[nodiscard]] std::vector<Material> materials_with(const Scene& scene, Sides sides);

}  // namespace splatray::testing
