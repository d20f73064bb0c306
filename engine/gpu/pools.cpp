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

/// What the references refer to, one after the other, in parts: a whole list beside the buffer would take its memory twice.
template <typename Value>
void upload_listed(CommandQueue& queue, Buffer& buffer, const std::vector<Value>& pool,
                   std::span<const std::uint32_t> references) {
  constexpr std::size_t PART = std::size_t{1} << 18U;
  std::vector<Value> part;
  part.reserve(std::min(PART, references.size()));
  for (std::size_t at = 0; at < references.size(); at += part.size()) {
    part.clear();
    for (const std::uint32_t i : references.subspan(at, std::min(PART, references.size() - at)))
      part.push_back(pool[i]);
    buffer.upload(queue, std::as_bytes(std::span(part)), at * sizeof(Value));
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
  const bool lists = copies && !references.empty();
  const std::array<std::span<const std::byte>, POOLS> sources = {
      std::as_bytes(std::span(scene.node_pool)),
      std::as_bytes(std::span(scene.begin_end)),
      std::as_bytes(std::span(scene.slab_pool)),
      std::as_bytes(std::span(references).first(copies ? 0 : references.size())),
      std::as_bytes(std::span(scene.data_pool)),
      std::as_bytes(std::span(scene.color_pool)),
      std::as_bytes(std::span(scene.field_pool)),
      std::as_bytes(std::span(top))};
  const auto bytes_of = [&](std::uint32_t binding) {
    const std::size_t pool = binding - BIND_NODE_POOL;
    const bool listed =
        lists && !sources[pool].empty() &&
        (binding == BIND_DATA_POOL || binding == BIND_COLOR_POOL || binding == BIND_FIELD_POOL);
    return listed ? references.size() * KINDS[pool].element_bytes : sources[pool].size();
  };
  bytes.node_pool = bytes_of(BIND_NODE_POOL);
  bytes.begin_end = bytes_of(BIND_BEGIN_END);
  bytes.slab_pool = bytes_of(BIND_SLAB_POOL);
  bytes.reference_pool = bytes_of(BIND_REFERENCE_POOL);
  bytes.data_pool = bytes_of(BIND_DATA_POOL);
  bytes.color_pool = bytes_of(BIND_COLOR_POOL);
  bytes.field_pool = bytes_of(BIND_FIELD_POOL);
  bytes.top_table = bytes_of(BIND_TOP_TABLE);
  access = choose_access(bytes, limits, wanted);
  bytes.texel_buffers = access == PoolAccess::texel;
  const VkBufferUsageFlags usage =
      bytes.texel_buffers ? VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT : VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  for (std::size_t i = 0; i < POOLS; ++i) {
    const PoolKind kind = kinds(bytes.references)[i];
    const std::size_t size = sizes(bytes)[i];
    const std::size_t whole_texels = (size + kind.element_bytes - 1) / kind.element_bytes;
    buffers[i] = Buffer(context, whole_texels * kind.element_bytes, usage,
                        bytes.texel_buffers ? kind.format : VK_FORMAT_UNDEFINED);
    if (size == sources[i].size()) buffers[i].upload(queue, sources[i]);
  }
  if (!lists) return;
  upload_listed(queue, buffers[BIND_DATA_POOL - BIND_NODE_POOL], scene.data_pool, references);
  if (bytes.color_pool > 0)
    upload_listed(queue, buffers[BIND_COLOR_POOL - BIND_NODE_POOL], scene.color_pool, references);
  if (bytes.field_pool > 0)
    upload_listed(queue, buffers[BIND_FIELD_POOL - BIND_NODE_POOL], scene.field_pool, references);
}

}  // namespace splatray
