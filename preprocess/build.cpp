#include "preprocess/build.h"

#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <numeric>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/base/release.h"
#include "engine/base/stopwatch.h"
#include "engine/image/upright.h"
#include "engine/scene/clip.h"
#include "engine/scene/scene_check.h"
#include "engine/scene/scene_splat.h"
#include "engine/scene/wide/wide_tree.h"
#include "preprocess/base/append.h"
#include "preprocess/base/parallel.h"
#include "preprocess/base/select.h"
#include "preprocess/base/stage_memory.h"
#include "preprocess/base/thread_limit.h"
#include "preprocess/clouds.h"
#include "preprocess/ground.h"
#include "preprocess/lattice.h"
#include "preprocess/pack_clouds.h"
#include "preprocess/scan/evidence.h"
#include "preprocess/scan/grid/pinhole.h"
#include "preprocess/scan/scan_surface.h"
#include "preprocess/surface/cloud.h"
#include "preprocess/surface/normals.h"
#include "preprocess/surface/radius.h"
#include "preprocess/tree/empty_space.h"
#include "preprocess/tree/insertion.h"
#include "preprocess/tree/leaf_size.h"
#include "preprocess/tree/leaf_slabs.h"
#include "preprocess/tree/long_lists.h"
#include "preprocess/tree/octree.h"
#include "preprocess/tree/root.h"

