/// The splats that rays through the pixels of a tile may meet, gathered once for all of the rays: neighbours visit the same nodes and
/// leaves, and most splats of a leaf lie in few of the pixels. Plain data alone, as in wide_walk.h.
#pragma once
#include "engine/cpu/wide/wide_walk.h"

namespace splatray {

/// Pixels of a tile, at most.
inline constexpr std::uint32_t TILE_SLOTS = 64;
/// Parts of the lists of a tile's pixels, and boxes that are known and not looked into, at most. A tile that wants more is left to the walk
/// of single rays.
inline constexpr std::uint32_t TILE_PARTS = 1024, TILE_BOXES = 1024;

/// Some of the splats of a pixel's list.
struct alignas(64) WidePart {
  WideDiscs discs;
  WideWords splat;     ///< their numbers in the data pool
  float nearest;       ///< least depth of them
  std::uint32_t next;  ///< the pixel's next part, behind a full one
};

/// What gathers the splats of a tile, the nearest boxes of the tree first. Depths are lengths along `ahead` from `middle`, lattice units.
/// A point p is seen at x = scale[0] * dot(right, p - middle) / w and y likewise, pixels from the tile's middle, with
/// w = w_begin + dot(w_ahead, p - middle).
struct WideTile {
  std::array<float, 3> middle;  ///< where the tile's middle ray begins, root space
  std::array<float, 3> right, down, ahead, w_ahead;
  float w_begin;
  std::array<float, 2> scale;
  float slack;  ///< lattice units: more than float32 takes from any length here
  /// What pixel i of a row sees lies at x in [first[0] + i, last[0] + i], pixels from the middle; rows likewise.
  std::array<float, 2> first, last;
  std::uint32_t width, height;  ///< pixels; their product is at most TILE_SLOTS
  /// Planes whose product with (p - middle, 1) is at least 0 for all points seen.
  std::array<std::array<float, 4>, 5> planes;

  bool full;            ///< there was more than it has room for: its lists are not whole
  std::uint32_t boxes;  ///< known and not looked into: a heap, the nearest first
  std::uint32_t parts;  ///< in use
  /// Splats of each pixel's list, its first part and its last.
  std::array<std::uint32_t, TILE_SLOTS> count, begin, end;
  std::array<WideBox, TILE_BOXES> box;
  std::array<WidePart, TILE_PARTS> part;
};

/// Where a ray is in its pixel's list.
struct WideCursor {
  std::uint32_t slot;      ///< of the pixel
  float begin, per_t;      ///< its depth at t is begin + per_t * t
  std::uint32_t seen = 0;  ///< splats tested
  std::uint32_t part = 0;  ///< that the last step went to
};

/// Begins a tile whose camera is set: its lists are empty.
using WideOpener = void (*)(const WideView& tree, WideTile& tile);

/// Goes on in the pixel's list, which it gathers as far as the ray reaches, to the next part where the ray meets discs with t in
/// [t_min, t_max), and reports them as WideStepper does. 0: the list has ended, or the tile is full.
using WideTileStepper = std::uint32_t (*)(const WideView& tree, WideTile& tile, WideCursor& cursor,
                                          WideWalk& walk);

}  // namespace splatray
