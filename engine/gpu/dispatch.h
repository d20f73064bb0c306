/// The dispatch of a picture's tile, and how large the next ones should be.
#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "engine/device/program.h"
#include "engine/gpu/tiles.h"
#include "shaders/layout.h"

namespace splatray {

/// The dispatch of a picture's tile, and its groups of pixels.
struct TileDispatch {
  Dispatch dispatch;
  std::vector<std::uint32_t> group_list;  ///< BIND_GROUPS

  /// Leaves only those groups of pixels for whose corner, in pixels of the tile, `keeps` is true.
  void keep(const std::function<bool(std::uint32_t x, std::uint32_t y)>& keeps);
  /// Has it trace samples [begin, end) of each pixel.
  void set_samples(std::uint32_t begin, std::uint32_t end);
  /// Has it add the light of lights [begin, end) alone.
  void set_lights(std::uint32_t begin, std::uint32_t end);
};

/// Points a picture's dispatch to a tile. A dispatch of no groups is not needed.
[[nodiscard]] TileDispatch aim(const Dispatch& dispatch, const Tile& tile);

/// Samples of the next dispatch after one of `batch` samples that took `ms`: long enough to hide the cost of a
/// submission, short enough for progress and for drivers that stop long work.
[[nodiscard]] std::uint32_t next_batch(std::uint32_t batch, double ms);

/// Rows of the next dispatch, a multiple of 8 and at most `most` rounded up to one, after one of `rows` rows that took
/// `ms`, so that it takes about `wanted_ms`.
[[nodiscard]] std::uint32_t next_rows(std::uint32_t rows, double ms, double wanted_ms, std::uint32_t most);

}  // namespace splatray
