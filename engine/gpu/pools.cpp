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

/// What the references refer to, in parts: a whole list beside the buffer would take its memory twice.
template <typename Value>
void upload_listed(CommandQueue& queue, Buffer& buffer, const std::vector<Value>& pool,
                   const std::vector<std::uint32_t>& references) {
  constexpr std::ptrdiff_t PART = std::ptrdiff_t{1} << 18;
  if (pool.empty()) return;
  for (auto part = references.begin(); part != references.end();) {
    const auto end = part + std::min(PART, references.end() - part);
    const std::vector<Value> list = listed(pool, {part, end});
    buffer.upload(queue, std::as_bytes(std::span(list)),
                  static_cast<std::size_t>(part - references.begin()) * sizeof(Value));
    part = end;
  }
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
  PoolBytes copies;
  copies.data_pool = counts.references * sizeof(uvec4);
  const bool storage = access == PoolAccess::storage || limits.texel_elements == 0;
  if (wanted == DataPool::automatic && copies_fit(counts) &&
      !misfit(copies, limits, storage ? PoolAccess::storage : PoolAccess::texel))
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
  const bool lists = copies && !references.empty();
  const auto bytes_listed = [&](const auto& pool) {
    return (lists && !pool.empty() ? references.size() : pool.size()) * sizeof(pool.front());
  };
  bytes.node_pool = std::span(scene.node_pool).size_bytes();
  bytes.begin_end = std::span(scene.begin_end).size_bytes();
  bytes.slab_pool = std::span(scene.slab_pool).size_bytes();
  bytes.reference_pool = copies ? 0 : std::span(references).size_bytes();
  bytes.data_pool = bytes_listed(scene.data_pool);
  bytes.color_pool = bytes_listed(scene.color_pool);
  bytes.field_pool = bytes_listed(scene.field_pool);
  bytes.top_table = std::span(top).size_bytes();
  access = choose_access(bytes, limits, wanted);
  bytes.texel_buffers = access == PoolAccess::texel;
  const VkBufferUsageFlags usage =
      bytes.texel_buffers ? VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT : VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  for (std::size_t i = 0; i < POOLS; ++i) {
    const PoolKind kind = kinds(bytes.references)[i];
    const std::size_t whole_texels = (sizes(bytes)[i] + kind.element_bytes - 1) / kind.element_bytes;
    buffers[i] = Buffer(context, whole_texels * kind.element_bytes, usage,
                        bytes.texel_buffers ? kind.format : VK_FORMAT_UNDEFINED);
  }
  const auto upload = [&](std::uint32_t binding, const auto& pool, bool list) {
    Buffer& buffer = buffers[binding - BIND_NODE_POOL];
    if (list) upload_listed(queue, buffer, pool, references);
    if (!list) buffer.upload(queue, std::as_bytes(std::span(pool)));
  };
  upload(BIND_NODE_POOL, scene.node_pool, false);
  upload(BIND_BEGIN_END, scene.begin_end, false);
  upload(BIND_SLAB_POOL, scene.slab_pool, false);
  if (!copies) upload(BIND_REFERENCE_POOL, references, false);
  upload(BIND_DATA_POOL, scene.data_pool, lists);
  upload(BIND_COLOR_POOL, scene.color_pool, lists);
  upload(BIND_FIELD_POOL, scene.field_pool, lists);
  upload(BIND_TOP_TABLE, top, false);
}

}  // namespace splatray