namespace splatray {
namespace {

constexpr double ISOLATED_SHARE = 0.01;  // of the scene's diagonal: radius where nothing else is known
constexpr std::uint32_t MOST_EQUAL = 8;  // splats with the same words that are kept: more only add weight

/// Bytes a point that stages take at once beside what is there when they begin, as measured: midway they cannot be refused.
constexpr std::uint64_t SEARCH_BYTES = 39, SCAN_BYTES = 60, RADII_BYTES = 51, ORDER_BYTES = 36;

void check_counts(const Input& input) {
  if (input.objects.size() > OBJECT_MASK + 1) {
    throw Error(ExitCode::input_unreadable,
                "the input has " + std::to_string(input.objects.size()) + " objects, expected at most 65536");
  }
  std::uint64_t points = 0;
  for (const InputObject& object : input.objects) points += object.points.size();
  if (points > 0xFFFFFFFFU) {
    throw Error(ExitCode::input_unreadable,
                "the input has " + std::to_string(points) + " points, expected at most 2^32 - 1");
  }
}

/// Everything of the scene that is not splats. Throws Error where the input asks for what scene files do not hold.
Scene describe_scene(Input& input, const BuildParams& params) {
  Scene scene;
  scene.build = params;
  scene.lights = std::move(input.lights);
  scene.camera = input.camera;
  scene.up = input.up.value_or(glm::dvec3(0.0, 1.0, 0.0));
  scene.environment_path = std::move(input.environment_path);
  scene.crs = std::move(input.crs);
  bool area_known = !input.objects.empty();
  for (InputObject& object : input.objects) {
    scene.materials.push_back(object.material);
    scene.object_names.push_back(std::move(object.name));
    for (const Station& station : object.points.stations) scene.stations.push_back(station);
    scene.surface_area_world += object.surface_area;
    area_known = area_known && (object.surface_area > 0.0 || object.points.size() == 0);
  }
  if (!area_known) scene.surface_area_world = 0.0;
  if (const auto defect = find_look_defect(scene.materials, scene.lights))
    throw Error(ExitCode::input_unreadable,
                "the input has " + defect->found + ", expected " + defect->expected);
  return scene;
}

/// Gives each object its bit of a ray's mask, the larger ones first: what lies inside another object is smaller, and light
/// there runs in what has the higher bit (nested dielectrics by priority: Schmidt and Budge 2002, "Simple Nested
/// Dielectrics in Ray Traced Images"). Objects that are opaque get one too, as they may be shown as glass. Where there are
/// more objects than bits, dielectrics come first; those that then share a bit must not overlap.
void number_objects(const std::vector<Cloud>& clouds, std::vector<Material>& materials) {
  std::vector<std::size_t> order(materials.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return clouds[a].half_extent_world > clouds[b].half_extent_world;
  });
  if (order.size() > MASK_BITS) {
    std::stable_partition(order.begin(), order.end(),
                          [&](std::size_t i) { return (materials[i].flags & MATERIAL_DIELECTRIC) != 0; });
  }
  for (std::size_t i = 0; i < order.size(); ++i)
    materials[order[i]].mask_bit = static_cast<std::uint32_t>(i % MASK_BITS);
}

/// The points of a scan whose radii are not given, but for discs on no surface, which have theirs already: those that scan/evidence.h
/// asks of. A bit each, as they are kept while radii are found.
std::vector<bool> find_computed(const Cloud& cloud) {
  std::vector<bool> computed(cloud.size());
  for (std::size_t i = 0; i < computed.size(); ++i)
    computed[i] = cloud.measured && (cloud.radius.empty() || cloud.radius[i] == 0.0F || !cloud.on_surface(i));
  return computed;
}

/// Whether someone has lit the scene: points in it, scanned ones among them, are objects of a picture then.
bool is_composed(const Scene& scene) { return !scene.lights.empty() || !scene.environment_path.empty(); }

/// Whether points alone are all that there is: no surface is known of any, no camera looks at them. They are a scan in formats that
/// models come in, too, whether their normals and radii are given or not.
bool is_points_alone(const std::vector<Cloud>& clouds, const Scene& scene) {
  const bool alone =
      std::all_of(clouds.begin(), clouds.end(), [](const Cloud& cloud) { return cloud.measured; });
  return alone && !scene.camera;
}

/// Estimates unknown normals; scans, which stand along `up`, unit, are freed of strays and noise, too.
void find_all_surfaces(std::vector<Cloud>& clouds, Scene& scene, const glm::dvec3& up,
                       const Progress& progress, BuildStats& stats) {
  const AddedTime watch(stats.normals_ms);
  const bool are_scan = is_points_alone(clouds, scene), composed = is_composed(scene);
  std::size_t station = 0;  // of the scene: the object's first
  for (std::size_t object = 0; object < clouds.size(); ++object) {
    Cloud& cloud = clouds[object];
    std::size_t stations = cloud.stations.size();
    const Stage stage{"normals", progress};
    require_stage_memory(stage.name, cloud.size(), cloud.measured ? SCAN_BYTES : SEARCH_BYTES);
    const std::uint64_t estimated = cloud.measured ? find_scan_surface(cloud, up, scene.build, stage, stats)
                                                   : estimate_normals(cloud, up, stage);
    stats.normals_estimated += estimated;
    std::uint32_t& flags = scene.materials[object].flags;
    if (estimated > 0 && estimated == cloud.size() && (flags & MATERIAL_DIELECTRIC) == 0)
      flags |= MATERIAL_TWO_SIDED;
    if (cloud.measured && !composed && (are_scan || estimated > 0) && scene.stations.empty())
      scene.stations.emplace_back(), stations = 1;
    for (std::size_t s = 0; s < std::min(stations, cloud.stations.size()); ++s) {
      scene.stations[station + s].noise_world = cloud.stations[s].noise_world;
      scene.stations[station + s].step_world = cloud.stations[s].step_world;
      if (!scene.stations[station + s].sensor_world)
        scene.stations[station + s].sensor_found_world = cloud.stations[s].sensor_world;
    }
    station += stations;
  }
}

/// An even choice of the points of all clouds.
PointSample sample_of(const std::vector<Cloud>& clouds) {
  constexpr std::size_t MOST = 1U << 16;
  std::size_t points = 0;
  for (const Cloud& cloud : clouds) points += cloud.size();
  PointSample sample;
  const std::size_t stride = points / MOST + 1;
  for (const Cloud& cloud : clouds)
    for (std::size_t i = 0; i < cloud.size(); i += stride) {
      sample.position.push_back(cloud.place_world(i));
      sample.normal.emplace_back(cloud.normal[i]);
    }
  return sample;
}

/// Which way scans stand, unit, before the sides of their normals are known, which follow from it.
glm::dvec3 up_of_scans(const std::vector<Cloud>& clouds, const Scene& scene, bool up_said) {
  const bool measured =
      std::any_of(clouds.begin(), clouds.end(), [](const Cloud& cloud) { return cloud.measured; });
  const bool placed = std::any_of(scene.stations.begin(), scene.stations.end(),
                                  [](const Station& station) { return station.sensor_world.has_value(); });
  return measured && !up_said ? upright_places(main_parts(sample_of(clouds)), placed).up
                              : glm::normalize(scene.up);
}

/// Which way a model stands whose format does not say. A scan's is found where it is shown, by its stations and its kind.
void stand_up(const std::vector<Cloud>& clouds, Scene& scene, BuildStats& stats) {
  if (scene.camera || !scene.stations.empty()) return;
  const glm::dvec3 up = upright_model(sample_of(clouds));
  if (up == scene.up) return;
  scene.up = up;
  stats.notes.push_back(up_note(up));
}

void find_bounds(const std::vector<Cloud>& clouds, Scene& scene) {
  Bounds bounds;
  for (const Cloud& cloud : clouds) bounds.add(bounds_of(cloud));
  scene.bounds_min_world = bounds.low;
  scene.bounds_max_world = bounds.high;
}

void find_all_radii(std::vector<Cloud>& clouds, const Scene& scene, const Progress& progress,
                    BuildStats& stats) {
  const AddedTime watch(stats.radii_ms);
  const double diagonal = scene.diagonal_world();
  const double isolated_world = (diagonal > 0.0 ? ISOLATED_SHARE * diagonal : 1.0) * scene.build.radius_scale;
  for (Cloud& cloud : clouds) {
    require_stage_memory("radii", cloud.size(), RADII_BYTES);
    const std::vector<bool> computed = find_computed(cloud);
    find_radii(cloud, scene.build.radius_rule, scene.build.radius_scale,
               scene.build.normal_fields && !cloud.lattice, {"radii", progress});
    const auto asked = numbers_where(cloud.size(), [&](std::size_t i) { return computed[i]; });
    stats.dots += make_dots(cloud, asked, {"radii", progress});
    const auto isolated =
        numbers_where(cloud.size(), [&](std::size_t i) { return !(cloud.radius[i] > 0.0F); });
    for (const std::uint32_t i : isolated)
      cloud.radius[i] = static_cast<float>(isolated_world / cloud.half_extent_world);
    stats.radii_isolated += isolated.size();
  }
}

RootTransform fit_root(const std::vector<Cloud>& clouds) {
  DiscBounds bounds;
  for (const Cloud& cloud : clouds) {
    using Range = tbb::blocked_range<std::size_t>;
    const auto add_discs = [&cloud](const Range& range, DiscBounds some) {
      for (std::size_t i = range.begin(); i < range.end(); ++i)
        some.add(cloud.place_world(i), glm::dvec3(cloud.normal[i]),
                 cloud.radius[i] * cloud.half_extent_world);
      return some;
    };
    const auto join = [](DiscBounds a, const DiscBounds& b) { return a.add(b), a; };
    bounds = tbb::parallel_reduce(Range(0, cloud.size()), bounds, add_discs, join);
  }
  return fit_root(bounds);
}

/// Keeps what points are part of beside their other attributes; a file's own column of that name stays.
void add_kind_column(Cloud& cloud) {
  if (cloud.kind.empty() || cloud.columns.size() >= COLUMNS_MOST || find_column(cloud.columns, COLUMN_KIND))
    return;
  std::vector<std::uint8_t> values(cloud.size());
  std::transform(cloud.kind.begin(), cloud.kind.end(), values.begin(),
                 [](ScanKind kind) { return static_cast<std::uint8_t>(kind); });
  release(cloud.kind);
  cloud.columns.push_back({std::string(COLUMN_KIND), std::move(values)});
}

/// The columns of all objects' points, one object after the other; 0 where an object lacks one.
std::vector<Column> take_columns(std::vector<Cloud>& clouds) {
  std::vector<Column> columns;
  std::size_t size = 0;
  for (Cloud& cloud : clouds) {
    add_kind_column(cloud);
    append_columns(columns, size, std::exchange(cloud.columns, {}), cloud.size());
    size += cloud.size();
  }
  return columns;
}

/// Puts the points' columns beside the splats that were made of them.
void place_columns(std::vector<Column> columns, const std::vector<std::uint32_t>& point, Scene& scene) {
  for (Column& column : columns) edit_values(column, [&](auto& values) { values = gather(values, point); });
  scene.columns = std::move(columns);
}

/// An octree and what its leaves list.
struct ListedOctree {
  Octree tree;
  LeafLists lists;
};

/// Lists splats by policy `overlap`, and divides leaves whose lists are long.
void insert_overlaps(ListedOctree& built, const SplatList& splats, std::uint32_t leaf_size,
                     const Stage& stage) {
  built.lists = insert_overlaps(built.tree, splats, stage);
  const std::vector<CellName> divided = find_long_lists(built.tree, built.lists, splats, leaf_size);
  if (divided.empty()) return;
  built.tree = build_octree(splats, leaf_size, divided);
  built.lists = insert_overlaps(built.tree, splats, stage);
}

ListedOctree build_lists(const SplatList& splats, const BuildParams& params, const Progress& progress,
                         BuildStats& stats) {
  ListedOctree built;
  {
    const AddedTime watch(stats.octree_ms);
    built.tree = build_octree(splats, params.leaf_size);
  }
  const AddedTime watch(stats.insertion_ms);
  if (params.insertion == Insertion::centre) {
    built.lists = insert_centres(built.tree, splats);
    return built;
  }
  insert_overlaps(built, splats, params.leaf_size, {"insertion", progress});
  stats.growth_overlap =
      static_cast<double>(built.lists.splat.size()) / static_cast<double>(splats.size()) - 1.0;
  if (params.insertion == Insertion::probe)
    built.lists =
        keep_probed(built.tree, splats, built.lists, params.probes, params.seed, {"probes", progress});
  return built;
}

/// Writes the scene's pools: leaf words get their Begin-End index.
void fill_pools(ListedOctree built, SplatList splats, Scene& scene, BuildStats& stats) {
  auto& [tree, lists] = built;
  std::vector<std::uint32_t> nodes = std::move(tree.node_pool), begin_end = {0};
  for (std::size_t i = 0; i < tree.leaves.size(); ++i) {
    const bool filled = lists.begin[i] < lists.begin[i + 1];
    const auto address = static_cast<std::uint32_t>(filled ? begin_end.size() - 1 : 0);
    nodes[tree.leaves[i].node] = (filled ? NODE_FILLED : NODE_EMPTY) << NODE_TAG_SHIFT | address;
    if (filled) begin_end.push_back(lists.begin[i + 1]);
    stats.depth = std::max<std::uint64_t>(stats.depth, tree.leaves[i].level);
  }
  scene.node_pool = std::move(nodes);
  scene.begin_end = std::move(begin_end);
  scene.reference_pool = std::move(lists.splat);
  scene.data_pool = std::move(splats.words);
  scene.color_pool = std::move(splats.color);
  scene.field_pool = std::move(splats.field);
  scene.clip_pool = std::move(splats.clip);
}

void count_result(const Scene& scene, BuildStats& stats) {
  stats.splats = scene.data_pool.size();
  for (const std::uint32_t clip : scene.clip_pool) {
    stats.ellipses += is_ellipse(clip) ? 1 : 0;
    stats.clipped += cuts_off(clip) ? 1 : 0;
  }
  stats.references = scene.reference_pool.size();
  stats.nodes = scene.node_pool.size();
  stats.filled_leaves = scene.begin_end.size() - 1;
  stats.growth = static_cast<double>(stats.references) / static_cast<double>(stats.splats) - 1.0;
  std::vector<double> squared(stats.splats);
  tbb::parallel_for(std::size_t{0}, squared.size(),
                    [&](std::size_t i) { squared[i] = splat_at(scene, i).in_root().radius_squared; });
  const double sum_squared = std::accumulate(squared.begin(), squared.end(), 0.0);
  stats.radius_median_world = std::sqrt(median_of(std::span(squared))) * scene.root.unit_world;
  if (scene.surface_area_world > 0.0) {
    stats.overlap = std::numbers::pi * sum_squared * scene.root.unit_world * scene.root.unit_world /
                    scene.surface_area_world;
  }
}

/// Throws Error (out_of_memory) unless there is the least that a build takes beside the points themselves: of each point 74 to
/// 86 bytes were measured.
void require_build_memory(const Input& input) {
  constexpr std::uint64_t POINT_BYTES = 64;
  std::uint64_t points = 0;
  for (const InputObject& object : input.objects) points += object.points.size();
  require_room(POINT_BYTES * points, "a scene of " + std::to_string(points) + " points");
}

}  // namespace

