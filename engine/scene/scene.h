/// The scene in memory: splats in their octree, one material per object, lights, camera. Plain arrays, exactly what the
/// scene file stores and what the engine uploads. shaders/layout.h draws the words.
#pragma once
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "shaders/layout.h"

namespace splatray {

/// world = origin_world + root * unit_world; root in lattice units, [0, 2^LATTICE_BITS) per axis.
struct RootTransform {
  glm::dvec3 origin_world{0.0};  ///< world position of the root's lowest corner
  double unit_world = 1.0;       ///< world length of a lattice unit, > 0

  [[nodiscard]] glm::dvec3 to_world(glm::dvec3 root) const { return origin_world + root * unit_world; }
  [[nodiscard]] glm::dvec3 to_root(glm::dvec3 world) const { return (world - origin_world) / unit_world; }
};

/// Camera in world space, float64. Right-handed; the image's top row is towards `up`.
struct Camera {
  glm::dvec3 eye{0.0, 0.0, 1.0};
  glm::dvec3 target{0.0};
  glm::dvec3 up{0.0, 1.0, 0.0};  ///< need not be orthogonal to the view direction, must not be parallel to it
  double fov_y_deg = 40.0;       ///< vertical field of view, (0, 180); ignored when ortho_height > 0
  double ortho_height = 0.0;     ///< world height of an orthographic picture; 0 = perspective
  bool operator==(const Camera&) const = default;
};

/// A light in world space. Intensities are linear rgb.
struct SceneLight {
  std::uint32_t kind = LIGHT_DIRECTIONAL;  ///< LIGHT_*
  glm::dvec3 position{0.0, 1.0, 0.0};      ///< point: position; directional: unit vector towards the light
  glm::vec3 power{1.0F};  ///< directional: irradiance facing it; point: intensity (irradiance * distance^2)
  bool operator==(const SceneLight&) const = default;
};

enum class Insertion : std::uint32_t { overlap = 0, probe = 1, centre = 2 };
enum class RadiusRule : std::uint32_t { coverage = 0, knn = 1 };

/// How the octree was built; kept in the file so that a build can be repeated.
struct BuildParams {
  /// k: cells of more splat centres are divided (build_octree). 0 leaves it to build_scene; a scene's is the one it took.
  std::uint32_t leaf_size = 0;
  Insertion insertion = Insertion::overlap;
  std::uint32_t probes = 32;                      ///< probe rays per leaf, insertion == probe only
  RadiusRule radius_rule = RadiusRule::coverage;  ///< for points without a radius of their own
  double radius_scale = 1.0;                      ///< factor on every radius, > 0
  std::uint64_t samples = 0;                      ///< points sampled on meshes in all; 0 = mesh vertices
  std::uint64_t seed = 1;
  bool normal_fields =
      true;  ///< fit a normal field to every splat of a curved scene; read from a file: it has them

