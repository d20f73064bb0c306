#include "engine/gpu/pools.h"

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <optional>
#include <string>

#include "engine/host/error.h"

namespace splatray {
namespace {

constexpr std::size_t POOLS = std::tuple_size_v<decltype(Pools::buffers)>;

struct PoolKind {
  const char* name;
  VkFormat format;              ///< of its texel buffer
  std::uint64_t element_bytes;  ///< of that format
};

/// In the order of their bindings.
using PoolKinds = std::array<PoolKind, POOLS>;
constexpr PoolKinds KINDS = {{{"node pool", VK_FORMAT_R32_UINT, 4},
                              {"Begin-End", VK_FORMAT_R32_UINT, 4},
                              {"pool of slabs", VK_FORMAT_R32_UINT, 4},
                              {"reference pool", VK_FORMAT_R32_UINT, 4},
                              {"data pool", VK_FORMAT_R32G32B32A32_UINT, 16},
                              {"colour pool", VK_FORMAT_R32_UINT, 4},
                              {"pool of normal fields", VK_FORMAT_R32_UINT, 4},
                              {"top table", VK_FORMAT_R32_UINT, 4}}};

PoolKinds kinds(std::uint32_t references) {
  PoolKinds list = KINDS;
  if (references == REFERENCES_FOUR) {
    PoolKind& pool = list[BIND_REFERENCE_POOL - BIND_NODE_POOL];
    pool.format = VK_FORMAT_R32G32B32A32_UINT;
    pool.element_bytes = 16;
  }
  return list;
}

std::array<std::uint64_t, POOLS> sizes(const PoolBytes& bytes) {
  return {bytes.node_pool, bytes.begin_end,  bytes.slab_pool,  bytes.reference_pool,
          bytes.data_pool, bytes.color_pool, bytes.field_pool, bytes.top_table};
}

std::string mib_text(std::uint64_t bytes) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.1f MiB", static_cast<double>(bytes) / (1024.0 * 1024.0));
  return text;
}

/// Why pools of these sizes cannot be read this way; nothing when they can.
std::optional<std::string> misfit(const PoolBytes& bytes, const PoolLimits& limits, PoolAccess access) {
  for (std::size_t i = 0; i < POOLS; ++i) {
    const PoolKind kind = kinds(bytes.references)[i];
    const std::uint64_t size = sizes(bytes)[i];
    const std::string found = std::string("the ") + kind.name + " has " + mib_text(size) + ", the device's ";
    if (size > limits.allocation_bytes)
      return found + "largest allocation is " + mib_text(limits.allocation_bytes);
    if (access == PoolAccess::storage && size > limits.storage_bytes)
      return found + "largest storage buffer is " + mib_text(limits.storage_bytes);
    if (access == PoolAccess::texel && size / kind.element_bytes > limits.texel_elements)
      return found + "largest texel buffer of its kind is " +
             mib_text(limits.texel_elements * kind.element_bytes);
  }
  return std::nullopt;
}

bool texel_format_supported(const Context& context, VkFormat format) {
  VkFormatProperties properties{};
  vkGetPhysicalDeviceFormatProperties(context.physical_device, format, &properties);
  return (properties.bufferFeatures & VK_FORMAT_FEATURE_UNIFORM_TEXEL_BUFFER_BIT) != 0;
}

}  // namespace

std::uint64_t total_bytes(const PoolBytes& bytes) {
  const auto all = sizes(bytes);
  return std::accumulate(all.begin(), all.end(), std::uint64_t{0});
}

PoolLimits pool_limits(const Context& context) {
  PoolLimits limits;
  const bool texel_formats = texel_format_supported(context, VK_FORMAT_R32_UINT) &&
                             texel_format_supported(context, VK_FORMAT_R32G32B32A32_UINT);
  limits.texel_elements = texel_formats ? context.properties.limits.maxTexelBufferElements : 0;
  limits.storage_bytes = context.properties.limits.maxStorageBufferRange;
  limits.allocation_bytes = context.max_allocation_bytes;
  return limits;
}

