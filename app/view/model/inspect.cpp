#include "app/view/model/inspect.h"

#include <algorithm>
#include <cmath>

#include "engine/scene/splat.h"

namespace splatray {
namespace {

/// The leaf of a cell of the octree.
struct Leaf {
  std::uint32_t depth = 0;
  std::uint32_t references = 0;
};

/// The leaf that holds a point; root space, inside the root.
Leaf leaf_of(const Scene& scene, const glm::dvec3& point_root) {
  const glm::uvec3 cell(point_root);
  Leaf leaf;
  std::uint32_t word = scene.node_pool[0];
  while (word >> NODE_TAG_SHIFT == NODE_INNER) {
    const glm::uvec3 bit = cell >> (LATTICE_BITS - 1U - leaf.depth) & 1U;
    word = scene.node_pool[(word & NODE_ADDRESS_MASK) + bit.x + 2U * bit.y + 4U * bit.z];
    ++leaf.depth;
  }
  const std::uint32_t address = word & NODE_ADDRESS_MASK;
  if (word >> NODE_TAG_SHIFT == NODE_FILLED)
    leaf.references = scene.begin_end[address + 1] - scene.begin_end[address];
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
  const Splat splat = unpack_splat(hit.first);
  const Leaf leaf = leaf_of(scene, splat.center);
  const glm::dvec3 hit_root = glm::dvec3(query.origin) + double(hit.t) * glm::dvec3(query.dir);
  Inspected inspected;
  inspected.object = splat.object;
  inspected.object_name = scene.object_names[splat.object];
  inspected.center_world = scene.root.to_world(splat.center);
  inspected.normal = splat.normal;
  inspected.radius_world = std::sqrt(splat.radius_squared) * scene.root.unit_world;
  inspected.leaf_depth = leaf.depth;
  inspected.leaf_references = leaf.references;
  inspected.hit_world = scene.root.to_world(hit_root);
  const auto place = std::find(scene.data_pool.begin(), scene.data_pool.end(), hit.first);
  if (!scene.columns.empty() && place != scene.data_pool.end())
    inspected.attributes = attributes_of(scene, static_cast<std::size_t>(place - scene.data_pool.begin()));
  inspected.distance_world = glm::length(inspected.hit_world - camera.eye);
  return inspected;
}

}  // namespace splatray