  bool operator==(const BuildParams&) const = default;
};

/// A splat in full precision, root space; what 128 bits decode to.
struct Splat {
  glm::dvec3 center;      ///< lattice units, integers
  glm::dvec3 normal;      ///< unit
  double radius_squared;  ///< lattice units^2
  std::uint32_t object;
};

/// Packs a splat: centre rounded to the lattice (must lie in [0, 2^21 - 1]), normal to 16-bit octahedral,
/// squared radius rounded up. Asserts on non-finite input and on an object index above OBJECT_MASK.
[[nodiscard]] uvec4 pack_splat(const Splat& splat);
/// Its squared radius alone.
[[nodiscard]] inline double unpack_radius_squared(const uvec4& words) {
  constexpr std::uint32_t EXPONENT_BIT = 0x40000000U;  // set in every stored float32: r^2 >= 2
  return std::bit_cast<float>(EXPONENT_BIT | words.w >> 16 << 14);
}
/// The integer vector (u, v, w), |u| + |v| + |w| = scale, of two octahedral coordinates; without branches, for loops.
[[nodiscard]] inline glm::dvec3 octahedral_vector(int u, int v, int scale) {
  const int w = scale - std::abs(u) - std::abs(v);
  const int fold = w < 0 ? -w : 0;
  return {u < 0 ? u + fold : u - fold, v < 0 ? v + fold : v - fold, w};
}
/// The exact splat of 128 bits. The reference implementation of the decoding, in float64; without branches, for loops.
[[nodiscard]] inline Splat unpack_splat(const uvec4& words) {
  constexpr int SCALE = OCT_SCALE;
  const glm::dvec3 normal = octahedral_vector(static_cast<int>(words.z & 0xFFFFU) - SCALE,
                                              static_cast<int>(words.z >> 16) - SCALE, SCALE);
  return {{static_cast<int>(words.x >> 11), static_cast<int>((words.x & 0x7FFU) << 10 | words.y >> 22),
           static_cast<int>(words.y & 0x1FFFFFU)},
          normal * (1.0 / std::sqrt(glm::dot(normal, normal))),
          unpack_radius_squared(words),
          words.w & OBJECT_MASK};
}

/// 8 bits a channel, square-root encoded: byte = round(255 sqrt(linear)); r lowest, then g, b, a = 255.
[[nodiscard]] std::uint32_t pack_color(glm::vec3 linear);
[[nodiscard]] glm::vec3 unpack_color(std::uint32_t color);

/// Two unit vectors that with the unit `normal` make a right-handed orthonormal basis (Duff et al. 2017, "Building an
/// Orthonormal Basis, Revisited").
struct TangentFrame {
  explicit TangentFrame(const glm::dvec3& normal);
  glm::dvec3 u, v;
};

/// The normal field of a splat (layout.h): `slope` maps an offset on the disc, in units of the radius, to the change of
/// the unit normal. Symmetric; what it does along the normal is ignored; entries beyond 1/2 are clamped.
[[nodiscard]] std::uint32_t pack_field(const glm::dmat3& slope, const glm::dvec3& normal);
/// The reference implementation of the decoding; `normal` is the splat's own, as unpack_splat gives it.
[[nodiscard]] glm::dmat3 unpack_field(std::uint32_t field, const glm::dvec3& normal);

/// A leaf's slab and halves (layout.h): low <= axis.(p - centre) / half size <= high.
struct Slab {
  glm::dvec3 axis;            ///< |x| + |y| + |z| = 1, x >= 0
  double low;                 ///< in units of the cell's half size, [-1, 1]
  double high;                ///< >= low
  std::uint32_t lower_end;    ///< splats [0, lower_end) of the leaf's list hold all that reach the lower half
  std::uint32_t upper_begin;  ///< splats [upper_begin, listed) hold all that reach the upper half
};

/// The nearest axis that a slab may have to a direction, of any length but 0, or to its opposite.
[[nodiscard]] glm::dvec3 nearest_slab_axis(const glm::dvec3& direction);

/// Packs the slab of a leaf that lists `listed` splats, >= 1; its axis must be one that slabs may have, all else turns
/// outwards.
[[nodiscard]] std::uint32_t pack_slab(const Slab& slab, std::uint32_t listed);
/// The reference implementation of the decoding; `high` may be above 1.
[[nodiscard]] Slab unpack_slab(std::uint32_t word, std::uint32_t listed);

/// The coordinate axis across which a leaf with this slab axis is halved: 0 x, 1 y, 2 z.
[[nodiscard]] int halved_axis(const glm::dvec3& slab_axis);

struct Scene {
  RootTransform root;
  BuildParams build;
  std::vector<std::uint32_t> node_pool;  ///< node words; the root is word 0, never empty
  std::vector<std::uint32_t>
      begin_end;  ///< filled leaves + 1 entries, ascending, last = reference_pool.size()
  std::vector<std::uint32_t> slab_pool;  ///< one slab per filled leaf
  std::vector<std::uint32_t>
      reference_pool;            ///< indices into data_pool, leaf by leaf, in the order of its halves
  std::vector<uvec4> data_pool;  ///< the splats, in Z-order of their centres
  std::vector<std::uint32_t> color_pool;  ///< beside data_pool, or empty (no colours)
  std::vector<std::uint32_t> field_pool;  ///< normal fields beside data_pool, or empty (all discs are flat)
  std::vector<Material> materials;        ///< one per object
  std::vector<std::string> object_names;  ///< beside materials
  std::vector<SceneLight> lights;         ///< as the input has them; may be empty
  std::optional<Camera> camera;           ///< the input's first camera
  glm::dvec3 up{0.0, 1.0, 0.0};           ///< up direction used for default framing
  glm::dvec3 bounds_min_world{0.0};       ///< bounding box of the centres
  glm::dvec3 bounds_max_world{0.0};
  double surface_area_world = 0.0;  ///< of the source meshes; 0 = unknown
  std::string environment_path;     ///< environment map named by the scene; empty = none

