/// A step of a walk through the wide tree, for the CPU that this file is compiled for: each wide_*.cpp includes it.
#define HWY_COMPILE_ONLY_STATIC
#include <hwy/highway.h>

#include "engine/cpu/wide/wide_functions.h"
#include "shaders/layout.h"

namespace splatray {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, WIDE>;
using Lanes = hn::Vec<Tag>;
constexpr Tag TAG;
constexpr std::uint32_t LANES = hn::MaxLanes(TAG);

using IntTag = hn::RebindToSigned<Tag>;
constexpr IntTag INT_TAG;
using WordTag = hn::RebindToUnsigned<Tag>;
using Words = hn::Vec<WordTag>;
constexpr WordTag WORD_TAG;

using DoubleTag = hn::CappedTag<double, WIDE>;
using Doubles = hn::Vec<DoubleTag>;
constexpr DoubleTag DOUBLE_TAG;
constexpr std::uint32_t DOUBLE_LANES = hn::MaxLanes(DOUBLE_TAG);

/// Squared distances are compared with a little more than r^2, as float64 is a little more than the pair of floats that decides.
constexpr double RHO_SLACK = 1.0 + 1e-12;

template <class AnyTag>
std::uint32_t bits_of(AnyTag tag, hn::Mask<AnyTag> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(tag, mask, bytes);
  return hn::MaxLanes(tag) > 8 ? bytes[0] | std::uint32_t{bytes[1]} << 8U : bytes[0];
}

Lanes load(const WideFloats& values, std::uint32_t from) { return hn::Load(TAG, values.data() + from); }
/// Bounds of a node, which may lie anywhere in a file.
Lanes load_bounds(const WideFloats& values, std::uint32_t from) {
  return hn::LoadU(TAG, values.data() + from);
}

Doubles load_double(const WideFloats& values, std::uint32_t from) {
  return hn::PromoteTo(DOUBLE_TAG, hn::Load(hn::Rebind<float, DoubleTag>(), values.data() + from));
}

/// Children whose boxes the ray meets, a bit each, and where.
std::uint32_t meet_boxes(const WideNode& node, const WideWalk& walk, WideFloats& t) {
  std::uint32_t met = 0;
  for (std::uint32_t from = 0; from < WIDE; from += LANES) {
    Lanes near = hn::Set(TAG, walk.t_min), far = hn::Set(TAG, walk.t_max);
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const std::uint32_t down = walk.inverse[axis] < 0.0F ? 1 : 0;
      const Lanes inverse = hn::Set(TAG, walk.inverse[axis]), begin = hn::Set(TAG, walk.begin[axis]);
      near = hn::Max(near, hn::MulSub(load_bounds(node.bounds[axis][down], from), inverse, begin));
      far = hn::Min(far, hn::MulSub(load_bounds(node.bounds[axis][1 - down], from), inverse, begin));
    }
    hn::Store(near, TAG, t.data() + from);
    met |= bits_of(TAG, near <= far) << from;
  }
  return met;
}

Words masked(Words words, std::uint32_t mask) { return hn::And(words, hn::Set(WORD_TAG, mask)); }
Lanes number(Words words) { return hn::ConvertTo(TAG, hn::BitCast(INT_TAG, words)); }

/// A vector of each lane.
struct Vectors {
  Lanes x, y, z;
};

/// As splat_normal of shaders/primitive/disc.glsl.
Vectors decode_normal(Words word) {
  const Lanes scale = hn::Set(TAG, static_cast<float>(OCT_SCALE)), zero = hn::Zero(TAG);
  const Lanes a = number(masked(word, 0xFFFFU)) - scale, b = number(hn::ShiftRight<16>(word)) - scale;
  const Lanes c = scale - hn::Abs(a) - hn::Abs(b);
  const Lanes fold = hn::Max(hn::Neg(c), zero);
  return {hn::IfThenElse(a >= zero, a - fold, a + fold), hn::IfThenElse(b >= zero, b - fold, b + fold), c};
}

Lanes decode_radius_squared(Words word) {
  return hn::BitCast(TAG,
                     hn::Or(hn::ShiftRight<2>(masked(word, 0xFFFF0000U)), hn::Set(WORD_TAG, 0x40000000U)));
}

