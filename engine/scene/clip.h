/// Clip lines: where a splat's disc ends before its rim, at a border or a crease of the surface. shaders/layout.h draws their
/// words.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "shaders/layout.h"

namespace splatray {

/// What a clip line leaves of a disc's plane: the points at such offsets x from the centre, lattice units, that across.x <=
/// limit. Integers and halves, exact.
struct ClipLine {
  glm::dvec3 across;
  double limit;
};

/// The reference implementation of the decoding, in float64; `words` are the splat's.
[[nodiscard]] std::array<ClipLine, 2> unpack_clip(std::uint32_t clip, const uvec4& words);

/// A line that a disc is to end at, root space: it runs through `place`, and the disc loses what lies along `dir`, unit.
struct ClipEdge {
  glm::dvec3 dir;
  glm::dvec3 place;
};

/// The clip lines of a packed splat for at most two edges, of which the disc keeps all that is before them: lines are rounded
/// outwards, by at most 0.05 radii. CLIP_NONE where nothing of the disc is cut off.
[[nodiscard]] std::uint32_t pack_clip(const uvec4& words, std::span<const ClipEdge> edges);

}  // namespace splatray
