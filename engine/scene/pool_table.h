/// The one table of a scene's pools: their sections in the file, size checks, buffers on the device, bindings and names
/// follow it. A new pool is a member of Scene, a row here, a binding in shaders/layout.h and a reader in
/// shaders/scene/bindings.glsl.
#pragma once
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include "engine/scene/scene.h"

namespace splatray {

/// How many elements a pool has.
enum class PoolLength {
  nodes,      ///< node words
  leaf_ends,  ///< filled leaves + 1
  leaves,     ///< filled leaves
  references,
  splats,
};

/// One pool. Where it is optional, a scene has either none of it or all.
template <typename Value>
struct PoolRow {
  const char* name;    ///< in messages and panels
  const char* plural;  ///< what its elements are
  const char* key;     ///< in JSON
  std::vector<Value> Scene::*pool;
  PoolLength length;
  bool optional = false;
  bool listed = false;  ///< beside the splats: leaves may have copies of it, one for each reference
};

/// In the order of their file sections and of their bindings, from BIND_NODE_POOL on.
inline constexpr std::tuple POOL_TABLE{
    PoolRow<std::uint32_t>{"node pool", "node words", "node_pool", &Scene::node_pool, PoolLength::nodes},
    PoolRow<std::uint32_t>{"Begin-End", "leaf ends", "begin_end", &Scene::begin_end, PoolLength::leaf_ends},
    PoolRow<std::uint32_t>{"pool of slabs", "slabs", "slab_pool", &Scene::slab_pool, PoolLength::leaves},
    PoolRow<std::uint32_t>{"reference pool", "references", "reference_pool", &Scene::reference_pool,
                           PoolLength::references},
    PoolRow<uvec4>{"data pool", "splats", "data_pool", &Scene::data_pool, PoolLength::splats, false, true},
    PoolRow<std::uint32_t>{"colour pool", "colours", "color_pool", &Scene::color_pool, PoolLength::splats,
                           true, true},
    PoolRow<std::uint32_t>{"pool of normal fields", "normal fields", "field_pool", &Scene::field_pool,
                           PoolLength::splats, true, true},
    PoolRow<std::uint32_t>{"pool of clip lines", "clip lines", "clip_pool", &Scene::clip_pool,
                           PoolLength::splats, true, true},
};

/// Rows of the table.
inline constexpr std::size_t SCENE_POOLS = std::tuple_size_v<decltype(POOL_TABLE)>;

/// Calls visit(row) for each row in order.
template <typename Visit>
void for_each_pool(const Visit& visit) {
  std::apply([&visit](const auto&... rows) { (visit(rows), ...); }, POOL_TABLE);
}

/// Elements of such pools that are not optional in this scene. Begin-End must not be empty.
[[nodiscard]] inline std::size_t pool_length(const Scene& scene, PoolLength length) {
  switch (length) {
    case PoolLength::nodes:
      return scene.node_pool.size();
    case PoolLength::leaf_ends:
      return scene.begin_end.size();
    case PoolLength::leaves:
      return scene.begin_end.size() - 1;
    case PoolLength::references:
      return scene.reference_pool.size();
    case PoolLength::splats:
      return scene.data_pool.size();
  }
  return 0;
}

}  // namespace splatray
