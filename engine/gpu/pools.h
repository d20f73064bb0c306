/// The octree on the device: node pool, Begin-End, slabs, references, data pool, colours, normal fields, clip lines and texture
/// words.
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "engine/device/device.h"
#include "engine/device/paged_buffer.h"
#include "engine/scene/pool/copies.h"

namespace splatray {

/// What the data pool holds, and the colour pool and normal fields beside it.
enum class DataPool {
  /// Copies where they fit (engine/scene/pool/copies.h) and one buffer holds them: splitting costs what they gain.
  automatic,
  copies,      ///< a copy of the splat for each reference, leaf by leaf: a test is one fetch
  references,  ///< each splat once; leaves have references: a test is two fetches
};

/// How the pools are to be held. Anything but automatic is for tests and benchmarks.
struct PoolRequest {
  DataPool data = DataPool::automatic;
  std::uint64_t page_elements = UINT64_MAX;  ///< most elements of the data pool in a page
};

/// Bytes on the device.
struct PoolBytes {
  std::array<std::uint64_t, POOLS> pools{};  ///< in the order of their bindings, from BIND_POOLS on
  std::uint64_t environment = 0;
  std::uint64_t frame = 0;  ///< picture, AOVs, ray queries: as large as pictures are
  std::uint32_t pages = 0;  ///< of the pool with most

  /// Bytes of the pool with this binding.
  [[nodiscard]] std::uint64_t& at(std::uint32_t binding) { return pools[binding - BIND_POOLS]; }
  [[nodiscard]] std::uint64_t at(std::uint32_t binding) const { return pools[binding - BIND_POOLS]; }
};

/// What pools are called and made of, in the order of their bindings.
struct PoolKind {
  const char* name;             ///< in messages and panels
  const char* key;              ///< in JSON
  std::uint64_t element_bytes;  ///< 4 or 16
};
[[nodiscard]] const std::array<PoolKind, POOLS>& pool_kinds();

/// Sum over all pools and the top table, without environment and frame.
[[nodiscard]] std::uint64_t total_bytes(const PoolBytes& bytes);

/// Whether the data pool of such a scene is read through references.
[[nodiscard]] bool choose_references(const PoolCounts& counts, const DeviceLimits& limits, DataPool wanted);

/// How many buffers pools of these sizes take. Throws Error (out_of_memory) naming a pool, its size and the limit where they
/// do not fit.
[[nodiscard]] Paging choose_paging(const PoolBytes& bytes, const DeviceLimits& limits);

/// What a scene's pools are on a device, known before they are there.
struct PoolPlan {
  PoolPlan() = default;
  /// Throws as choose_paging does.
  PoolPlan(const DeviceLimits& device_limits, const Scene& scene, const PoolRequest& request);

  Paging paging;
  PoolBytes bytes;                     ///< without environment and frame
  bool references = false;             ///< the data pool is read through the reference pool
  std::uint32_t features = 0;          ///< FEATURE_* of the optional pools that the scene has
  std::uint32_t top_levels = 0;        ///< of the top table
  std::uint32_t texture_features = 0;  ///< texture_features() of the scene
};

/// The uploaded pools, in the order of their bindings, from BIND_POOLS on.
using PoolBuffers = std::array<PagedBuffer, POOLS>;
/// Uploads a scene's pools as planned, and waits. What the queue takes where it lies is not copied. `spent` is null or the scene itself,
/// whose pools are then freed, each as soon as it is on the device; after an Error some of them may be gone.
[[nodiscard]] PoolBuffers upload_pools(Queue& queue, const PoolPlan& plan, const Scene& scene,
                                       Scene* spent = nullptr);

}  // namespace splatray
