/// The rows of shaders/pools.glsl as C++ reads them: a scene's pools and their sections in the file, size checks, buffers on the
/// device and names.
#pragma once
#include <cstddef>
#include <cstdint>
#include <tuple>

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

/// What a row says of its pool, beside what shaders need.
struct PoolTraits {
  constexpr PoolTraits(const char* its_name, const char* its_plural, PoolLength its_length)
      : name(its_name), plural(its_plural), length(its_length) {}

  const char* name;    ///< in messages and panels
  const char* plural;  ///< what its elements are
  PoolLength length;
};

/// One pool of a scene. A scene has all or none of a pool that has a feature.
template <typename Value>
struct PoolRow : PoolTraits {
  const char* key;  ///< in JSON
  Pool<Value> Scene::*pool;
  std::uint32_t feature = 0;  ///< FEATURE_*

  [[nodiscard]] constexpr bool optional() const { return feature != 0; }
  /// Whether it is beside the splats: leaves may have copies of it, one for each reference.
  [[nodiscard]] constexpr bool listed() const { return length == PoolLength::splats; }
};

/// In the order of their file sections and of their bindings, from BIND_POOLS on.
inline constexpr auto POOL_TABLE = std::tuple_cat(
#define SPLATRAY_POOL(place, NAME, member, Value, reader, ABOUT) \
  std::tuple{PoolRow<Value>{PoolTraits ABOUT, #member, &Scene::member}},
#define SPLATRAY_OPTIONAL_POOL(place, NAME, member, Value, reader, HAS, bit, ABOUT) \
  std::tuple{PoolRow<Value>{PoolTraits ABOUT, #member, &Scene::member, FEATURE_##HAS}},
#define SPLATRAY_MADE_POOL(place, NAME, member, Value, reader, ABOUT)
#include "shaders/pools.glsl"
    std::tuple<>());

/// Rows of the table.
inline constexpr std::size_t SCENE_POOLS = std::tuple_size_v<decltype(POOL_TABLE)>;

/// Size of a pool's elements.
template <typename Value>
[[nodiscard]] constexpr std::size_t element_bytes(const PoolRow<Value>&) {
  return sizeof(Value);
}

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
