#include "engine/device/program.h"

#include <algorithm>

namespace splatray {
namespace {

/// Any device takes 65535.
constexpr std::uint32_t MOST_GROUPS_X = 1U << 15U;

}  // namespace

std::uint32_t groups(std::uint32_t threads, std::uint32_t group) { return (threads + group - 1) / group; }

void Dispatch::set_groups(std::uint32_t count) {
  groups_x = std::min(count, MOST_GROUPS_X);
  groups_y = groups(count, std::max(groups_x, 1U));
}

}  // namespace splatray
