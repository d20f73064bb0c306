#include "engine/gpu/dispatch.h"

#include <algorithm>

namespace splatray {
namespace {

constexpr double DISPATCH_MS = 200.0;
/// Most times larger than the one before: its time may have been a start-up's.
constexpr double GROWTH = 4.0;

/// Pixels of a group, across and down.
struct GroupPixels {
  std::uint32_t width, height;
};
GroupPixels group_pixels(const Dispatch& dispatch) {
  return dispatch.constants[SPEC_ORDER] == ORDER_LINEAR ? GroupPixels{GROUP_SIZE, 1} : GroupPixels{8, 8};
}

}  // namespace

void TileDispatch::keep(const std::function<bool(std::uint32_t x, std::uint32_t y)>& keeps) {
  const GroupPixels pixels = group_pixels(dispatch);
  std::erase_if(group_list, [&](std::uint32_t group) {
    return !keeps((group & 0xFFFFU) * pixels.width, (group >> 16U) * pixels.height);
  });
  dispatch.frame.group_count = static_cast<std::uint32_t>(group_list.size());
  dispatch.set_groups(dispatch.frame.group_count);
}

void TileDispatch::set_samples(std::uint32_t begin, std::uint32_t end) {
  dispatch.frame.sample_begin = begin;
  dispatch.frame.sample_end = end;
}

void TileDispatch::set_lights(std::uint32_t begin, std::uint32_t end) {
  dispatch.frame.light_begin = begin;
  dispatch.frame.light_end = end;
}

TileDispatch aim(const Dispatch& dispatch, const Tile& tile) {
  const GroupPixels pixels = group_pixels(dispatch);
  TileDispatch aimed{dispatch, {}};
  for (std::uint32_t y = 0; y < groups(tile.height, pixels.height); ++y)
    for (std::uint32_t x = 0; x < groups(tile.width, pixels.width); ++x)
      aimed.group_list.push_back(x | y << 16);
  FrameParams& frame = aimed.dispatch.frame;
  frame.tile_x += tile.x;
  frame.tile_y += tile.y;
  frame.tile_width = tile.width;
  frame.tile_height = tile.height;
  frame.group_count = static_cast<std::uint32_t>(aimed.group_list.size());
  aimed.dispatch.set_groups(frame.group_count);
  return aimed;
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
