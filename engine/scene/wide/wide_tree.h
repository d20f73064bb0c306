/// Makes the wide tree of a scene.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/scene/scene.h"
#include "engine/scene/wide/wide_node.h"

namespace splatray {

/// How the tree of so many splats, less than 2^32, is laid out.
[[nodiscard]] WideLevels wide_levels(std::uint64_t splats);

/// The indices of splats in the order that a tree has them in, leaf by leaf. On `threads` threads, 0 = one a core; the order does not
/// depend on how many.
[[nodiscard]] std::vector<std::uint32_t> wide_order(std::span<const uvec4> splats, unsigned threads);

/// The nodes over splats that lie in such an order, level by level, the lowest first. Of splats in any other order they are as right, but
/// their boxes are large.
[[nodiscard]] std::vector<WideNode> wide_nodes(std::span<const uvec4> splats, unsigned threads);

/// Whether a scene has a tree: as many nodes as its splats ask for.
[[nodiscard]] bool has_wide_tree(const Scene& scene);

/// Brings a scene's splats, and all that lies beside them, into the order of a tree, and adds its nodes.
void add_wide_tree(Scene& scene, unsigned threads = 0);

/// The index of the splat of these words, such as the one that a ray met (RayHit::first), the first where there are several; nothing where
/// there is none. Takes few steps in a scene that has a tree, else as many as it has splats.
[[nodiscard]] std::optional<std::size_t> find_splat(const Scene& scene, const uvec4& words);

}  // namespace splatray
