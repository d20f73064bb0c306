#include "engine/gpu/pools.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <numeric>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include "engine/base/all_cores.h"
#include "engine/base/error.h"
#include "engine/base/number_text.h"
#include "engine/scene/pool/pool_table.h"
#include "engine/scene/texture_factors.h"
#include "engine/scene/tree.h"

namespace splatray {
namespace {

constexpr std::array PLACES = {
#define SPLATRAY_POOL(place, NAME, pool, Value, reader, ABOUT) place,
#include "shaders/pools.glsl"
};
static_assert(
    [] {
      for (std::uint32_t i = 0; i < POOLS; ++i)
        if (PLACES[i] != i) return false;
      return true;
    }(),
    "the places of shaders/pools.glsl do not count its rows");

/// Most elements of that size in one buffer.
std::uint64_t most_elements(const DeviceLimits& limits, std::uint64_t element_bytes) {
  return std::min(limits.storage_bytes, limits.allocation_bytes) / element_bytes;
}

/// In how many buffers pools of these sizes are, or why they cannot be.
std::variant<Paging, std::string> try_paging(const PoolBytes& bytes, const DeviceLimits& limits) {
  const std::uint64_t page = std::bit_floor(most_elements(limits, sizeof(uvec4)));
  Paging paging;
  std::uint64_t all = 0;
  for (std::size_t i = 0; i < POOLS; ++i) {
    const auto [name, key, element_bytes] = pool_kinds()[i];
    const std::uint64_t elements = bytes.pools[i] / element_bytes;
    const bool fits = elements <= most_elements(limits, element_bytes);
    const std::uint64_t pages = fits ? 1 : (elements + page - 1) / page;
    if (pages > PAGES_MOST)
      return std::string("the ") + name + " has " + bytes_text(bytes.pools[i]) + ", more than " +
             std::to_string(PAGES_MOST) + " of its largest buffers with " + bytes_text(page * element_bytes) +
             " each";
    paging.pages[i] = static_cast<std::uint32_t>(pages);
    all += pages;
  }
  if (all > limits.storage_buffers)
    return "the pools take " + std::to_string(all) + " buffers, a program has room for " +
           std::to_string(limits.storage_buffers);
  if (paging.paged()) paging.page_shift = static_cast<std::uint32_t>(std::countr_zero(page));
  return paging;
}

/// Uploads the pool gathered by `references` in parts: a whole list beside the buffer would take its memory twice.
template <typename Value>
void upload_listed(Queue& queue, PagedBuffer& buffer, const Pool<Value>& pool,
                   std::span<const std::uint32_t> references) {
  constexpr std::size_t PART = std::size_t{1} << 18U, SLICE = std::size_t{1} << 14U;
  if (pool.empty()) return;
  std::vector<Value> list(std::min(PART, references.size()));
  for (std::size_t begin = 0; begin < references.size(); begin += PART) {
    const std::span<const std::uint32_t> part =
        references.subspan(begin, std::min(PART, references.size() - begin));
    on_all_cores((part.size() + SLICE - 1) / SLICE, [&](std::size_t slice) {
      const std::size_t end = std::min((slice + 1) * SLICE, part.size());
      for (std::size_t i = slice * SLICE; i < end; ++i) list[i] = pool[part[i]];
    });
    buffer.upload(queue, std::as_bytes(std::span(list).first(part.size())), begin * sizeof(Value));
  }
}

/// A pool as it is.
template <typename Value>
PagedBuffer upload_whole(Queue& queue, const Pool<Value>& pool, std::uint64_t page_bytes) {
  const auto bytes = std::as_bytes(std::span(pool));
  if (std::unique_ptr<Buffer> lent = queue.lend(bytes, pool.keeper())) return PagedBuffer(std::move(lent));
  PagedBuffer buffer(queue, bytes.size(), page_bytes);
  buffer.upload(queue, bytes);
  return buffer;
}

/// The splats' words, in the order of `references` or, where that is empty, of the splats.
void upload_textures(Queue& queue, PagedBuffer& buffer, const Scene& scene,
                     std::span<const std::uint32_t> references) {
  constexpr std::size_t PART = std::size_t{1} << 18;
  const std::size_t all = references.empty() ? scene.data_pool.size() : references.size();
  std::vector<std::uint32_t> splats;
  std::size_t offset = 0;
  for (std::size_t begin = 0; begin < all; begin += PART) {
    splats.resize(std::min(PART, all - begin));
    if (references.empty())
      std::iota(splats.begin(), splats.end(), static_cast<std::uint32_t>(begin));
    else
      std::copy_n(references.begin() + static_cast<std::ptrdiff_t>(begin), splats.size(), splats.begin());
    const std::vector<std::uint32_t> words = texture_words(scene.columns, splats);
    buffer.upload(queue, std::as_bytes(std::span(words)), offset);
    offset += std::span(words).size_bytes();
  }
}

}  // namespace

const std::array<PoolKind, POOLS>& pool_kinds() {
  static constexpr std::array<PoolKind, POOLS> KINDS = {{
#define SPLATRAY_POOL(place, NAME, pool, Value, reader, ABOUT) {PoolTraits ABOUT.name, #pool, sizeof(Value)},
#include "shaders/pools.glsl"
  }};
  return KINDS;
}

std::uint64_t total_bytes(const PoolBytes& bytes) {
  return std::accumulate(bytes.pools.begin(), bytes.pools.end(), std::uint64_t{0});
}

bool choose_references(const PoolCounts& counts, const DeviceLimits& limits, DataPool wanted) {
  PoolBytes copies;  // no pool needs pages before the data pool does
  copies.at(BIND_DATA_POOL) = counts.references * sizeof(uvec4);
  const auto paging = try_paging(copies, limits);
  const auto* ways = std::get_if<Paging>(&paging);
  const bool fit = copies_fit(counts) && ways != nullptr && !ways->paged();
  return wanted == DataPool::references || (wanted == DataPool::automatic && !fit);
}

Paging choose_paging(const PoolBytes& bytes, const DeviceLimits& limits) {
  const auto paging = try_paging(bytes, limits);
  if (const auto* reason = std::get_if<std::string>(&paging))
    throw Error(ExitCode::out_of_memory, "the scene does not fit the device: " + *reason);
  return std::get<Paging>(paging);
}

PoolPlan::PoolPlan(const DeviceLimits& device_limits, const Scene& scene, const PoolRequest& request) {
  top_levels = splatray::top_levels(scene.data_pool.size(), scene.slab_pool.size());
  DeviceLimits limits = device_limits;
  limits.storage_bytes =
      std::min(limits.storage_bytes / sizeof(uvec4), request.page_elements) * sizeof(uvec4);
  references = choose_references(pool_counts(scene), limits, request.data);
  const std::size_t listed = references ? 0 : scene.reference_pool.size();
  std::uint32_t binding = BIND_POOLS;
  for_each_pool([&](const auto& row) {
    const auto& pool = scene.*row.pool;
    const bool absent = pool.empty() || (binding == BIND_REFERENCE_POOL && !references);
    const std::size_t elements = absent ? 0 : listed > 0 && row.listed() ? listed : pool.size();
    bytes.at(binding++) = elements * element_bytes(row);
    if (elements > 0) features |= row.feature;
  });
  texture_features = splatray::texture_features(scene.columns);
  bytes.at(BIND_TEXTURE_POOL) = (listed > 0 ? listed : scene.data_pool.size()) *
                                texture_word_count(texture_features) * sizeof(std::uint32_t);
  bytes.at(BIND_TOP_TABLE) = (std::uint64_t{1} << 3 * top_levels) * sizeof(std::uint32_t);
  paging = choose_paging(bytes, limits);
  bytes.pages = *std::max_element(paging.pages.begin(), paging.pages.end());
}

PoolBuffers upload_pools(Queue& queue, const PoolPlan& plan, const Scene& scene, Scene* spent) {
  assert(spent == nullptr || spent == &scene);
  const auto list = plan.references ? std::span<const std::uint32_t>()
                                    : std::span<const std::uint32_t>(scene.reference_pool);
  const bool lists = !list.empty();
  const auto page_bytes = [&](std::uint32_t binding) {
    const std::size_t i = binding - BIND_POOLS;
    return plan.paging.pages[i] > 1 ? pool_kinds()[i].element_bytes << plan.paging.page_shift : UINT64_MAX;
  };
  const auto make = [&](std::uint32_t binding) {
    return PagedBuffer(queue, plan.bytes.at(binding), page_bytes(binding));
  };
  PoolBuffers buffers;
  buffers.back() = make(BIND_TOP_TABLE);
  buffers.back().upload(queue,
                        std::as_bytes(std::span<const std::uint32_t>(top_table(scene, plan.top_levels))));
  PagedBuffer& textures = buffers[BIND_TEXTURE_POOL - BIND_POOLS];
  textures = make(BIND_TEXTURE_POOL);
  if (plan.texture_features != 0) upload_textures(queue, textures, scene, list);
  std::uint32_t binding = BIND_POOLS;
  for_each_pool([&](const auto& row) {
    PagedBuffer& buffer = buffers[binding - BIND_POOLS];
    const bool any = plan.bytes.at(binding) > 0, whole = any && !(lists && row.listed());
    buffer = whole ? upload_whole(queue, scene.*row.pool, page_bytes(binding)) : make(binding);
    if (any && !whole) upload_listed(queue, buffer, scene.*row.pool, list);
    if (spent != nullptr && binding != BIND_REFERENCE_POOL) std::exchange(spent->*row.pool, {});
    ++binding;
  });
  if (spent != nullptr) std::exchange(spent->reference_pool, {});  // lists were made from it
  return buffers;
}

}  // namespace splatray
