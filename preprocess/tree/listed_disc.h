/// A splat's disc, clip lines and ellipse, and the cells that list it by policy `overlap`.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "engine/scene/clip.h"
#include "engine/scene/leaf/disc.h"
#include "engine/scene/splat.h"
#include "preprocess/tree/octree.h"

namespace splatray {

struct ListedDisc {
  Disc disc;
  std::size_t line_count = 0;
  std::array<ClipLine, 3> lines{};  ///< clip lines, and those along an ellipse's long sides

  ListedDisc(const SplatList& splats, std::size_t i) : disc(unpack_splat(splats.words[i])) {
    if (!splats.clip.empty() && splats.clip[i] != CLIP_NONE) find_lines(splats.clip[i], splats.words[i]);
  }

  /// Whether the disc comes within LIST_INFLATION of a cell before its lines.
  [[nodiscard]] bool is_in(const glm::uvec3& low, std::uint32_t size) const {
    return !(beyond(disc, low, low + size) > 0.0) && !cut_off(low, size);
  }

 private:
  void find_lines(std::uint32_t clip, const uvec4& words) {
    const std::array<ClipLine, 2> two = unpack_clip(clip, words);
    lines = {two[0], two[1]};
    line_count = 2;
    if (!is_ellipse(clip)) return;
    const ClipLine side = side_of(unpack_ellipse(clip, words), unpack_splat(words));
    lines[1] = side;
    lines[2] = {-side.across, side.limit};
    line_count = 3;
  }

  /// Whether all of a cell, and LIST_INFLATION around it, is beyond one of the lines.
  [[nodiscard]] bool cut_off(const glm::uvec3& low, std::uint32_t size) const {
    const double half = 0.5 * size;
    const glm::dvec3 middle =
        glm::dvec3(low) + half - glm::dvec3(disc.x.center, disc.y.center, disc.z.center);
    for (std::size_t i = 0; i < line_count; ++i) {
      const ClipLine& line = lines[i];
      const glm::dvec3 extent = glm::abs(line.across) * (half + LIST_INFLATION);
      if (glm::dot(line.across, middle) - (extent.x + extent.y + extent.z) > line.limit) return true;
    }
    return false;
  }
};

}  // namespace splatray
