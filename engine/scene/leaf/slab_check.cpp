#include "engine/scene/leaf/slab_check.h"

#include "engine/scene/leaf/halved_cell.h"
#include "engine/scene/leaf/slab.h"
#include "engine/scene/scene_splat.h"
#include "engine/scene/tree.h"

namespace splatray {
namespace {

/// Lattice units that a slab may leave out: more than rounding, far less than LIST_INFLATION, which rays allow for.
constexpr double TOLERANCE = 1.0;

/// What is wrong with the slab of a leaf, for the splat at a place in its list; null where nothing is.
const char* wrong_with(const Slab& slab, const HalvedCell& cell, const Disc& disc, std::uint32_t place) {
  const Reach reach = reach_in_cell(disc, cell, 0.0);
  if (reach.low > reach.high + TOLERANCE) return nullptr;  // only the inflated cell's list has it
  if (reach.low < slab.low * cell.half_size - TOLERANCE ||
      reach.high > slab.high * cell.half_size + TOLERANCE)
    return "slab";
  const bool in_upper = beyond(disc, cell.upper_low, cell.high) <= 0.0;
  const bool in_lower = beyond(disc, cell.low, cell.lower_high) <= 0.0;
  if (in_lower && place >= slab.lower_end) return "lower half";
  return in_upper && place < slab.upper_begin ? "upper half" : nullptr;
}

}  // namespace

std::optional<SceneDefect> find_slab_defect(const Scene& scene) {
  const std::vector<OctreeCell> cells = leaf_cells(scene);
  for (std::size_t leaf = 0; leaf < cells.size(); ++leaf) {
    const std::uint32_t begin = scene.begin_end[leaf], end = scene.begin_end[leaf + 1];
    const Slab slab = unpack_slab(scene.slab_pool[leaf], end - begin);
    const HalvedCell cell(cells[leaf], slab.axis);
    for (std::uint32_t i = begin; i < end; ++i) {
      const std::uint32_t splat = scene.reference_pool[i];
      const Disc disc(splat_at(scene, splat).in_root());
      if (const char* part = wrong_with(slab, cell, disc, i - begin))
        return SceneDefect{"leaf " + std::to_string(leaf) + " whose " + part +
                               " leaves out a part of splat " + std::to_string(splat),
                           "all that its discs have in its cell"};
    }
  }
  return {};
}

}  // namespace splatray
