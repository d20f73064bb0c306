/// A ray's way through the wide tree. Plain data alone and no inline library functions: it is compiled for several kinds of CPUs
/// (wide_step.h), and the linker might keep the AVX-512 copy of such a function for all of them (ODR).
#pragma once
#include <array>
#include <cstdint>

#include "engine/scene/wide/wide_node.h"
#include "shaders/lang/hit_numbers.h"

namespace splatray {

/// A number of each child or splat.
using WideDoubles = std::array<double, WIDE>;
using WideWords = std::array<std::uint32_t, WIDE>;

/// Splats as tests read them, all exact.
struct alignas(64) WideDiscs {
  std::array<WideFloats, 3> center;  ///< lattice units
  std::array<WideFloats, 3> normal;  ///< integers, |x| + |y| + |z| = OCT_SCALE
  WideFloats radius_squared;         ///< lattice units^2
};

/// The tree as a walk reads it: what boxes say may lead it to the wrong splats, but nowhere else.
struct WideView {
  const WideNode* nodes = nullptr;
  const std::uint32_t* splats = nullptr;  ///< four words each
  WideLevels levels;
};

/// A box that a ray meets at t.
struct WideBox {
  float t;
  std::uint32_t level;   ///< 0 = a leaf
  std::uint32_t number;  ///< in its level
};

/// Where a ray is, and what it meets there.
struct alignas(64) WideWalk {
  std::array<float, 3> origin;      ///< root space
  std::array<float, 3> origin_low;  ///< its exact origin is origin + origin_low
  std::array<float, 3> dir;
  std::array<float, 3> inverse;  ///< 1 / dir, finite
  std::array<float, 3> begin;    ///< origin * inverse
  float t_min;
  float t_max;                  ///< nothing behind it is looked for; may become less between steps
  std::uint32_t boxes_met = 0;  ///< on the stack; at first the root alone
  std::uint32_t nodes = 0;      ///< looked at
  std::uint32_t leaves = 0;     ///< tested
  std::uint32_t leaf;           ///< that the last step went to
  /// The hit of each of its splats that the step reports, as splat_plane_hit of shaders/primitive/disc.glsl computes them in float64,
  /// bit for bit; of others anything.
  alignas(64) WideDoubles t;
  WideDoubles rho_squared, facing;
  std::array<WideDoubles, 3> from_center;
  /// Boxes to go to; of each node's the nearest last.
  std::array<WideBox, (WIDE - 1) * WIDE_LEVELS + 1> stack;
};

/// Goes on to the next leaf where the ray meets discs with t in [t_min, t_max), and reports them, a bit each; perhaps a few
/// that it passes just beside. 0: the walk has ended.
using WideStepper = std::uint32_t (*)(const WideView& tree, WideWalk& walk);

/// Most meetings that are blended together: all may be members.
inline constexpr std::uint32_t WIDE_MEETINGS = MEMBERS_MOST / WIDE * WIDE;

/// A number of each meeting.
template <class Value>
using OfMeetings = std::array<Value, WIDE_MEETINGS>;

/// What is blended: the meetings of a ray that may be of one cluster (shaders/trace/cluster.glsl).
struct alignas(64) WideMeetings {
  OfMeetings<float> t, t_low;  ///< two floats
  OfMeetings<float> rho_squared;
  std::array<OfMeetings<float>, 3> from_center;
  OfMeetings<std::uint32_t> normal, radius_object;  ///< the splats' third and fourth words
  OfMeetings<std::uint32_t> splat;
  OfMeetings<std::uint32_t> field, color;  ///< words of the pools, where there are any
  OfMeetings<float> weight;                ///< set by blending: 0 where the meeting is not of the cluster
  std::uint32_t count = 0;
};

/// The cluster that they are blended to; as Window of shaders/trace/cluster.glsl.
struct WideWindow {
  std::array<float, 3> dir;
  std::array<float, 3> normal;
  float t, t_low;
  float inverse_depth;
  std::uint32_t object;
  bool back;
  bool fields, leans, colors;
};

/// Sums; as Cluster there.
struct WideSums {
  std::int32_t weight = 0, depth = 0;
  std::array<std::int32_t, 3> normal{}, color{};
  std::uint32_t members = 0;
};

/// Blends them as accumulate_candidates does with KERNEL_RIM and BLEND_WINDOW, to the same bits.
using WideBlender = WideSums (*)(WideMeetings& meetings, const WideWindow& window);

}  // namespace splatray
