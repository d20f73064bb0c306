/// Whether a device has room for copies of a scene's splats.
#pragma once
#include <cstddef>
#include <cstdint>

#include "engine/scene/scene.h"

namespace splatray {

/// How much a scene's pools hold.
struct PoolCounts {
  std::size_t splats = 0;
  std::size_t references = 0;
  std::size_t node_words = 0;
  std::size_t filled_leaves = 0;
  std::uint32_t pools = 0;          ///< FEATURE_* of the optional pools there are
  std::uint32_t texture_words = 0;  ///< of each splat
};
[[nodiscard]] PoolCounts pool_counts(const Scene& scene);

/// Most bytes on a device for each splat, if leaves are to have copies of their splats.
inline constexpr std::uint64_t MOST_SPLAT_BYTES = 64;
/// And as many more where splats have clip lines.
inline constexpr std::uint64_t MOST_CLIP_BYTES = 8;
/// And for each texture word, so that scenes whose copies fit without textures have them with textures too.
inline constexpr std::uint64_t MOST_TEXTURE_BYTES = 13;

/// Whether all pools and the top table stay within MOST_SPLAT_BYTES, and MOST_CLIP_BYTES and MOST_TEXTURE_BYTES where there are
/// clip lines and texture words, with a copy of a splat and all that is beside it for each reference. Through references
/// instead a test is two fetches, and a splat takes about 40 bytes.
[[nodiscard]] bool copies_fit(const PoolCounts& counts);

}  // namespace splatray
