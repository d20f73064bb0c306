#include "engine/scene/scene_check.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace splatray {
namespace {

using Defect = std::optional<SceneDefect>;

template <typename... Numbers>
bool finite(Numbers... numbers) {
  return (std::isfinite(numbers) && ...);
}
bool finite(const glm::dvec3& v) { return finite(v.x, v.y, v.z); }
bool finite(const glm::vec3& v) { return finite(v.x, v.y, v.z); }

std::string at(const char* what, std::size_t index) { return what + (" " + std::to_string(index)); }

Defect check_header(const Scene& scene) {
  const RootTransform& root = scene.root;
  if (!finite(root.origin_world) || !finite(root.unit_world) || !(root.unit_world > 0.0))
    return SceneDefect{"a root transform that is not finite or has no size",
                       "a finite origin and a unit > 0"};
  if (!finite(scene.up) || glm::dot(scene.up, scene.up) == 0.0)
    return SceneDefect{"an up direction that is zero or not finite", "a direction"};
  if (!finite(scene.bounds_min_world) || !finite(scene.bounds_max_world) ||
      glm::any(glm::greaterThan(scene.bounds_min_world, scene.bounds_max_world)))
    return SceneDefect{"a bounding box that is empty or not finite", "minimum <= maximum"};
  if (!finite(scene.surface_area_world) || scene.surface_area_world < 0.0)
    return SceneDefect{"a surface area that is negative or not finite", "0 or more"};
  const BuildParams& build = scene.build;
  if (build.leaf_size == 0 || build.insertion > Insertion::centre || build.radius_rule > RadiusRule::given ||
      !finite(build.radius_scale) || !(build.radius_scale > 0.0))
    return SceneDefect{"build parameters out of range", "those of splatray-preprocess"};
  return {};
}

Defect check_sizes(const Scene& scene) {
  const std::size_t references = scene.reference_pool.size(), splats = scene.data_pool.size();
  if (scene.node_pool.empty() || scene.begin_end.empty())
    return SceneDefect{"no octree", "at least a root node and one Begin-End entry"};
  if (scene.node_pool.size() > NODE_ADDRESS_MASK || references > UINT32_MAX)
    return SceneDefect{"a pool too large for its addresses", "at most 2^30 nodes and 2^32 references"};
  if (splats > references)
    return SceneDefect{std::to_string(splats) + " splats in " + std::to_string(references) + " references",
                       "at least one reference per splat"};
  if (scene.slab_pool.size() != scene.begin_end.size() - 1)
    return SceneDefect{std::to_string(scene.slab_pool.size()) + " slabs",
                       std::to_string(scene.begin_end.size() - 1) + ", one per filled leaf"};
  if (!scene.color_pool.empty() && scene.color_pool.size() != splats)
    return SceneDefect{std::to_string(scene.color_pool.size()) + " colours",
                       std::to_string(splats) + ", one per splat"};
  if (!scene.field_pool.empty() && scene.field_pool.size() != splats)
    return SceneDefect{std::to_string(scene.field_pool.size()) + " normal fields",
                       std::to_string(splats) + ", one per splat"};
  if (scene.materials.size() > OBJECT_MASK + 1 || scene.object_names.size() != scene.materials.size())
    return SceneDefect{std::to_string(scene.materials.size()) + " materials and " +
                           std::to_string(scene.object_names.size()) + " object names",
                       "one of each per object, at most 65536"};
  return {};
}

Defect check_lists(const Scene& scene) {
  const auto& begin_end = scene.begin_end;
  if (begin_end.front() != 0 || begin_end.back() != scene.reference_pool.size())
    return SceneDefect{
        "a Begin-End from " + std::to_string(begin_end.front()) + " to " + std::to_string(begin_end.back()),
        "0 to " + std::to_string(scene.reference_pool.size())};
  for (std::size_t i = 1; i < begin_end.size(); ++i)
    if (begin_end[i] <= begin_end[i - 1])
      return SceneDefect{at("Begin-End entry", i) + " not above the one before", "ascending entries"};
  const std::size_t splats = scene.data_pool.size();
  const auto astray = std::find_if(scene.reference_pool.begin(), scene.reference_pool.end(),
                                   [splats](std::uint32_t splat) { return splat >= splats; });
  if (astray != scene.reference_pool.end())
    return SceneDefect{"a reference to splat " + std::to_string(*astray), "one of " + std::to_string(splats)};
  return {};
}

/// Walks the tree from the root; a word reached twice makes the count of words reached exceed the pool's
/// size.
Defect check_nodes(const Scene& scene) {
  struct Block {
    std::uint32_t first, count, depth;
  };
  const auto& pool = scene.node_pool;
  const std::size_t leaves = scene.begin_end.size() - 1;
  std::vector<Block> open{{0, 1, 0}};
  std::size_t reached = 1;
  while (!open.empty()) {
    const Block block = open.back();
    open.pop_back();
    for (std::uint32_t i = block.first; i < block.first + block.count; ++i) {
      const std::uint32_t tag = pool[i] >> NODE_TAG_SHIFT, address = pool[i] & NODE_ADDRESS_MASK;
      if (tag == NODE_INNER) {
        if (address == 0 || address + 8ULL > pool.size())
          return SceneDefect{at("node", i) + " with children at " + std::to_string(address),
                             "an address inside the pool of " + std::to_string(pool.size())};
        if (block.depth == MAX_DEPTH)
          return SceneDefect{at("inner node", i) + " below the deepest level", "a leaf"};
        reached += 8;
        if (reached > pool.size())
          return SceneDefect{at("node", i) + " with children that have another parent", "a tree"};
        open.push_back({address, 8, block.depth + 1});
      } else if (tag == NODE_FILLED ? address >= leaves : tag != NODE_EMPTY || address > EMPTY_STEPS_MASK) {
        return SceneDefect{at("leaf", i) + " with word " + std::to_string(pool[i]),
                           "a filled leaf below " + std::to_string(leaves) + " or an empty one"};
      }
    }
  }
  if (reached == pool.size()) return {};
  return SceneDefect{std::to_string(pool.size() - reached) + " node words outside the tree", "none"};
}

Defect check_splats(const Scene& scene) {
  /// Stored radius bits (word 3, 31..16) of the squared radius 2^(2 LATTICE_BITS), the root's edge.
  const auto most = std::bit_cast<std::uint32_t>(std::ldexp(1.0F, 2 * LATTICE_BITS)) << 2U >> 16U;
  constexpr std::uint32_t RESERVED = 1U << LATTICE_BITS;
  const std::size_t objects = scene.materials.size();
  for (std::size_t i = 0; i < scene.data_pool.size(); ++i) {
    const uvec4& words = scene.data_pool[i];
    const bool normal = (words.z & 0xFFFFU) <= 2 * OCT_SCALE && words.z >> 16U <= 2 * OCT_SCALE;
    if (normal && words.w >> 16U <= most && (words.w & OBJECT_MASK) < objects && (words.y & RESERVED) == 0)
      continue;
    if (!normal)
      return SceneDefect{at("splat", i) + " with an invalid normal", "octahedral coordinates up to 65534"};
    if (words.w >> 16U > most)
      return SceneDefect{at("splat", i) + " with a radius that is not finite or exceeds the root",
                         "a smaller one"};
    if ((words.y & RESERVED) != 0) return SceneDefect{at("splat", i) + " with its reserved bit set", "zero"};
    return SceneDefect{at("splat", i) + " of object " + std::to_string(words.w & OBJECT_MASK),
                       "one of " + std::to_string(objects) + " objects"};
  }
  return {};
}

Defect check_looks(const Scene& scene) {
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& m = scene.materials[i];
    constexpr std::uint32_t KNOWN_FLAGS = MATERIAL_DIELECTRIC | MATERIAL_TWO_SIDED | MATERIAL_HIDDEN;
    if (!finite(m.diffuse) || !finite(m.tint) || !finite(m.specular, m.shininess, m.mirror, m.ior) ||
        (m.flags & ~KNOWN_FLAGS) != 0 || m.mask_bit > 31 ||
        ((m.flags & MATERIAL_DIELECTRIC) != 0 && !(m.ior > 0.0F)))
      return SceneDefect{at("material", i) + " with a value out of range", "finite values and known flags"};
  }
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const SceneLight& light = scene.lights[i];
    const bool aimed = light.kind == LIGHT_POINT || glm::dot(light.position, light.position) > 0.0;
    if (light.kind > LIGHT_POINT || !finite(light.position) || !finite(light.power) || !aimed)
      return SceneDefect{at("light", i) + " with a value out of range",
                         "a finite point or directional light"};
  }
  const Camera camera = scene.camera.value_or(Camera{});
  if (!finite(camera.eye) || !finite(camera.target) || !finite(camera.up) ||
      !finite(camera.fov_y_deg, camera.ortho_height))
    return SceneDefect{"a camera that is not finite", "finite numbers"};
  return {};
}

}  // namespace

std::optional<SceneDefect> find_scene_defect(const Scene& scene) {
  for (const auto check : {check_header, check_sizes, check_lists, check_nodes, check_splats, check_looks})
    if (const Defect defect = check(scene)) return defect;
  return {};
}

}  // namespace splatray