std::uint32_t choose_references(const PoolCounts& counts, const PoolLimits& limits, PoolAccess access,
                                DataPool wanted) {
  const bool storage = access == PoolAccess::storage || limits.texel_elements == 0;
  const std::uint64_t buffer_bytes = storage ? limits.storage_bytes : limits.texel_elements * sizeof(uvec4);
  const std::uint64_t most_copies = std::min(buffer_bytes, limits.allocation_bytes) / sizeof(uvec4);
  if (wanted == DataPool::automatic && counts.references <= most_copies && copies_fit(counts))
    wanted = DataPool::copies;
  if (wanted == DataPool::copies) return REFERENCES_NONE;
  const bool wide = wanted == DataPool::wide_references ||
                    (wanted == DataPool::automatic && counts.references > limits.texel_elements);
  return wide ? REFERENCES_FOUR : REFERENCES_ONE;
}

PoolAccess choose_access(const PoolBytes& bytes, const PoolLimits& limits, PoolAccess wanted) {
  const PoolAccess first = wanted == PoolAccess::storage ? PoolAccess::storage : PoolAccess::texel;
  const std::optional<std::string> reason = misfit(bytes, limits, first);
  if (!reason) return first;
  if (wanted == PoolAccess::automatic && !misfit(bytes, limits, PoolAccess::storage))
    return PoolAccess::storage;
  throw Error(ExitCode::out_of_memory, "the scene does not fit the device: " + *reason);
}

Pools::Pools(const Context& context, CommandQueue& queue, const Scene& scene, PoolAccess wanted,
             DataPool data) {
  top_levels = splatray::top_levels(scene.data_pool.size(), scene.slab_pool.size());
  const std::vector<std::uint32_t> top = top_table(scene, top_levels);
  const std::vector<std::uint32_t>& references = scene.reference_pool;
  const PoolLimits limits = pool_limits(context);
  bytes.references = choose_references(pool_counts(scene), limits, wanted, data);
  const bool copies = bytes.references == REFERENCES_NONE;
  const auto splats = copies ? listed(scene.data_pool, references) : std::vector<uvec4>();
  const auto colors = copies ? listed(scene.color_pool, references) : std::vector<std::uint32_t>();
  const auto fields = copies ? listed(scene.field_pool, references) : std::vector<std::uint32_t>();
  const std::array<std::span<const std::byte>, POOLS> sources = {
      std::as_bytes(std::span(scene.node_pool)),
      std::as_bytes(std::span(scene.begin_end)),
      std::as_bytes(std::span(scene.slab_pool)),
      std::as_bytes(std::span(references).first(copies ? 0 : references.size())),
      std::as_bytes(std::span(copies ? splats : scene.data_pool)),
      std::as_bytes(std::span(copies ? colors : scene.color_pool)),
      std::as_bytes(std::span(copies ? fields : scene.field_pool)),
      std::as_bytes(std::span(top))};
  bytes.node_pool = sources[0].size();
  bytes.begin_end = sources[1].size();
  bytes.slab_pool = sources[2].size();
  bytes.reference_pool = sources[3].size();
  bytes.data_pool = sources[4].size();
  bytes.color_pool = sources[5].size();
  bytes.field_pool = sources[6].size();
  bytes.top_table = sources[7].size();
  access = choose_access(bytes, limits, wanted);
  bytes.texel_buffers = access == PoolAccess::texel;
  const VkBufferUsageFlags usage =
      bytes.texel_buffers ? VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT : VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  for (std::size_t i = 0; i < POOLS; ++i) {
    const PoolKind kind = kinds(bytes.references)[i];
    const std::size_t whole_texels = (sources[i].size() + kind.element_bytes - 1) / kind.element_bytes;
    buffers[i] = Buffer(context, whole_texels * kind.element_bytes, usage,
                        bytes.texel_buffers ? kind.format : VK_FORMAT_UNDEFINED);
    buffers[i].upload(queue, sources[i]);
  }
}

}  // namespace splatray
