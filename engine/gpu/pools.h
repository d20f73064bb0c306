/// The octree on the device: node pool, Begin-End, slabs, data pool, colour pool and normal fields.
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "engine/gpu/buffer.h"
#include "engine/host/scene.h"

namespace splatray {

/// How shaders read the pools.
enum class PoolAccess {
  automatic,  ///< texel where the device's limits allow it, else storage
  texel,      ///< uniform texel buffers
  storage,    ///< storage buffers
};

/// Bytes on the device, by pool.
struct PoolBytes {
  std::uint64_t node_pool = 0;
  std::uint64_t begin_end = 0;
  std::uint64_t slab_pool = 0;
  std::uint64_t data_pool = 0;
  std::uint64_t color_pool = 0;
  std::uint64_t field_pool = 0;
  std::uint64_t top_table = 0;
  std::uint64_t environment = 0;
  bool texel_buffers = false;  ///< pools are read through texel buffers
};

/// Of all pools and the top table, without the environment.
[[nodiscard]] std::uint64_t total_bytes(const PoolBytes& bytes);

/// What the device allows a pool to be.
struct PoolLimits {
  std::uint64_t texel_elements = 0;    ///< most elements of a texel buffer; 0 where a format is not supported
  std::uint64_t storage_bytes = 0;     ///< largest storage buffer
  std::uint64_t allocation_bytes = 0;  ///< largest allocation
};
[[nodiscard]] PoolLimits pool_limits(const Context& context);

/// How pools of these sizes can be read; never automatic. Throws Error (out_of_memory) naming a pool, its
/// size and the limit when none of the ways that `wanted` allows will do.
[[nodiscard]] PoolAccess choose_access(const PoolBytes& bytes, const PoolLimits& limits, PoolAccess wanted);

/// The uploaded pools; move-only.
struct Pools {
  Pools() = default;
  /// Uploads and waits; throws as choose_access does.
  Pools(const Context& context, CommandQueue& queue, const Scene& scene, PoolAccess wanted);

  PoolAccess access = PoolAccess::storage;  ///< never automatic
  PoolBytes bytes;                          ///< without the environment
  std::array<Buffer, 7> buffers;            ///< in the order of their bindings, from BIND_NODE_POOL on
};

}  // namespace splatray
