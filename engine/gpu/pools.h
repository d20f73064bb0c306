/// The octree on the device: node pool, Begin-End, slabs, references, data pool, colour pool and normal fields.
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "engine/gpu/buffer.h"
#include "engine/host/copies.h"

namespace splatray {

/// How shaders read the pools.
enum class PoolAccess {
  automatic,  ///< texel where the device's limits allow it, else storage
  texel,      ///< uniform texel buffers
  storage,    ///< storage buffers
};

/// What the data pool holds, and the colour pool and normal fields beside it.
enum class DataPool {
  automatic,   ///< copies where they fit (engine/host/copies.h) and one buffer of the device holds them
  copies,      ///< a copy of the splat for each reference, leaf by leaf: a test is one fetch
  references,  ///< each splat once; leaves have references: a test is two fetches
  wide_references,  ///< ... four in a texel; what `automatic` takes when there are more than a texel buffer has texels
};

/// Bytes on the device, by pool.
struct PoolBytes {
  std::uint64_t node_pool = 0;
  std::uint64_t begin_end = 0;
  std::uint64_t slab_pool = 0;
  std::uint64_t reference_pool = 0;
  std::uint64_t data_pool = 0;
  std::uint64_t color_pool = 0;
  std::uint64_t field_pool = 0;
  std::uint64_t top_table = 0;
  std::uint64_t environment = 0;
  bool texel_buffers = false;                  ///< pools are read through texel buffers
  std::uint32_t references = REFERENCES_NONE;  ///< REFERENCES_*, how the data pool is read
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

/// How the data pool of such a scene is read, REFERENCES_*, where pools are read as `access` says.
[[nodiscard]] std::uint32_t choose_references(const PoolCounts& counts, const PoolLimits& limits,
                                              PoolAccess access, DataPool wanted);

/// How pools of these sizes can be read; never automatic. Throws Error (out_of_memory) naming a pool, its
/// size and the limit when none of the ways that `wanted` allows will do.
[[nodiscard]] PoolAccess choose_access(const PoolBytes& bytes, const PoolLimits& limits, PoolAccess wanted);

/// The uploaded pools; move-only.
struct Pools {
  Pools() = default;
  /// Uploads and waits; throws as choose_access does.
  Pools(const Context& context, CommandQueue& queue, const Scene& scene, PoolAccess wanted, DataPool data);

  PoolAccess access = PoolAccess::storage;  ///< never automatic
  PoolBytes bytes;                          ///< without the environment
  std::uint32_t top_levels = 0;             ///< of the top table
  std::array<Buffer, 8> buffers;            ///< in the order of their bindings, from BIND_NODE_POOL on
};

}  // namespace splatray
