/// A step of a walk through the wide tree, for the processor that this file is compiled for: each wide_*.cpp names its function
/// WIDE_STEP and includes it.
#define HWY_COMPILE_ONLY_STATIC
#include <hwy/highway.h>

#include "engine/cpu/wide/wide_walk.h"
#include "shaders/layout.h"

namespace splatray {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, WIDE>;
using Lanes = hn::Vec<Tag>;
constexpr Tag TAG;
constexpr std::uint32_t LANES = hn::MaxLanes(TAG);

/// Bound of the float32 error of n.(c - o) / |n|, lattice units (shaders/primitive/disc.glsl).
constexpr float PLANE_ERROR = 4.0F;

std::uint32_t bits_of(hn::Mask<Tag> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(TAG, mask, bytes);
  return LANES > 8 ? bytes[0] | std::uint32_t{bytes[1]} << 8U : bytes[0];
}

Lanes load(const WideFloats& values, std::uint32_t from) { return hn::Load(TAG, values.data() + from); }

/// Children whose boxes the ray meets, a bit each, and where.
std::uint32_t meet_boxes(const WideNode& node, const WideWalk& walk, WideFloats& t) {
  std::uint32_t met = 0;
  for (std::uint32_t from = 0; from < WIDE; from += LANES) {
    Lanes near = hn::Set(TAG, walk.t_min), far = hn::Set(TAG, walk.t_max);
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const bool down = walk.inverse[axis] < 0.0F;
      const Lanes inverse = hn::Set(TAG, walk.inverse[axis]), origin = hn::Set(TAG, walk.origin[axis]);
      near = hn::Max(near, (load(node.bounds[axis][down ? 1 : 0], from) - origin) * inverse);
      far = hn::Min(far, (load(node.bounds[axis][down ? 0 : 1], from) - origin) * inverse);
    }
    hn::Store(near, TAG, t.data() + from);
    met |= bits_of(near <= far) << from;
  }
  return met;
}

/// Splats of a leaf that the ray may hit, as splat_maybe_hit of shaders/primitive/disc.glsl decides it.
std::uint32_t meet_splats(const WideLeaf& leaf, const WideWalk& walk) {
  const Lanes dx = hn::Set(TAG, walk.dir[0]), dy = hn::Set(TAG, walk.dir[1]), dz = hn::Set(TAG, walk.dir[2]);
  std::uint32_t met = 0;
  for (std::uint32_t from = 0; from < WIDE; from += LANES) {
    const Lanes x = load(leaf.center[0], from) - hn::Set(TAG, walk.origin[0]);
    const Lanes y = load(leaf.center[1], from) - hn::Set(TAG, walk.origin[1]);
    const Lanes z = load(leaf.center[2], from) - hn::Set(TAG, walk.origin[2]);
    const Lanes nx = load(leaf.normal[0], from), ny = load(leaf.normal[1], from), nz = load(leaf.normal[2], from);
    const Lanes facing = hn::MulAdd(nx, dx, hn::MulAdd(ny, dy, nz * dz));
    const Lanes inverse = hn::Set(TAG, 1.0F) / facing;
    const Lanes t = hn::MulAdd(nx, x, hn::MulAdd(ny, y, nz * z)) * inverse;
    const Lanes slack = hn::Abs(inverse) * hn::Set(TAG, PLANE_ERROR * static_cast<float>(OCT_SCALE));
    const Lanes from_x = hn::MulSub(dx, t, x), from_y = hn::MulSub(dy, t, y), from_z = hn::MulSub(dz, t, z);
    const Lanes rho_squared = hn::MulAdd(from_x, from_x, hn::MulAdd(from_y, from_y, from_z * from_z));
    const Lanes outside =
        hn::NegMulAdd(load(leaf.radius_squared, from), hn::Set(TAG, 1.03125F), rho_squared);
    // A ray in a disc's plane has NaN here, which counts as met.
    const auto beside = outside > hn::Set(TAG, 33.0F) * slack * slack;
    const auto before = t + slack < hn::Set(TAG, walk.t_min);
    const auto behind = t - slack >= hn::Set(TAG, walk.t_max);
    met |= bits_of(hn::Not(hn::Or(beside, hn::Or(before, behind)))) << from;
  }
  return met;
}

/// Puts the children met onto the stack, the nearest last.
void push_children(std::uint32_t met, const WideFloats& t, const WideBox& parent, WideWalk& walk) {
  const std::uint32_t bottom = walk.boxes_met;
  for (; met != 0; met &= met - 1) {
    const auto child = static_cast<std::uint32_t>(__builtin_ctz(met));
    std::uint32_t place = walk.boxes_met++;
    for (; place > bottom && walk.stack[place - 1].t < t[child]; --place) walk.stack[place] = walk.stack[place - 1];
    walk.stack[place] = {t[child], parent.level - 1, parent.number * WIDE + child};
  }
}

}  // namespace

WideStep WIDE_STEP(const WideView& tree, WideWalk& walk) {
  while (walk.boxes_met > 0) {
    const WideBox box = walk.stack[--walk.boxes_met];
    if (box.t > walk.t_max) continue;
    if (box.level > 0) {
      ++walk.nodes;
      alignas(64) WideFloats t;
      const std::uint32_t met = meet_boxes(tree.nodes[tree.level_begin[box.level] + box.number], walk, t);
      push_children(met, t, box, walk);
      continue;
    }
    ++walk.leaves;
    const WideLeaf& leaf = tree.leaves[box.number];
    std::uint32_t met = meet_splats(leaf, walk);
    if (box.number == tree.last_leaf) met &= tree.last_mask;
    if (met != 0) return {&leaf, met};
  }
  return {nullptr, 0};
}

}  // namespace splatray
