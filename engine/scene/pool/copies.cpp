#include "engine/scene/pool/copies.h"

#include "engine/scene/pool/pool_table.h"
#include "engine/scene/texture_factors.h"
#include "engine/scene/tree.h"

namespace splatray {

PoolCounts pool_counts(const Scene& scene) {
  PoolCounts counts{pool_length(scene, PoolLength::splats), pool_length(scene, PoolLength::references),
                    pool_length(scene, PoolLength::nodes), pool_length(scene, PoolLength::leaves)};
  for_each_pool([&](const auto& row) { counts.pools |= (scene.*row.pool).empty() ? 0 : row.feature; });
  counts.texture_words = texture_word_count(texture_features(scene.columns));
  return counts;
}

bool copies_fit(const PoolCounts& counts) {
  constexpr std::uint64_t WORD = sizeof(std::uint32_t);
  const bool clips = (counts.pools & FEATURE_CLIPS) != 0;
  std::uint64_t copy = counts.texture_words * WORD;
  for_each_pool([&](const auto& row) {
    const bool there = !row.optional() || (counts.pools & row.feature) != 0;
    if (row.listed() && there) copy += element_bytes(row);
  });
  const std::uint64_t top_entries = std::uint64_t{1} << 3 * top_levels(counts.splats, counts.filled_leaves);
  const std::uint64_t leaf_words = 2 * counts.filled_leaves + 1;  // Begin-End and slabs
  const std::uint64_t most =
      MOST_SPLAT_BYTES + (clips ? MOST_CLIP_BYTES : 0) + counts.texture_words * MOST_TEXTURE_BYTES;
  return counts.references * copy + (counts.node_words + leaf_words + top_entries) * WORD <=
         most * counts.splats;
}

}  // namespace splatray
