#include "engine/scene/scene_check.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "engine/base/number_text.h"
#include "engine/scene/leaf/empty_box.h"
#include "engine/scene/leaf/slab.h"
#include "engine/scene/material_fields.h"
#include "engine/scene/pool/pool_table.h"

namespace splatray {
namespace {

using Defect = std::optional<SceneDefect>;

template <typename... Numbers>
bool finite(Numbers... numbers) {
  return (std::isfinite(numbers) && ...);
}
bool finite(const glm::dvec3& v) { return finite(v.x, v.y, v.z); }
bool finite(const glm::vec3& v) { return finite(v.x, v.y, v.z); }

bool is_length(double value) { return finite(value) && value >= 0.0; }

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
  if (build.leaf_size == 0 || build.insertion > Insertion::centre || build.radius_rule > RadiusRule::knn ||
      !finite(build.radius_scale) || !(build.radius_scale > 0.0))
    return SceneDefect{"build parameters out of range", "those of splatray-preprocess"};
  return {};
}

Defect check_sizes(const Scene& scene) {
  const std::size_t references = scene.reference_pool.size(), splats = scene.data_pool.size();
  if (scene.begin_end.empty()) return SceneDefect{"no Begin-End", "at least one entry"};
  if (references > UINT32_MAX)
    return SceneDefect{std::to_string(references) + " references", "at most 2^32 - 1"};
  if (splats > references)
    return SceneDefect{std::to_string(splats) + " splats in " + std::to_string(references) + " references",
                       "at least one reference per splat"};
  Defect defect;
  for_each_pool([&](const auto& row) {
    const std::size_t found = (scene.*row.pool).size(), expected = pool_length(scene, row.length);
    if (!defect && found != expected && !(row.optional() && found == 0))
      defect = {std::to_string(found) + " " + row.plural, std::to_string(expected)};
  });
  if (defect) return defect;
  if (scene.columns.size() > COLUMNS_MOST)
    return SceneDefect{std::to_string(scene.columns.size()) + " columns",
                       "at most " + std::to_string(COLUMNS_MOST)};
  for (const Column& column : scene.columns)
    if (column.size() != splats)
      return SceneDefect{std::to_string(column.size()) + " values of " + column.name, std::to_string(splats)};
  for (const Station& station : scene.stations)
    if (!finite(station.sensor_world.value_or(glm::dvec3(0.0))))
      return SceneDefect{"a station whose place is not finite", "finite numbers"};
  for (const Station& station : scene.stations)
    if (!is_length(station.noise_world) || !is_length(station.step_world))
      return SceneDefect{"a station's noise or step that is no length", "finite numbers >= 0"};
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

/// Each filled leaf's slab has an axis that slabs may have, and its halves hold the whole list.
Defect check_slabs(const Scene& scene) {
  constexpr std::uint32_t AXIS_V_SHIFT = 5, AXIS_V_MASK = 63;
  for (std::size_t i = 0; i < scene.slab_pool.size(); ++i) {
    const std::uint32_t word = scene.slab_pool[i];
    if ((word >> AXIS_V_SHIFT & AXIS_V_MASK) > 2 * SLAB_AXIS_SCALE)
      return SceneDefect{at("slab", i) + " with an invalid axis", "octahedral coordinates up to 62"};
    const Slab slab = unpack_slab(word, scene.begin_end[i + 1] - scene.begin_end[i]);
    if (slab.lower_end < slab.upper_begin)
      return SceneDefect{at("slab", i) + " whose halves leave out " +
                             std::to_string(slab.upper_begin - slab.lower_end) + " of the leaf's splats",
                         "halves that hold all"};
  }
  return {};
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

Defect check_camera(const Scene& scene) {
  const Camera camera = scene.camera.value_or(Camera{});
  if (!finite(camera.eye) || !finite(camera.target) || !finite(camera.up) ||
      !finite(camera.fov_y_deg, camera.ortho_height))
    return SceneDefect{"a camera that is not finite", "finite numbers"};
  if (camera.ortho_height < 0.0)
    return SceneDefect{"a camera with a negative orthographic height", "0 or more"};
  if (camera.ortho_height == 0.0 && !(camera.fov_y_deg > 0.0 && camera.fov_y_deg < 180.0))
    return SceneDefect{"a camera with a field of view of " + std::to_string(camera.fov_y_deg) + " degrees",
                       "more than 0 and less than 180"};
  return {};
}

/// Whether all channels are in [0, 1].
bool is_share(const glm::vec3& color) {
  return glm::all(glm::greaterThanEqual(color, glm::vec3(0.0F))) &&
         glm::all(glm::lessThanEqual(color, glm::vec3(1.0F)));
}
bool is_share(float value) { return value >= 0.0F && value <= 1.0F; }

/// Ranges: layout.h.
Defect check_phong(const Phong& phong) {
  if (!is_share(phong.diffuse)) return SceneDefect{"a diffuse reflectance", "0 to 1"};
  if (!is_share(phong.tint)) return SceneDefect{"a tint", "0 to 1"};
  if (!is_share(phong.specular)) return SceneDefect{"a specular reflectance", "0 to 1"};
  if (!is_share(phong.mirror)) return SceneDefect{"a mirror", "0 to 1"};
  if (!finite(phong.shininess) || phong.shininess < 1.0F) return SceneDefect{"a shininess", "1 or more"};
  return {};
}

Defect check_material(const Material& material) {
  constexpr std::uint32_t KNOWN_FLAGS = MATERIAL_DIELECTRIC | MATERIAL_TWO_SIDED | MATERIAL_HIDDEN;
  if (const Defect defect = check_phong(material.phong)) return defect;
  if (!finite(material.ior) || !(material.ior > 0.0F))
    return SceneDefect{"an index of refraction", "more than 0"};
  if ((material.flags & ~KNOWN_FLAGS) != 0) return SceneDefect{"flags", "known ones"};
  if (material.mask_bit >= MASK_BITS) return SceneDefect{"a mask bit", "0 to 31"};
  for (const MaterialField& field : material_fields()) {
    const vec3 value = field.of(material);
    if (glm::all(glm::greaterThanEqual(value, vec3(field.least))) &&
        glm::all(glm::lessThanEqual(value, vec3(field.most))))
      continue;
    const bool bounded = field.most < std::numeric_limits<float>::max();
    return SceneDefect{field.what, number_text(field.least) +
                                       (bounded ? " to " + number_text(field.most) : " or more, finite")};
  }
  return {};
}

/// Whether half edges make a rectangle: some length each, and perpendicular but for rounding.
bool are_edges(const glm::dvec3& u, const glm::dvec3& v) {
  const double u_squared = glm::dot(u, u), v_squared = glm::dot(v, v);
  return u_squared > 0.0 && v_squared > 0.0 && std::isfinite(u_squared * v_squared) &&
         std::abs(glm::dot(u, v)) <= 1e-6 * std::sqrt(u_squared * v_squared);
}

Defect check_light(const SceneLight& light) {
  constexpr double QUARTER_TURN = 1.571, LARGEST = 1e30;  // rounded up
  if (light.kind > LIGHT_KIND_LAST) return SceneDefect{"a kind", "0 to " + std::to_string(LIGHT_KIND_LAST)};
  const bool aimed = light.kind != LIGHT_DIRECTIONAL || glm::dot(light.position, light.position) > 0.0;
  if (!finite(light.position) || !aimed) return SceneDefect{"a position or direction", "finite numbers"};
  if (!(light.size >= 0.0 && light.size <= (light.kind == LIGHT_DIRECTIONAL ? QUARTER_TURN : LARGEST)))
    return SceneDefect{"a size", "0 or more, of directional ones at most a quarter turn"};
  const bool flat = is_flat(light.kind);
  if (!finite(light.edge_u) || !finite(light.edge_v) || (flat && !are_edges(light.edge_u, light.edge_v)))
    return SceneDefect{"edges", "two that are perpendicular and have a length"};
  if (!finite(light.power) || glm::any(glm::lessThan(light.power, glm::vec3(0.0F))))
    return SceneDefect{"a power", "finite numbers, 0 or more"};
  const bool cone =
      light.spot_inner >= 0.0 && light.spot_inner < light.spot_outer && light.spot_outer <= QUARTER_TURN;
  if (!finite(light.spot_axis) || (is_spot(light) && (light.kind != LIGHT_POINT || !cone)))
    return SceneDefect{"a spot's cone", "an axis, and 0 <= inner angle < outer angle <= a quarter turn"};
  if (!(light.range >= 0.0 && light.range <= LARGEST)) return SceneDefect{"a range", "0 or more, finite"};
  return {};
}

/// Walks the tree from the root. More words reached than there are: one has two parents.
class NodeCheck {
 public:
  NodeCheck(std::span<const std::uint32_t> nodes, std::size_t filled_leaves)
      : nodes_(nodes), named_(filled_leaves) {}

  Defect find() {
    open_ = {{0, 1, 0}};
    while (!open_.empty()) {
      const Block block = open_.back();
      open_.pop_back();
      for (std::uint32_t i = block.first; i < block.first + block.count; ++i)
        if (const Defect defect = check_word(i, block.depth)) return defect;
    }
    if (reached_ != nodes_.size())
      return SceneDefect{std::to_string(nodes_.size() - reached_) + " node words outside the tree", "none"};
    const auto unnamed = std::count(named_.begin(), named_.end(), false);
    if (unnamed == 0) return {};
    return SceneDefect{std::to_string(unnamed) + " filled leaves that are not in the tree", "none"};
  }

 private:
  struct Block {
    std::uint32_t first, count, depth;
  };

  Defect check_word(std::uint32_t node, std::uint32_t depth) {
    const std::uint32_t word = nodes_[node], tag = word >> NODE_TAG_SHIFT, address = word & NODE_ADDRESS_MASK;
    if (tag == NODE_INNER) return open_children(node, address, depth);
    if (tag == NODE_FILLED ? address >= named_.size() : tag != NODE_EMPTY || address > EMPTY_STEPS_MASK)
      return SceneDefect{at("leaf", node) + " with word " + std::to_string(word),
                         "a filled leaf below " + std::to_string(named_.size()) + " or an empty one"};
    if (tag == NODE_EMPTY) return {};
    if (named_[address])
      return SceneDefect{at("node", node) + " that shares filled leaf " + std::to_string(address),
                         "a filled leaf of its own"};
    named_[address] = true;
    return {};
  }

  Defect open_children(std::uint32_t node, std::uint32_t address, std::uint32_t depth) {
    if (address == 0 || address + 8ULL > nodes_.size())
      return SceneDefect{at("node", node) + " with children at " + std::to_string(address),
                         "an address inside the pool of " + std::to_string(nodes_.size())};
    if (depth == MAX_DEPTH) return SceneDefect{at("inner node", node) + " below the deepest level", "a leaf"};
    reached_ += 8;
    if (reached_ > nodes_.size())
      return SceneDefect{at("node", node) + " with children that have another parent", "a tree"};
    open_.push_back({address, 8, depth + 1});
    return {};
  }

  std::span<const std::uint32_t> nodes_;
  std::vector<bool> named_;  ///< for each filled leaf, whether a node word names it
  std::vector<Block> open_;  ///< words still to be looked at
  std::size_t reached_ = 1;
};

Defect check_nodes(std::span<const std::uint32_t> nodes, std::size_t filled_leaves) {
  if (nodes.empty()) return SceneDefect{"no octree", "at least a root node"};
  if (nodes.size() > NODE_ADDRESS_MASK)
    return SceneDefect{std::to_string(nodes.size()) + " node words", "at most 2^30"};
  return NodeCheck(nodes, filled_leaves).find();
}

}  // namespace

std::optional<SceneDefect> find_tree_defect(std::span<const std::uint32_t> nodes, std::size_t filled_leaves) {
  if (const Defect defect = check_nodes(nodes, filled_leaves)) return defect;
  if (const auto leaf = find_overreaching_leaf(nodes))
    return SceneDefect{at("empty leaf", *leaf) + " whose box reaches over a filled leaf or out of the root",
                       "a box of empty space"};
  return {};
}

std::optional<SceneDefect> find_content_defect(const Scene& scene) {
  const auto check_look = [](const Scene& of) { return find_look_defect(of.materials, of.lights); };
  for (const auto check :
       {check_header, check_sizes, check_lists, check_slabs, check_splats, +check_look, check_camera})
    if (const Defect defect = check(scene)) return defect;
  return {};
}

std::optional<SceneDefect> find_look_defect(const std::vector<Material>& materials,
                                            const std::vector<SceneLight>& lights) {
  const auto in = [](const char* kind, std::size_t index, const SceneDefect& defect) {
    return SceneDefect{at(kind, index) + " with " + defect.found + " out of range", defect.expected};
  };
  for (std::size_t i = 0; i < materials.size(); ++i)
    if (const Defect defect = check_material(materials[i])) return in("material", i, *defect);
  if (lights.size() > LIGHTS_MOST)
    return SceneDefect{std::to_string(lights.size()) + " lights", "at most " + std::to_string(LIGHTS_MOST)};
  for (std::size_t i = 0; i < lights.size(); ++i)
    if (const Defect defect = check_light(lights[i])) return in("light", i, *defect);
  return {};
}

std::optional<SceneDefect> find_scene_defect(const Scene& scene) {
  if (const Defect defect = check_sizes(scene)) return defect;
  if (const Defect defect = find_tree_defect(scene.node_pool, scene.slab_pool.size())) return defect;
  return find_content_defect(scene);
}

}  // namespace splatray
