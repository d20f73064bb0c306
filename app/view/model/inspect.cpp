#include "app/view/model/inspect.h"

#include <bit>

#include "app/library/picture/aimed_ray.h"
#include "engine/scene/scene_splat.h"
#include "engine/scene/tree.h"
#include "engine/scene/wide/wide_tree.h"

namespace splatray {
namespace {

/// The leaf of a cell of the octree.
struct Leaf {
  std::uint32_t depth = 0;
  std::uint32_t references = 0;
};

/// The leaf that holds a point; root space, inside the root.
Leaf leaf_of(const Scene& scene, const glm::dvec3& point_root) {
  const glm::uvec3 point(point_root);
  Leaf leaf;
  visit_cells(scene, [&](std::uint32_t word, const OctreeCell& cell) {
    if (glm::any(glm::greaterThanEqual(point - cell.low, glm::uvec3(cell.size)))) return false;
    if (word >> NODE_TAG_SHIFT == NODE_INNER) return true;
    leaf.depth = LATTICE_BITS - static_cast<std::uint32_t>(std::countr_zero(cell.size));
    const std::uint32_t address = word & NODE_ADDRESS_MASK;
    if (word >> NODE_TAG_SHIFT == NODE_FILLED)
      leaf.references = scene.begin_end[address + 1] - scene.begin_end[address];
    return true;
  });
  return leaf;
}

}  // namespace

RayQuery cursor_query(const Scene& scene, const View& view, glm::dvec2 position_px) {
  const FrameParams frame = make_frame_params(scene, view, Settings{});
  const glm::vec2 at(position_px);
  RayQuery query{};
  query.origin = frame.origin_00 + frame.origin_dx * at.x + frame.origin_dy * at.y;
  query.dir = glm::normalize(frame.dir_00 + frame.dir_dx * at.x + frame.dir_dy * at.y);
  query.t_min = frame.t_min;
  query.from_object = NO_OBJECT;
  return query;
}

std::optional<Inspected> inspect(const Scene& scene, const Camera& camera, const RayQuery& query,
                                 const RayHit& hit) {
  if (hit.object == NO_OBJECT) return std::nullopt;
  const SceneSplat splat(scene, hit.first);
  const Leaf leaf = leaf_of(scene, splat.in_root().center);
  const glm::dvec3 hit_root = glm::dvec3(query.origin) + double(hit.t) * glm::dvec3(query.dir);
  Inspected inspected;
  inspected.object = splat.object();
  inspected.object_name = scene.object_names[inspected.object];
  inspected.center_world = splat.center_world();
  inspected.normal = splat.normal();
  inspected.radius_world = splat.radius_world();
  inspected.leaf_depth = leaf.depth;
  inspected.leaf_references = leaf.references;
  inspected.hit_world = scene.root.to_world(hit_root);
  if (const auto index = find_splat(scene, hit.first); index && !scene.columns.empty())
    inspected.attributes = attributes_of(scene, *index);
  inspected.distance_world = glm::length(inspected.hit_world - camera.eye);
  return inspected;
}

}  // namespace splatray