/// Splats of four words each.
void decode(const std::uint32_t* words, WideDiscs& splats) {
  for (std::uint32_t from = 0; from < WIDE; from += LANES) {
    Words x_y, y_z, axes, radius_object;
    hn::LoadInterleaved4(WORD_TAG, words + std::size_t{4} * from, x_y, y_z, axes, radius_object);
    const Words y = hn::Or(hn::ShiftLeft<10>(masked(x_y, 0x7FFU)), hn::ShiftRight<22>(y_z));
    hn::Store(number(hn::ShiftRight<11>(x_y)), TAG, &splats.center[0][from]);
    hn::Store(number(y), TAG, &splats.center[1][from]);
    hn::Store(number(masked(y_z, 0x1FFFFFU)), TAG, &splats.center[2][from]);
    const Vectors normal = decode_normal(axes);
    hn::Store(normal.x, TAG, &splats.normal[0][from]);
    hn::Store(normal.y, TAG, &splats.normal[1][from]);
    hn::Store(normal.z, TAG, &splats.normal[2][from]);
    hn::Store(decode_radius_squared(radius_object), TAG, &splats.radius_squared[from]);
  }
}

/// Which of the splats of a leaf, or of the children of a node, there are, a bit each.
std::uint32_t there_in(const WideLevels& tree, std::uint32_t level, std::uint32_t number) {
  return number == tree.last[level] ? tree.last_mask[level] : (1U << WIDE) - 1U;
}

/// The splats of a leaf; returns which there are. In place of others the last leaf has zeros.
std::uint32_t decode_leaf(const WideView& tree, std::uint32_t number, WideDiscs& splats) {
  const std::uint32_t* const words = tree.splats + std::size_t{4} * WIDE * number;
  const std::uint32_t there = there_in(tree.levels, 0, number);
  if (there == (1U << WIDE) - 1U) {
    decode(words, splats);
    return there;
  }
  std::uint32_t filled[4 * WIDE] = {};
  for (std::uint32_t i = 0; i < 4 * WIDE; ++i)
    if ((there >> i / 4 & 1U) != 0) filled[i] = words[i];
  decode(filled, splats);
  return there;
}

/// Splats of a leaf that the ray may hit, as splat_maybe_hit of shaders/primitive/disc.glsl decides it.
std::uint32_t maybe_hits(const WideDiscs& leaf, const WideWalk& walk) {
  const Lanes dx = hn::Set(TAG, walk.dir[0]), dy = hn::Set(TAG, walk.dir[1]), dz = hn::Set(TAG, walk.dir[2]);
  std::uint32_t met = 0;
  for (std::uint32_t from = 0; from < WIDE; from += LANES) {
    const Lanes x = load(leaf.center[0], from) - hn::Set(TAG, walk.origin[0]);
    const Lanes y = load(leaf.center[1], from) - hn::Set(TAG, walk.origin[1]);
    const Lanes z = load(leaf.center[2], from) - hn::Set(TAG, walk.origin[2]);
    const Lanes nx = load(leaf.normal[0], from), ny = load(leaf.normal[1], from),
                nz = load(leaf.normal[2], from);
    const Lanes facing = hn::MulAdd(nx, dx, hn::MulAdd(ny, dy, nz * dz));
    const Lanes inverse = hn::Set(TAG, 1.0F) / facing;
    const Lanes t = hn::MulAdd(nx, x, hn::MulAdd(ny, y, nz * z)) * inverse;
    const Lanes slack = hn::Abs(inverse) * hn::Set(TAG, PLANE_ERROR * static_cast<float>(OCT_SCALE));
    const Lanes from_x = hn::MulSub(dx, t, x), from_y = hn::MulSub(dy, t, y), from_z = hn::MulSub(dz, t, z);
    const Lanes rho_squared = hn::MulAdd(from_x, from_x, hn::MulAdd(from_y, from_y, from_z * from_z));
    const Lanes outside = hn::NegMulAdd(load(leaf.radius_squared, from), hn::Set(TAG, 1.03125F), rho_squared);
    // A ray in a disc's plane has NaN here, which counts as met.
    const auto beside = outside > hn::Set(TAG, 33.0F) * slack * slack;
    const auto before = t + slack < hn::Set(TAG, walk.t_min);
    const auto behind = t - slack >= hn::Set(TAG, walk.t_max);
    met |= bits_of(TAG, hn::Not(hn::Or(beside, hn::Or(before, behind)))) << from;
  }
  return met;
}

