/// Clip lines: where a splat's disc ends before its rim, at a border or a crease of the surface. In place of the second line,
/// ellipses, where points lie in lines. shaders/layout.h draws their words.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "engine/scene/splat.h"
#include "shaders/layout.h"

namespace splatray {

/// What a clip line leaves of a disc's plane: the points at such offsets x from the centre, lattice units, that across.x <=
/// limit. Integers and halves, exact.
struct ClipLine {
  glm::dvec3 across;
  double limit;
};

/// The reference implementation of the decoding, in float64; `words` are the splat's. Beside an ellipse the second line cuts
/// nothing off.
[[nodiscard]] std::array<ClipLine, 2> unpack_clip(std::uint32_t clip, const uvec4& words);

/// A line that a disc is to end at, root space: it runs through `place`, and the disc loses what lies along `dir`, unit.
struct ClipEdge {
  glm::dvec3 dir;
  glm::dvec3 place;
};

/// The clip lines of a packed splat for at most two edges, of which the disc keeps all that is before them: lines are rounded
/// outwards, by at most 0.05 radii. CLIP_NONE where nothing of the disc is cut off.
[[nodiscard]] std::uint32_t pack_clip(const uvec4& words, std::span<const ClipEdge> edges);

/// Whether a splat's word has an ellipse in place of the second line.
[[nodiscard]] constexpr bool is_ellipse(std::uint32_t clip) { return clip >> 24 < CLIP_ZERO; }

/// Whether it has a clip line that cuts something off.
[[nodiscard]] constexpr bool cuts_off(std::uint32_t clip) {
  return is_ellipse(clip) ? (clip & 0xFFFFU) != (CLIP_NONE & 0xFFFFU) : clip != CLIP_NONE;
}

/// An ellipse: the points at such offsets x from the centre that x.x + factor (across.x)^2 <= r^2.
struct Ellipse {
  glm::dvec3 across;
  double factor;
};

/// The same of a word that has one.
[[nodiscard]] Ellipse unpack_ellipse(std::uint32_t clip, const uvec4& words);

/// The line that touches one of its long sides; its opposite touches the other.
[[nodiscard]] ClipLine side_of(const Ellipse& ellipse, const Splat& splat);

/// Aspects below are not worth an ellipse.
inline constexpr double LEAST_ASPECT = 1.5;

/// The word `clip`, with its first line, of a packed splat whose disc is to shrink by `aspect`, 1 or more, along `dir`,
/// a unit vector in root space: rounded outwards, by at most 8 percent of the short axis. `clip` itself where the aspect is
/// below LEAST_ASPECT.
[[nodiscard]] std::uint32_t pack_ellipse(const uvec4& words, const glm::dvec3& dir, double aspect,
                                         std::uint32_t clip = CLIP_NONE);

/// What a pool of clip lines holds.
struct ClipContent {
  bool lines = false;  ///< that cut something off
  bool ellipses = false;
};
[[nodiscard]] ClipContent clip_content(std::span<const std::uint32_t> clips);

}  // namespace splatray