  /// Length of the bounding box's diagonal, world units.
  [[nodiscard]] double diagonal_world() const { return glm::length(bounds_max_world - bounds_min_world); }
};

/// What the references refer to, one after the other; the pool as it is where there are none, nothing of an empty pool.
template <typename Value>
[[nodiscard]] std::vector<Value> listed(const std::vector<Value>& pool,
                                        const std::vector<std::uint32_t>& references) {
  if (references.empty()) return pool;
  std::vector<Value> list;
  if (pool.empty()) return list;
  list.reserve(references.size());
  for (const std::uint32_t i : references) list.push_back(pool[i]);
  return list;
}

/// Most dielectrics that a ray can be inside of at once.
inline constexpr std::uint32_t MASK_BITS = 32;

/// A cell of the octree, lattice units.
struct OctreeCell {
  glm::uvec3 low{0};
  std::uint32_t size = 0;
};

/// A part of the root, lattice units; `high` is outside.
struct OctreeBox {
  glm::ivec3 low{0};
  glm::ivec3 high{0};
};

/// The box without filled leaves around an empty leaf, from its node word: the reference implementation of the decoding.
[[nodiscard]] OctreeBox empty_box(std::uint32_t word, const OctreeCell& cell);

/// The cell of a child, 0 to 7 in Z-order.
[[nodiscard]] inline OctreeCell child_cell(const OctreeCell& cell, std::uint32_t child) {
  const std::uint32_t half = cell.size / 2;
  return {cell.low + half * glm::uvec3(child & 1U, child >> 1 & 1U, child >> 2), half};
}

/// Calls visit(node word, OctreeCell) for the root and, where that returns true for an inner node, for its children in Z-order, and
/// so on.
template <typename Visit>
void visit_cells(const Scene& scene, const Visit& visit, std::uint32_t node = 0,
                 const OctreeCell& cell = {glm::uvec3(0), 1U << LATTICE_BITS}) {
  const std::uint32_t word = scene.node_pool[node];
  if (!visit(word, cell) || word >> NODE_TAG_SHIFT != NODE_INNER) return;
  for (std::uint32_t child = 0; child < 8; ++child)
    visit_cells(scene, visit, (word & NODE_ADDRESS_MASK) + child, child_cell(cell, child));
}

/// The cells of the filled leaves, in the order of Begin-End; size 0 for leaves that are not in the tree.
[[nodiscard]] std::vector<OctreeCell> leaf_cells(const Scene& scene);

/// Levels of the top table that suits a scene: as many as leave it no more entries than splats. None where a leaf's address
/// has no place beside its level.
[[nodiscard]] std::uint32_t top_levels(std::size_t splats, std::size_t filled_leaves);
/// The top table of the node pool (layout.h), 8^levels entries; levels as above or fewer.
[[nodiscard]] std::vector<std::uint32_t> top_table(const Scene& scene, std::uint32_t levels);

}  // namespace splatray
