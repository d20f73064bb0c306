/// What a scene must satisfy before the engine may walk it.
#pragma once
#include <optional>
#include <string>

#include "engine/scene/scene.h"

namespace splatray {

/// A breach of the scene's rules: what was found and what was expected, each part of a sentence.
struct SceneDefect {
  std::string found;
  std::string expected;
};

/// The first defect of a scene, or nothing. Checked: root transform, up, bounds and build parameters finite and in range;
/// the octree is a tree of at most MAX_DEPTH levels that uses every node word once and stays inside its pools; Begin-End
/// ascends from 0 to the data pool's size; every splat has a valid normal, a finite radius no larger than the root and an
/// existing object; the pools' sizes agree; materials, lights and camera are finite. Linear in the scene's size.
[[nodiscard]] std::optional<SceneDefect> find_scene_defect(const Scene& scene);

}  // namespace splatray
