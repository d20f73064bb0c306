/// The dispatches of a picture's tile, and how large the next ones should be.
#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "engine/device/program.h"
#include "engine/gpu/features.h"
#include "engine/gpu/tiles.h"
#include "engine/image/footprint.h"
#include "shaders/layout.h"

namespace splatray {

/// The dispatches of a picture's tile: of the groups of pixels that may see something, and of the rest.
struct TileDispatch {
  Dispatch seen, empty;
  std::vector<std::uint32_t> group_list;  ///< of both (BIND_GROUPS)

  /// Leaves only those groups of pixels for whose corner, in pixels of the tile, `keeps` is true.
  void keep(const std::function<bool(std::uint32_t x, std::uint32_t y)>& keeps);
  /// Has them trace samples [begin, end) of each pixel, whose mean runs from sample `mean_begin` on.
  void set_samples(std::uint32_t begin, std::uint32_t end);
  void set_mean_begin(std::uint32_t mean_begin);
  /// Has them add the light of lights [begin, end) alone.
  void set_lights(std::uint32_t begin, std::uint32_t end);
};

/// Points a picture's dispatch to a tile. A dispatch of no groups is not needed.
[[nodiscard]] TileDispatch aim(const Dispatch& dispatch, const Tile& tile, const Footprint& footprint);

/// Samples of the next dispatch after one of `batch` samples that took `ms`: long enough to hide the cost of a
/// submission, short enough for progress and for drivers that stop long work.
[[nodiscard]] std::uint32_t next_batch(std::uint32_t batch, double ms);

/// Rows of the next dispatch, a multiple of 8 and at most `most` rounded up to one, after one of `rows` rows that took
/// `ms`, so that it takes about `wanted_ms`.
[[nodiscard]] std::uint32_t next_rows(std::uint32_t rows, double ms, double wanted_ms, std::uint32_t most);

}  // namespace splatray