Scene build_scene(Input input, const BuildParams& params, unsigned threads, BuildStats& stats,
                  const Progress& progress) {
  const AddedTime watch(stats.total_ms);
  const ThreadLimit limit(threads);
  check_counts(input);
  require_build_memory(input);
  Scene scene = describe_scene(input, params);
  const bool up_said = input.up.has_value();
  std::vector<Cloud> clouds = make_clouds(input, scene.object_names, stats);
  if (!scene.camera) scene.camera = camera_of_scan(clouds);
  const std::optional<RootTransform> lattice = kept_lattice(clouds, params);
  find_all_surfaces(clouds, scene, up_of_scans(clouds, scene, up_said), progress, stats);
  require_points(clouds, stats);
  if (!up_said) stand_up(clouds, scene, stats);
  find_bounds(clouds, scene);
  if (params.ground) add_ground(clouds, scene);
  number_objects(clouds, scene.materials);
  find_all_radii(clouds, scene, progress, stats);
  SplatList splats;
  std::vector<Column> columns = take_columns(clouds);
  {
    const AddedTime octree_watch(stats.octree_ms);
    scene.root = lattice ? *lattice : fit_root(clouds);
    note_coarse_objects(clouds, scene.object_names, scene.root.unit_world, stats);
    splats = pack_clouds(std::move(clouds), scene.root, !columns.empty(), {"packing", progress});
    require_stage_memory("order", splats.size(), ORDER_BYTES);
    stats.dropped_duplicates +=
        order_splats(splats, params.leaf_size > 0 ? std::min(params.leaf_size, MOST_EQUAL) : MOST_EQUAL);
  }
  place_columns(std::move(columns), std::exchange(splats.point, {}), scene);
  if (scene.build.leaf_size == 0) {
    const AddedTime octree_watch(stats.octree_ms);
    scene.build.leaf_size = choose_leaf_size(splats, scene.build.insertion);
  }
  ListedOctree built = build_lists(splats, scene.build, progress, stats);
  fill_pools(std::move(built), std::move(splats), scene, stats);
  {
    const AddedTime slab_watch(stats.slabs_ms);
    require_stage_memory("slabs", scene.begin_end.size(), sizeof(OctreeCell) + sizeof(std::uint32_t));
    add_slabs(scene, {"slabs", progress});
  }
  {
    const AddedTime empty_watch(stats.empty_ms);
    require_stage_memory("empty space", scene.node_pool.size(), sizeof(std::uint32_t));
    grow_empty_leaves(scene, {"empty space", progress});
  }
  {
    const AddedTime octree_watch(stats.octree_ms);
    add_wide_tree(scene, threads);
  }
  count_result(scene, stats);
  return scene;
}

}  // namespace splatray
