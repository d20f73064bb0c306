#include "engine/scene/copies.h"

#include "engine/scene/texture_factors.h"
#include "engine/scene/tree.h"

namespace splatray {

PoolCounts pool_counts(const Scene& scene) {
  return {scene.data_pool.size(),    scene.reference_pool.size(),
          scene.node_pool.size(),    scene.begin_end.size() - 1,
          !scene.color_pool.empty(), !scene.field_pool.empty(),
          !scene.clip_pool.empty(),  texture_word_count(texture_features(scene.columns))};
}

bool copies_fit(const PoolCounts& counts) {
  constexpr std::uint64_t WORD = sizeof(std::uint32_t);
  const std::uint64_t copy = sizeof(uvec4) + (counts.colors ? WORD : 0) + (counts.fields ? WORD : 0) +
                             (counts.clips ? WORD : 0) + counts.texture_words * WORD;
  const std::uint64_t top_entries = std::uint64_t{1} << 3 * top_levels(counts.splats, counts.filled_leaves);
  const std::uint64_t leaf_words = 2 * counts.filled_leaves + 1;  // Begin-End and slabs
  const std::uint64_t most =
      MOST_SPLAT_BYTES + (counts.clips ? MOST_CLIP_BYTES : 0) + counts.texture_words * MOST_TEXTURE_BYTES;
  return counts.references * copy + (counts.node_words + leaf_words + top_entries) * WORD <=
         most * counts.splats;
}

}  // namespace splatray
