#include "engine/gpu/dispatch.h"

#include <algorithm>
#include <iterator>

namespace splatray {
namespace {

constexpr double DISPATCH_MS = 200.0;
/// Most times larger than the one before: its time may have been a start-up's.
constexpr double GROWTH = 4.0;

}  // namespace

void TileDispatch::keep(const std::function<bool(std::uint32_t x, std::uint32_t y)>& keeps) {
  const bool linear = seen.constants[SPEC_ORDER] == ORDER_LINEAR;
  const std::uint32_t width = linear ? GROUP_SIZE : 8, height = linear ? 1 : 8;
  std::vector<std::uint32_t> kept;
  for (Dispatch* part : {&seen, &empty}) {
    const auto first = group_list.begin() + part->frame.first_group;
    part->frame.first_group = static_cast<std::uint32_t>(kept.size());
    std::copy_if(first, first + part->frame.group_count, std::back_inserter(kept), [&](std::uint32_t group) {
      return keeps((group & 0xFFFFU) * width, (group >> 16U) * height);
    });
    part->frame.group_count = static_cast<std::uint32_t>(kept.size()) - part->frame.first_group;
    part->set_groups(part->frame.group_count);
  }
  group_list = std::move(kept);
}

void TileDispatch::set_samples(std::uint32_t begin, std::uint32_t end) {
  for (Dispatch* part : {&seen, &empty}) {
    part->frame.sample_begin = begin;
    part->frame.sample_end = end;
  }
}

void TileDispatch::set_mean_begin(std::uint32_t mean_begin) {
  for (Dispatch* part : {&seen, &empty}) part->frame.mean_begin = mean_begin;
}

void TileDispatch::set_lights(std::uint32_t begin, std::uint32_t end) {
  for (Dispatch* part : {&seen, &empty}) {
    part->frame.light_begin = begin;
    part->frame.light_end = end;
  }
}

TileDispatch aim(const Dispatch& dispatch, const Tile& tile, const Footprint& footprint) {
  const bool linear = dispatch.constants[SPEC_ORDER] == ORDER_LINEAR;
  const std::uint32_t width = linear ? GROUP_SIZE : 8, height = linear ? 1 : 8;
  TileDispatch aimed{dispatch, dispatch, {}};
  std::vector<std::uint32_t> empty;
  for (std::uint32_t y = 0; y < groups(tile.height, height); ++y)
    for (std::uint32_t x = 0; x < groups(tile.width, width); ++x) {
      const bool seen = footprint.meets(dispatch.frame.tile_x + tile.x + x * width,
                                        dispatch.frame.tile_y + tile.y + y * height, width, height);
      (seen ? aimed.group_list : empty).push_back(x | y << 16);
    }
  const auto part = [&tile](Dispatch& one, std::size_t first, std::size_t count) {
    one.frame.tile_x += tile.x;
    one.frame.tile_y += tile.y;
    one.frame.tile_width = tile.width;
    one.frame.tile_height = tile.height;
    one.frame.first_group = static_cast<std::uint32_t>(first);
    one.frame.group_count = static_cast<std::uint32_t>(count);
    one.set_groups(one.frame.group_count);
  };
  part(aimed.seen, 0, aimed.group_list.size());
  part(aimed.empty, aimed.group_list.size(), empty.size());
  aimed.empty.program = dispatch.program == Program::light ? Program::empty_light : Program::empty;
  aimed.empty.constants = empty_features(dispatch.constants);
  aimed.group_list.insert(aimed.group_list.end(), empty.begin(), empty.end());
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
