/// The octree's rival: a wide bounding volume hierarchy over the same splats, traced by the same programs with another
/// traversal (bvh.glsl), so that only the structures differ.
///
/// Binned SAH (Wald 2007, "On fast Construction of SAH-based Bounding Volume Hierarchies") down to single splats, made into
/// nodes of up to 4 children so that the SAH's sum of areas is least, with 8 bits for a plane of a child's box (Ylitie et al.
/// 2017, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", sections 3.1 and 3.3).
///
/// A node is 3 texels of 128 bits. Its children are splats, then nodes:
///   x, y, z of the first: lowest corner, lattice units, bits 20..0; exponent e of the axis, 25..21: a plane's byte q means
///       corner + q 2^e. w: index of child 0 if it were a node, bits 23..0; child i is node w + i
///   the others, a byte for each child in a word: low x, high x, low y, high y; low z, high z; then the index of child 0 if
///       it were a splat, child i is splat z + i; and how many children are splats. Where there is no child low is above
///       high.
#pragma once
#include <cstdint>
#include <span>

#include "engine/gpu/program.h"
#include "engine/scene/scene.h"

namespace splatray::testing {

/// What was built.
struct BvhStats {
  double build_s = 0.0;
  std::uint32_t nodes = 0;
  std::uint32_t depth = 0;  ///< of the deepest node, the root's is 1
};

/// The scene with the hierarchy in the octree's place, for a tracer with bvh_code. data_pool: the splats, each once, then the
/// nodes; node_pool: where these begin. Throws Error (failed) where it would be too deep or too large for bvh.glsl.
[[nodiscard]] Scene bvh_scene(const Scene& scene, BvhStats& stats);

/// The tracer's programs with bvh.glsl; none for pixels left out (Settings::cull) nor for stages (Settings::stages).
[[nodiscard]] std::span<const std::uint32_t> bvh_code(Program program, PoolAccess access, bool paged,
                                                      Arithmetic arithmetic);

}  // namespace splatray::testing
