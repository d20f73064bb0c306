/// The scene in memory: splats in their octree, one material per object, lights, camera. Plain arrays, exactly what the
/// scene file stores and what the engine uploads. shaders/layout.h draws the words.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/camera.h"
#include "engine/scene/columns.h"
#include "engine/scene/look.h"
#include "engine/scene/pool/pool.h"
#include "engine/scene/station.h"
#include "engine/scene/wide/wide_node.h"
#include "shaders/layout.h"

namespace splatray {

class FileMapping;

/// world = origin_world + root * unit_world; root in lattice units, [0, 2^LATTICE_BITS) per axis.
struct RootTransform {
  glm::dvec3 origin_world{0.0};  ///< world position of the root's lowest corner
  double unit_world = 1.0;       ///< world length of a lattice unit, > 0

  [[nodiscard]] glm::dvec3 to_world(glm::dvec3 root) const { return origin_world + root * unit_world; }
  [[nodiscard]] glm::dvec3 to_root(glm::dvec3 world) const { return (world - origin_world) / unit_world; }
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
  /// Fit a normal field to every splat of a curved scene; read from a file: it has them.
  bool normal_fields = true;

  /// Discs end at borders and creases of meshes, of points where those are clear. Not stored in files.
  bool clip = true;
  double crease_degrees = 30.0;  ///< edges that turn by more, and are not shaded smoothly, are creases

  /// How far around each point noisy scans are smoothed, world units; 0 = not at all, negative = as their noise asks for.
  /// Not stored in files.
  double smooth_world = -1.0;
  /// Points of scans on no surface stay, but for those far from all others. Not stored in files.
  bool keep_strays = false;
  bool ground = false;  ///< add a ground below the scene, which its bounds leave out. Not stored in files.

  bool operator==(const BuildParams&) const = default;
};

struct Scene {
  RootTransform root;
  BuildParams build;
  Pool<std::uint32_t> node_pool;  ///< node words; the root is word 0, never empty
  /// Filled leaves + 1 entries, ascending, last = reference_pool.size().
  Pool<std::uint32_t> begin_end;
  Pool<std::uint32_t> slab_pool;  ///< one slab per filled leaf
  /// Indices into data_pool, leaf by leaf, in the order of its halves.
  Pool<std::uint32_t> reference_pool;
  Pool<uvec4> data_pool;           ///< the splats; with a tree in its order
  Pool<std::uint32_t> color_pool;  ///< beside data_pool, or empty (no colours)
  Pool<std::uint32_t> field_pool;  ///< normal fields beside data_pool, or empty (all discs are flat)
  Pool<std::uint32_t> clip_pool;   ///< clip lines, ellipses beside data_pool, or empty (whole discs)
  /// The wide tree over them (wide/wide_tree.h), level by level, the lowest first; empty: the scene has none. Who changes where splats
  /// are must empty it.
  Pool<WideNode> wide_nodes;
  std::vector<Column> columns;            ///< attributes beside data_pool, kept on the host; may be empty
  std::vector<Station> stations;          ///< of all objects' scans: what COLUMN_SCAN counts; may be empty
  std::vector<Material> materials;        ///< one per object
  std::vector<std::string> object_names;  ///< beside materials
  std::vector<SceneLight> lights;         ///< as the input has them; may be empty
  std::optional<Camera> camera;           ///< the input's first camera
  glm::dvec3 up{0.0, 1.0, 0.0};           ///< up direction used for default framing
  glm::dvec3 bounds_min_world{0.0};       ///< bounding box of the centres, but for BuildParams::ground's
  glm::dvec3 bounds_max_world{0.0};
  double surface_area_world = 0.0;  ///< of the source meshes; 0 = unknown
  std::string environment_path;     ///< environment map named by the scene; empty = none
  /// The world's coordinate reference system as the files have it (describe_crs, base/crs.h); empty = unknown.
  std::string crs;
  /// The file in which pools lie; null: all are in memory.
  std::shared_ptr<const FileMapping> mapping;

  /// Length of the bounding box's diagonal, world units.
  [[nodiscard]] double diagonal_world() const { return glm::length(bounds_max_world - bounds_min_world); }
};

/// The pool gathered by `references`; the pool itself if there are none, empty if the pool is.
template <typename Value>
[[nodiscard]] Pool<Value> listed(const Pool<Value>& pool, const Pool<std::uint32_t>& references) {
  if (references.empty()) return pool;
  std::vector<Value> list;
  if (pool.empty()) return list;
  list.reserve(references.size());
  for (const std::uint32_t i : references) list.push_back(pool[i]);
  return list;
}

}  // namespace splatray
