/// A splat's disc and clip lines, and the cells that list it by policy `overlap`.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "engine/scene/clip.h"
#include "engine/scene/disc.h"
#include "engine/scene/splat.h"
#include "preprocess/tree/octree.h"

namespace splatray {

struct ListedDisc {
  Disc disc;
  bool clipped = false;
  std::array<ClipLine, 2> lines{};  ///< meant only where it is clipped

  ListedDisc(const SplatList& splats, std::size_t i) : disc(unpack_splat(splats.words[i])) {
    clipped = !splats.clip.empty() && splats.clip[i] != CLIP_NONE;
    if (clipped) lines = unpack_clip(splats.clip[i], splats.words[i]);
  }

  /// Whether the disc comes within LIST_INFLATION of a cell before its clip lines.
  [[nodiscard]] bool is_in(const glm::uvec3& low, std::uint32_t size) const {
    return !(beyond(disc, low, low + size) > 0.0) && !(clipped && cut_off(low, size));
  }

 private:
  /// Whether all of a cell, and LIST_INFLATION around it, is beyond one of the clip lines.
  [[nodiscard]] bool cut_off(const glm::uvec3& low, std::uint32_t size) const {
    const double half = 0.5 * size;
    const glm::dvec3 middle =
        glm::dvec3(low) + half - glm::dvec3(disc.x.center, disc.y.center, disc.z.center);
    for (const ClipLine& line : lines) {
      const glm::dvec3 extent = glm::abs(line.across) * (half + LIST_INFLATION);
      if (glm::dot(line.across, middle) - (extent.x + extent.y + extent.z) > line.limit) return true;
    }
    return false;
  }
};

}  // namespace splatray
