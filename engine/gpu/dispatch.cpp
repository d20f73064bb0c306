#include "engine/gpu/dispatch.h"

#include <algorithm>

namespace splatray {
namespace {

constexpr double DISPATCH_MS = 200.0;
/// Most times larger than the one before: its time may have been a start-up's.
constexpr double GROWTH = 4.0;

}  // namespace

std::uint32_t groups(std::uint32_t threads, std::uint32_t group) { return (threads + group - 1) / group; }

void aim(Dispatch& dispatch, const Tile& tile) {
  dispatch.frame.tile_x = tile.x;
  dispatch.frame.tile_y = tile.y;
  dispatch.frame.tile_width = tile.width;
  dispatch.frame.tile_height = tile.height;
  const bool linear = dispatch.constants[SPEC_ORDER] == ORDER_LINEAR;
  dispatch.groups_x = groups(tile.width, linear ? GROUP_SIZE : 8);
  dispatch.groups_y = linear ? tile.height : groups(tile.height, 8);
}

std::uint32_t next_batch(std::uint32_t batch, double ms) {
  const double wanted = batch * DISPATCH_MS / std::max(ms, 1e-3);
  return static_cast<std::uint32_t>(std::clamp(wanted, 1.0, batch * GROWTH));
}

std::uint32_t next_rows(std::uint32_t rows, double ms, double wanted_ms, std::uint32_t most) {
  const double wanted = std::min(rows * wanted_ms / std::max(ms, 1e-3), rows * GROWTH);
  return std::clamp(static_cast<std::uint32_t>(wanted) / 8 * 8, 8U, (most + 7) / 8 * 8);
}

}  // namespace splatray
