/// What a scene must satisfy before the engine may walk it.
#pragma once
#include <optional>
#include <span>
#include <string>

#include "engine/scene/scene.h"

namespace splatray {

/// A breach of the scene's rules: what was found and what was expected, each part of a sentence.
struct SceneDefect {
  std::string found;
  std::string expected;
};

/// The first defect of a scene, or nothing: those of find_tree_defect, then those of find_content_defect. What the discs have
/// in their leaves' cells is not looked at (find_slab_defect, slab_check.h), nor whether a leaf lists all discs that reach it,
/// which depends on how the scene was built. Linear in the scene's size.
[[nodiscard]] std::optional<SceneDefect> find_scene_defect(const Scene& scene);

/// Checks the octree: every node word is used once and stays inside the pool, the tree has at most MAX_DEPTH levels, each of the
/// filled leaves is named by one node, and the box of an empty leaf lies in the root and holds no filled leaf.
[[nodiscard]] std::optional<SceneDefect> find_tree_defect(std::span<const std::uint32_t> nodes,
                                                          std::size_t filled_leaves);

/// Checks all else: root transform, up, bounds and build parameters are finite and in range; the pools' sizes agree; Begin-End
/// ascends from 0 to the reference pool's size; references are of existing splats; slabs have an axis, and halves that leave
/// out no splat; every splat has a valid normal, a finite radius no larger than the root and an existing object; materials,
/// lights and camera are finite and in range.
[[nodiscard]] std::optional<SceneDefect> find_content_defect(const Scene& scene);

/// Checks materials and lights alone.
[[nodiscard]] std::optional<SceneDefect> find_look_defect(const std::vector<Material>& materials,
                                                          const std::vector<SceneLight>& lights);

}  // namespace splatray