/// Where the ray meets the planes of those splats, by the operations of splat_plane_hit in their order; which it meets on the
/// disc.
std::uint32_t meet_splats(const WideDiscs& leaf, std::uint32_t maybe, WideWalk& walk) {
  std::uint32_t met = 0;
  for (std::uint32_t from = 0; from < WIDE; from += DOUBLE_LANES) {
    if ((maybe >> from & ((1U << DOUBLE_LANES) - 1U)) == 0) continue;
    Doubles to_center[3], dir[3];
    Doubles along = hn::Zero(DOUBLE_TAG), facing = along, rho_squared = along;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      dir[axis] = hn::Set(DOUBLE_TAG, walk.dir[axis]);
      to_center[axis] = load_double(leaf.center[axis], from) - hn::Set(DOUBLE_TAG, walk.origin[axis]) -
                        hn::Set(DOUBLE_TAG, walk.origin_low[axis]);
      const Doubles normal = load_double(leaf.normal[axis], from);
      facing = axis == 0 ? normal * dir[axis] : facing + normal * dir[axis];
      along = axis == 0 ? normal * to_center[axis] : along + normal * to_center[axis];
    }
    const Doubles t = along / facing;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const Doubles from_center = dir[axis] * t - to_center[axis];
      rho_squared = axis == 0 ? from_center * from_center : rho_squared + from_center * from_center;
      hn::Store(from_center, DOUBLE_TAG, walk.from_center[axis].data() + from);
    }
    hn::Store(t, DOUBLE_TAG, walk.t.data() + from);
    hn::Store(facing, DOUBLE_TAG, walk.facing.data() + from);
    hn::Store(rho_squared, DOUBLE_TAG, walk.rho_squared.data() + from);
    const auto on_disc =
        rho_squared <= load_double(leaf.radius_squared, from) * hn::Set(DOUBLE_TAG, RHO_SLACK);
    const auto in_range = hn::And(t > hn::Set(DOUBLE_TAG, walk.t_min), t < hn::Set(DOUBLE_TAG, walk.t_max));
    met |= bits_of(DOUBLE_TAG, hn::And(on_disc, in_range)) << from;
  }
  return met & maybe;
}

/// Puts the children met onto the stack, the nearest last.
void push_children(std::uint32_t met, const WideFloats& t, const WideBox& parent, WideWalk& walk) {
  const std::uint32_t bottom = walk.boxes_met;
  for (; met != 0; met &= met - 1) {
    const auto child = static_cast<std::uint32_t>(__builtin_ctz(met));
    std::uint32_t place = walk.boxes_met++;
    for (; place > bottom && walk.stack[place - 1].t < t[child]; --place)
      walk.stack[place] = walk.stack[place - 1];
    walk.stack[place] = {t[child], parent.level - 1, parent.number * WIDE + child};
  }
}

std::uint32_t step(const WideView& tree, WideWalk& walk) {
  while (walk.boxes_met > 0) {
    WideBox box = walk.stack[--walk.boxes_met];
    if (box.t > walk.t_max) continue;
    while (box.level > 0) {
      ++walk.nodes;
      alignas(64) WideFloats t;
      const std::uint32_t met = meet_boxes(tree.nodes[tree.levels.begin[box.level] + box.number], walk, t) &
                                there_in(tree.levels, box.level, box.number);
      if (met == 0) break;
      if ((met & (met - 1)) == 0) {
        box = {0.0F, box.level - 1, box.number * WIDE + static_cast<std::uint32_t>(__builtin_ctz(met))};
        continue;
      }
      push_children(met, t, box, walk);
      box = walk.stack[--walk.boxes_met];
    }
    if (box.level > 0) continue;
    ++walk.leaves;
    WideDiscs leaf;
    const std::uint32_t there = decode_leaf(tree, box.number, leaf);
    std::uint32_t met = maybe_hits(leaf, walk) & there;
    if (met != 0) met = meet_splats(leaf, met, walk);
    walk.leaf = box.number;
    if (met != 0) return met;
  }
  return 0;
}

}  // namespace
}  // namespace splatray
