#include "engine/gpu/pools.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <variant>

#include "engine/base/error.h"
#include "engine/base/number_text.h"

namespace splatray {
namespace {

struct PoolKind {
  const char* name;
  VkFormat format;              ///< of its texel buffer
  std::uint64_t element_bytes;  ///< of that format
};

/// In the order of their bindings.
constexpr std::array<PoolKind, POOLS> KINDS = {{{"node pool", VK_FORMAT_R32_UINT, 4},
                                                {"Begin-End", VK_FORMAT_R32_UINT, 4},
                                                {"pool of slabs", VK_FORMAT_R32_UINT, 4},
                                                {"reference pool", VK_FORMAT_R32_UINT, 4},
                                                {"data pool", VK_FORMAT_R32G32B32A32_UINT, 16},
                                                {"colour pool", VK_FORMAT_R32_UINT, 4},
                                                {"pool of normal fields", VK_FORMAT_R32_UINT, 4},
                                                {"top table", VK_FORMAT_R32_UINT, 4}}};

std::array<std::uint64_t, POOLS> sizes(const PoolBytes& bytes) {
  return {bytes.node_pool, bytes.begin_end,  bytes.slab_pool,  bytes.reference_pool,
          bytes.data_pool, bytes.color_pool, bytes.field_pool, bytes.top_table};
}

/// Most elements of that size in one buffer.
std::uint64_t most_elements(const PoolLimits& limits, PoolAccess access, std::uint64_t element_bytes) {
  const bool texel = access == PoolAccess::texel;
  return std::min(texel ? limits.texel_elements : limits.storage_bytes / element_bytes,
                  limits.allocation_bytes / element_bytes);
}

bool paged(const Paging& paging) { return paging.pages_constant() != 0; }

/// Pools of these sizes read this way, or why they cannot be.
std::variant<Paging, std::string> try_paging(const PoolBytes& bytes, const PoolLimits& limits,
                                             PoolAccess access) {
  const bool texel = access == PoolAccess::texel;
  const std::uint64_t page = std::bit_floor(most_elements(limits, access, sizeof(uvec4)));
  if (page == 0) return std::string("it has no such buffers");
  Paging paging{access};
  std::uint64_t all = 0;
  for (std::size_t i = 0; i < POOLS; ++i) {
    const auto [name, format, element_bytes] = KINDS[i];
    const std::uint64_t elements = sizes(bytes)[i] / element_bytes;
    const bool fits = elements <= most_elements(limits, access, element_bytes);
    const std::uint64_t pages = fits ? 1 : (elements + page - 1) / page;
    if (pages > PAGES_MOST)
      return std::string("the ") + name + " has " + bytes_text(sizes(bytes)[i]) + ", more than " +
             std::to_string(PAGES_MOST) + " of its largest " + (texel ? "texel" : "storage") +
             " buffers with " + bytes_text(page * element_bytes) + " each";
    paging.pages[i] = static_cast<std::uint32_t>(pages);
    all += pages;
  }
  const std::uint32_t most = texel ? limits.texel_buffers : limits.storage_buffers;
  if (all > most)
    return "the pools take " + std::to_string(all) + (texel ? " texel" : " storage") +
           " buffers, a program has room for " + std::to_string(most);
  if (paged(paging)) paging.page_shift = static_cast<std::uint32_t>(std::countr_zero(page));
  return paging;
}

/// The way to read them that choose_paging tells, or why there is none.
std::variant<Paging, std::string> best_paging(const PoolBytes& bytes, const PoolLimits& limits,
                                              PoolAccess wanted) {
  if (wanted != PoolAccess::automatic) return try_paging(bytes, limits, wanted);
  const auto texel = try_paging(bytes, limits, PoolAccess::texel);
  const auto storage = try_paging(bytes, limits, PoolAccess::storage);
  const auto* first = std::get_if<Paging>(&texel);
  const auto* second = std::get_if<Paging>(&storage);
  if (second == nullptr) return texel;
  return first != nullptr && (!paged(*first) || paged(*second)) ? texel : storage;
}

/// What the references refer to, in parts: a whole list beside the buffer would take its memory twice.
template <typename Value>
void upload_listed(CommandQueue& queue, PagedBuffer& buffer, const std::vector<Value>& pool,
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
  const VkPhysicalDeviceLimits& device = context.properties.limits;
  const bool texel_formats = texel_format_supported(context, VK_FORMAT_R32_UINT) &&
                             texel_format_supported(context, VK_FORMAT_R32G32B32A32_UINT);
  const auto beside = [](std::uint32_t of_stage, std::uint32_t of_set, std::uint32_t others) {
    return std::max(std::min(of_stage, of_set), others) - others;
  };
  PoolLimits limits;
  limits.texel_elements = texel_formats ? device.maxTexelBufferElements : 0;
  limits.storage_bytes = device.maxStorageBufferRange;
  limits.allocation_bytes = context.max_allocation_bytes;
  limits.texel_buffers = beside(device.maxPerStageDescriptorSampledImages,
                                device.maxDescriptorSetSampledImages, OTHER_SAMPLED_IMAGES);
  limits.storage_buffers = beside(device.maxPerStageDescriptorStorageBuffers,
                                  device.maxDescriptorSetStorageBuffers, OTHER_STORAGE_BUFFERS);
  return limits;
}

std::uint32_t Paging::pages_constant() const {
  std::uint32_t constant = 0;
  for (std::uint32_t i = 0; i < POOLS; ++i) constant |= (pages[i] - 1) << 4 * i;
  return constant;
}

bool choose_references(const PoolCounts& counts, const PoolLimits& limits, PoolAccess access,
                       DataPool wanted) {
  PoolBytes copies;  // no pool needs pages before the data pool does
  copies.data_pool = counts.references * sizeof(uvec4);
  const auto paging = best_paging(copies, limits, access);
  const auto* ways = std::get_if<Paging>(&paging);
  const bool fit = copies_fit(counts) && ways != nullptr && !paged(*ways);
  return wanted == DataPool::references || (wanted == DataPool::automatic && !fit);
}

Paging choose_paging(const PoolBytes& bytes, const PoolLimits& limits, PoolAccess wanted) {
  const auto best = best_paging(bytes, limits, wanted);
  if (const auto* reason = std::get_if<std::string>(&best))
    throw Error(ExitCode::out_of_memory, "the scene does not fit the device: " + *reason);
  return std::get<Paging>(best);
}

Pools::Pools(const Context& context, CommandQueue& queue, const Scene& scene, const PoolWish& wish,
             Scene* spent) {
  assert(spent == nullptr || spent == &scene);
  top_levels = splatray::top_levels(scene.data_pool.size(), scene.slab_pool.size());
  std::vector<std::uint32_t> top = top_table(scene, top_levels);
  PoolLimits limits = pool_limits(context);
  limits.texel_elements = std::min(limits.texel_elements, wish.page_elements);
  limits.storage_bytes = std::min(limits.storage_bytes / sizeof(uvec4), wish.page_elements) * sizeof(uvec4);
  references = choose_references(pool_counts(scene), limits, wish.access, wish.data);
  const bool lists = !references && !scene.reference_pool.empty();
  const auto bytes_listed = [&](const auto& pool) {
    return (lists && !pool.empty() ? scene.reference_pool.size() : pool.size()) * sizeof(pool.front());
  };
  bytes.node_pool = std::span(scene.node_pool).size_bytes();
  bytes.begin_end = std::span(scene.begin_end).size_bytes();
  bytes.slab_pool = std::span(scene.slab_pool).size_bytes();
  bytes.reference_pool = references ? std::span(scene.reference_pool).size_bytes() : 0;
  bytes.data_pool = bytes_listed(scene.data_pool);
  bytes.color_pool = bytes_listed(scene.color_pool);
  bytes.field_pool = bytes_listed(scene.field_pool);
  bytes.top_table = std::span(top).size_bytes();
  paging = choose_paging(bytes, limits, wish.access);
  bytes.texel_buffers = paging.access == PoolAccess::texel;
  bytes.pages = *std::max_element(paging.pages.begin(), paging.pages.end());
  const VkBufferUsageFlags usage =
      bytes.texel_buffers ? VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT : VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  for (std::size_t i = 0; i < POOLS; ++i) {
    const std::uint64_t page =
        paging.pages[i] > 1 ? KINDS[i].element_bytes << paging.page_shift : VK_WHOLE_SIZE;
    buffers[i] = PagedBuffer(context, sizes(bytes)[i], page, usage,
                             bytes.texel_buffers ? KINDS[i].format : VK_FORMAT_UNDEFINED);
  }
  const auto upload = [&](std::uint32_t binding, const auto& pool, bool list) {
    PagedBuffer& buffer = buffers[binding - BIND_NODE_POOL];
    if (list)
      upload_listed(queue, buffer, pool, scene.reference_pool);
    else
      buffer.upload(queue, std::as_bytes(std::span(pool)));
  };
  const auto upload_pool = [&](std::uint32_t binding, auto pool, bool list) {
    upload(binding, scene.*pool, list);
    if (spent != nullptr) std::exchange(spent->*pool, {});
  };
  upload(BIND_TOP_TABLE, top, false);
  std::exchange(top, {});
  upload_pool(BIND_NODE_POOL, &Scene::node_pool, false);
  upload_pool(BIND_BEGIN_END, &Scene::begin_end, false);
  upload_pool(BIND_SLAB_POOL, &Scene::slab_pool, false);
  if (references) upload_pool(BIND_REFERENCE_POOL, &Scene::reference_pool, false);
  upload_pool(BIND_DATA_POOL, &Scene::data_pool, lists);
  upload_pool(BIND_COLOR_POOL, &Scene::color_pool, lists);
  upload_pool(BIND_FIELD_POOL, &Scene::field_pool, lists);
  if (spent != nullptr) std::exchange(spent->reference_pool, {});  // lists were made from it
}

}  // namespace splatray
