#include "preprocess/mesh/sample_mesh.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <iterator>
#include <numeric>
#include <random>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>

#include "preprocess/base/append.h"
#include "preprocess/base/bounds.h"
#include "preprocess/base/morton.h"
#include "preprocess/base/parallel.h"
#include "preprocess/mesh/alpha_mask.h"
#include "preprocess/mesh/clip_points.h"
#include "preprocess/mesh/edge_sites.h"
#include "preprocess/mesh/edges/mesh_edges.h"
#include "preprocess/mesh/mesh_normals.h"
#include "preprocess/mesh/refined_mesh.h"
#include "preprocess/mesh/smooth_surface.h"
#include "preprocess/mesh/surface_maps.h"
#include "preprocess/mesh/texture/texture.h"
#include "preprocess/mesh/texture/texture_detail.h"

namespace splatray {
namespace {

constexpr float COS_SAME_POINT = 0.9994F;  // 2 degrees: normals of corners that are one point
constexpr double EDGE_REACH = 2.0;    // of a sample, in samples' distances: more than twice its disc's radius
constexpr double OFF_SURFACE = 0.02;  // of the samples' distance: facets that discs end at
constexpr double VERTEX_EDGE_REACH = 1.2;  // of a vertex, in units of its longest edge

std::array<glm::dvec3, 3> corners_of(const Mesh& mesh, const glm::uvec3& triangle) {
  const std::vector<glm::dvec3>& positions = mesh.vertices.position;
  return {positions[triangle.x], positions[triangle.y], positions[triangle.z]};
}

/// Corners of a piece of a triangle.
std::array<glm::dvec3, 3> corners_of(const Mesh& mesh, const SamplePiece& piece) {
  const std::array<glm::dvec3, 3> whole = corners_of(mesh, mesh.triangles[piece.triangle]);
  std::array<glm::dvec3, 3> corners;
  for (std::size_t i = 0; i < 3; ++i)
    corners[i] =
        piece.corners[i].x * whole[0] + piece.corners[i].y * whole[1] + piece.corners[i].z * whole[2];
  return corners;
}

double triangle_area(const std::array<glm::dvec3, 3>& corners) {
  return 0.5 * glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
}

double longest_edge(const std::array<glm::dvec3, 3>& corners) {
  return std::max(glm::distance(corners[0], corners[1]),
                  std::max(glm::distance(corners[1], corners[2]), glm::distance(corners[2], corners[0])));
}

Bounds bounds_of_triangles(const Mesh& mesh) {
  Bounds bounds;
  for (const glm::uvec3& triangle : mesh.triangles)
    for (const glm::dvec3& corner : corners_of(mesh, triangle)) bounds.add(corner);
  return bounds;
}

/// Triangle indices along a Morton curve through their centroids.
std::vector<std::uint32_t> morton_order(const Mesh& mesh) {
  const Bounds bounds = bounds_of_triangles(mesh);
  const glm::dvec3 extent = bounds.high - bounds.low;
  const double largest = std::max(extent.x, std::max(extent.y, extent.z));
  const double scale = largest > 0.0 ? 2097151.0 / largest : 0.0;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(mesh.triangles.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const std::array<glm::dvec3, 3> corners = corners_of(mesh, mesh.triangles[i]);
    const glm::dvec3 centroid = (corners[0] + corners[1] + corners[2]) / 3.0;
    keys[i] = {morton_key(glm::uvec3((centroid - bounds.low) * scale)), static_cast<std::uint32_t>(i)};
  }
  tbb::parallel_sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> order(keys.size());
  std::transform(keys.begin(), keys.end(), order.begin(), [](const auto& key) { return key.second; });
  return order;
}

/// Appends points given by triangle and barycentric weights.
class SampleWriter {
 public:
  SampleWriter(const Mesh& mesh, const std::vector<glm::uint>& weld, std::uint64_t count,
               double spacing_world, const MeshCreases& creases)
      : mesh_(mesh),
        mask_(mesh),
        maps_(mesh),
        normals_(corner_normals(mesh, weld, creases.cosine)),
        edges_(mesh, weld, normals_, creases.cosine),
        surface_(mesh, weld, normals_, edges_, creases.shared),
        spacing_world_(spacing_world) {
    triangles_.reserve(count);
    points_.position.reserve(count);
    points_.normal.reserve(count);
    points_.color.reserve(mesh.vertices.color.empty() && !mesh.texture ? 0 : count);
  }

  /// Adds a sample, unless the mesh's texture cuts it out.
  void add(std::size_t triangle, const glm::dvec3& weights) {
    pending_.push_back({static_cast<std::uint32_t>(triangle), weights});
    if (pending_.size() == MOST_PENDING) add_pending();
  }

  /// Adds points where edges lack them, at most as many as there are, and gives all their clip lines.
  void clip() {
    if (!edges_.any() && !mask_.any()) return;
    add_pending();
    const RefinedMesh refined(mesh_, edges_, surface_, OFF_SURFACE * spacing_world_);
    const std::vector<glm::uint> weld = weld_positions(refined.mesh().vertices.position);
    const MeshEdges edges = refined.edges(weld);
    std::vector<std::uint32_t> parts(points_.size());
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
      parts[i] = refined.part_at(triangles_[i], weights_.empty() ? glm::dvec3(0.0) : glm::dvec3(weights_[i]));
    });
    for (const MeshPlace& site :
         edge_sites(refined.mesh(), edges, parts, points_.position, spacing_world_, points_.size())) {
      const MeshPlace place{refined.triangle_of(site.triangle),
                            refined.weights_of(site.triangle, site.weights)};
      if (mask_.cut_out(place.triangle, place.weights)) continue;
      add(place.triangle, place.weights);
      parts.push_back(site.triangle);
    }
    add_pending();
    const double reach_world = EDGE_REACH * spacing_world_;
    clip_points(
        refined.mesh(), weld, edges,
        [&](std::size_t i) {
          return PointOnMesh{std::span(parts).subspan(i, 1), reach_world};
        },
        points_);
  }

  Points finish() {
    add_pending();
    for (const Column& column : mesh_.vertices.columns) points_.columns.push_back(on_samples(column));
    for (Column& column : maps_.take()) points_.columns.push_back(std::move(column));
    return std::move(points_);
  }

 private:
  static constexpr std::size_t MOST_PENDING = std::size_t{1} << 18;

  [[nodiscard]] bool colored() const { return !mesh_.vertices.color.empty() || mesh_.texture; }

  /// Makes points of what was added.
  void add_pending() {
    std::vector<MeshPlace> places = std::exchange(pending_, {});
    const auto stays = [&](std::size_t i) { return !mask_.cut_out(places[i].triangle, places[i].weights); };
    if (mask_.any()) places = gather(places, numbers_where(places.size(), stays));
    const std::size_t first = triangles_.size(), size = first + places.size();
    triangles_.resize(size);
    points_.position.resize(size);
    points_.normal.resize(size);
    if (colored()) points_.color.resize(size);
    if (!mesh_.vertices.columns.empty() || edges_.any()) weights_.resize(size);
    std::vector<glm::vec3> seen(places.size());
    using Range = tbb::blocked_range<std::size_t>;
    tbb::parallel_for(Range(0, places.size(), 1024), [&](const Range& range) {
      SmoothTriangle smooth;  // of many samples one after the other
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        const std::uint32_t triangle = places[i].triangle;
        if (i == range.begin() || triangle != places[i - 1].triangle) smooth = surface_.triangle(triangle);
        seen[i] = set(first + i, places[i], smooth);
      }
    });
    for (std::size_t i = 0; i < places.size() && !mesh_.maps.empty(); ++i)
      maps_.add(mesh_.triangles[places[i].triangle], glm::vec3(places[i].weights), seen[i]);
    const auto own = points_.normal.begin() + static_cast<std::ptrdiff_t>(first);
    if (std::equal(seen.begin(), seen.end(), own)) seen.clear();
    std::transform(seen.begin(), seen.end(), own, seen.begin(),
                   [](const glm::vec3& normal, const glm::vec3& its) {
                     return normal == its ? glm::vec3(0.0F) : normal;
                   });
    append(points_.shading, first, std::move(seen), places.size(), glm::vec3(0.0F));
  }

  /// Gives a point its place on the smooth triangle; the normal that light sees there.
  glm::vec3 set(std::size_t point, const MeshPlace& place, const SmoothTriangle& smooth) {
    const glm::uvec3& triangle = mesh_.triangles[place.triangle];
    triangles_[point] = place.triangle;
    const glm::vec3 w(place.weights);
    if (!weights_.empty()) weights_[point] = w;
    points_.position[point] = smooth.place(place.weights);
    const glm::vec3 normal = normal_on_triangle(mesh_, normals_, place.triangle, place.weights);
    points_.normal[point] = smooth.disc_normal(place.weights, normal, spacing_world_);
    if (!colored()) return normal;
    glm::vec3 color{1.0F};
    if (const auto& colors = mesh_.vertices.color; !colors.empty())
      color = w.x * colors[triangle.x] + w.y * colors[triangle.y] + w.z * colors[triangle.z];
    if (mesh_.texture) {
      const auto& uv = mesh_.texcoord;
      color *= mesh_.texture->color(w.x * uv[triangle.x] + w.y * uv[triangle.y] + w.z * uv[triangle.z]);
    }
    points_.color[point] = color;
    return normal;
  }

  /// An attribute of the vertices at the points: numbers with a fraction are interpolated, whole ones are the nearest corner's.
  [[nodiscard]] Column on_samples(const Column& column) const {
    const auto take = [this](const auto& values) -> Column::Values {
      using Value = typename std::decay_t<decltype(values)>::value_type;
      std::vector<Value> taken(points_.size());
      for (std::size_t i = 0; i < taken.size(); ++i) {
        const glm::uvec3& triangle = mesh_.triangles[triangles_[i]];
        const glm::vec3& w = weights_[i];
        if constexpr (std::is_floating_point_v<Value>) {
          taken[i] = static_cast<Value>(w.x) * values[triangle.x] +
                     static_cast<Value>(w.y) * values[triangle.y] +
                     static_cast<Value>(w.z) * values[triangle.z];
        } else {
          const int nearest = w.x >= w.y && w.x >= w.z ? 0 : (w.y >= w.z ? 1 : 2);
          taken[i] = values[triangle[nearest]];
        }
      }
      return taken;
    };
    return {column.name, std::visit(take, column.values)};
  }

  const Mesh& mesh_;
  AlphaMask mask_;
  MapSamples maps_;
  std::vector<glm::vec3> normals_;
  MeshEdges edges_;
  SmoothSurface surface_;
  double spacing_world_;            ///< of the samples where they are least dense
  std::vector<MeshPlace> pending_;  ///< samples that are no points yet
  Points points_;
  std::vector<std::uint32_t> triangles_;  ///< beside points_
  std::vector<glm::vec3> weights_;        ///< beside points_ where vertices have attributes, else empty
};

/// Samples in a triangle whose lattice makes rows; fewer lie anywhere.
constexpr double SAMPLES_IN_ROWS = 4.0;
constexpr double SLANTED_LATTICE = 0.3;  ///< sine of an angle below which a lattice's rows part

/// Sine of the least angle between the side opposite a corner and the lines that the corner's lattice fans out along to it.
double least_slant(const std::array<glm::dvec3, 3>& corners, int apex) {
  const auto at = [&](int corner) { return corners[static_cast<std::size_t>(corner % 3)]; };
  const double twice_area = 2.0 * triangle_area(corners);
  const double longest =
      std::max(glm::distance(at(apex), at(apex + 1)), glm::distance(at(apex), at(apex + 2)));
  return twice_area / (longest * glm::distance(at(apex + 1), at(apex + 2)));
}

/// Index of the corner that a triangle's lattice fans out from: that opposite the longest edge, or, where that lattice is slanted
/// and enough samples lie in it to make rows, the one whose lattice is least slanted. A Kronecker lattice of the golden ratio is
/// even however it is stretched, but where it is slanted its rows part.
int apex_of(const std::array<glm::dvec3, 3>& corners, double samples) {
  const auto opposite = [&](int corner) {
    return glm::distance(corners[static_cast<std::size_t>((corner + 1) % 3)],
                         corners[static_cast<std::size_t>((corner + 2) % 3)]);
  };
  int apex = 0;
  for (const int corner : {1, 2})
    if (opposite(corner) > opposite(apex)) apex = corner;
  if (samples < SAMPLES_IN_ROWS || least_slant(corners, apex) > SLANTED_LATTICE) return apex;
  const int longest = apex;
  for (const int corner : {(longest + 1) % 3, (longest + 2) % 3})
    if (least_slant(corners, corner) > 1.001 * least_slant(corners, apex)) apex = corner;
  return apex;
}

/// The triangles at each place of a mesh.
class Fans {
 public:
  Fans(const Mesh& mesh, const std::vector<glm::uint>& weld) : begin_(mesh.vertices.size() + 1, 0) {
    for (const glm::uvec3& triangle : mesh.triangles)
      for (glm::length_t corner = 0; corner < 3; ++corner) ++begin_[weld[triangle[corner]]];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    triangles_.resize(3 * mesh.triangles.size());
    for (std::size_t t = mesh.triangles.size(); t-- > 0;)
      for (glm::length_t corner = 0; corner < 3; ++corner)
        triangles_[--begin_[weld[mesh.triangles[t][corner]]]] = static_cast<std::uint32_t>(t);
  }

  [[nodiscard]] std::span<std::uint32_t> at(glm::uint place) {
    return std::span(triangles_).subspan(begin_[place], begin_[place + 1] - begin_[place]);
  }

 private:
  std::vector<std::size_t> begin_;
  std::vector<std::uint32_t> triangles_;
};

/// Clip lines of points at vertices, `kept`: of the triangles there, those whose corner has the point's normal.
void clip_vertices(const Mesh& mesh, const std::vector<glm::uint>& weld,
                   const std::vector<glm::vec3>& normals, double crease_cosine,
                   const std::vector<glm::uint>& kept, Points& points) {
  const MeshEdges edges(mesh, weld, corner_normals(mesh, weld, crease_cosine), crease_cosine);
  if (!edges.any() && !AlphaMask(mesh).any()) return;
  Fans fans(mesh, weld);
  std::vector<double> reach(kept.size());
  const auto fan_of = [&](std::size_t i) { return fans.at(weld[kept[i]]); };
  tbb::parallel_for(std::size_t{0}, kept.size(), [&](std::size_t i) {
    double longest = 0.0;
    for (const std::uint32_t t : fan_of(i))
      longest = std::max(longest, longest_edge(corners_of(mesh, mesh.triangles[t])));
    reach[i] = VERTEX_EDGE_REACH * longest;
  });
  const auto has_normal = [&](std::size_t i, std::uint32_t t) {
    for (glm::length_t corner = 0; corner < 3; ++corner) {
      const glm::uint vertex = mesh.triangles[t][corner];
      if (weld[vertex] == weld[kept[i]] && glm::dot(normals[vertex], normals[kept[i]]) >= COS_SAME_POINT)
        return true;
    }
    return false;
  };
  std::vector<std::vector<std::uint32_t>> split(kept.size());
  tbb::parallel_for(std::size_t{0}, kept.size(), [&](std::size_t i) {
    const auto fan = fan_of(i);
    const auto is_own = [&](std::uint32_t t) { return has_normal(i, t); };
    if (!std::all_of(fan.begin(), fan.end(), is_own))
      std::copy_if(fan.begin(), fan.end(), std::back_inserter(split[i]), is_own);
  });
  clip_points(
      mesh, weld, edges,
      [&](std::size_t i) {
        return PointOnMesh{split[i].empty() ? std::span<const std::uint32_t>(fan_of(i)) : split[i], reach[i]};
      },
      points);
}

}  // namespace

double surface_area(const Mesh& mesh) {
  double area = 0.0;
  for (const glm::uvec3& triangle : mesh.triangles) {
    area += triangle_area(corners_of(mesh, triangle));
  }
  return area;
}

bool is_coarse(const Mesh& mesh) {
  const Bounds bounds = bounds_of_triangles(mesh);
  const double limit = 0.01 * glm::length(bounds.high - bounds.low);
  double area = 0.0;
  double coarse_area = 0.0;
  for (const glm::uvec3& triangle : mesh.triangles) {
    const std::array<glm::dvec3, 3> corners = corners_of(mesh, triangle);
    const double own = triangle_area(corners);
    area += own;
    coarse_area += longest_edge(corners) > limit ? own : 0.0;
  }
  return coarse_area > 0.1 * area;
}

Points vertex_points(const Mesh& mesh, const std::vector<glm::uint>& weld, const MeshCreases& creases) {
  constexpr glm::uint NONE = 0xFFFFFFFFU;
  const std::vector<glm::vec3> normals = vertex_normals(mesh, weld);
  std::vector<bool> used(mesh.vertices.size(), false);
  for (const glm::uvec3& triangle : mesh.triangles) {
    used[triangle.x] = used[triangle.y] = used[triangle.z] = true;
  }
  std::vector<glm::uint> first_kept(mesh.vertices.size(), NONE);  // by weld representative: head of a chain
  std::vector<glm::uint> next_kept(mesh.vertices.size(), NONE);
  Points points;
  std::vector<glm::uint> kept;
  const AlphaMask mask(mesh);
  MapSamples maps(mesh);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    glm::uint other = first_kept[weld[i]];
    while (other != NONE && glm::dot(normals[other], normals[i]) < COS_SAME_POINT) {
      other = next_kept[other];
    }
    if (!used[i] || other != NONE || mask.cut_out(i)) {
      continue;
    }
    next_kept[i] = std::exchange(first_kept[weld[i]], static_cast<glm::uint>(i));
    kept.push_back(static_cast<glm::uint>(i));
    points.position.push_back(mesh.vertices.position[i]);
    points.normal.push_back(normals[i]);
    maps.add(static_cast<glm::uint>(i), normals[i]);
    if (!mesh.vertices.color.empty() || mesh.texture) {
      const glm::vec3 own = mesh.vertices.color.empty() ? glm::vec3(1.0F) : mesh.vertices.color[i];
      points.color.push_back(mesh.texture ? own * mesh.texture->color(mesh.texcoord[i]) : own);
    }
    if (!mesh.vertices.radius.empty()) points.radius.push_back(mesh.vertices.radius[i]);
  }
  for (const Column& column : mesh.vertices.columns) {
    Column& taken = points.columns.emplace_back(column);
    edit_values(taken, [&kept](auto& values) { values = gather(values, kept); });
  }
  for (Column& column : maps.take()) points.columns.push_back(std::move(column));
  if (creases.clip) clip_vertices(mesh, weld, normals, creases.cosine, kept, points);
  return points;
}

Points sample_surface(const Mesh& mesh, const std::vector<glm::uint>& weld, std::uint64_t count,
                      std::uint64_t seed, const MeshCreases& creases) {
  constexpr double GOLDEN_RATIO_PART = 0.6180339887498949;
  if (count == 0) return {};
  std::mt19937_64 random(seed);
  const double share_offset = 0.1 + 0.8 * static_cast<double>(random() >> 11U) * 0x1p-53;
  double side = static_cast<double>(random() >> 11U) * 0x1p-53;
  const std::vector<SamplePiece> pieces = sample_pieces(mesh, morton_order(mesh), count);
  double total = surface_area(mesh), least_density = 1.0;
  for (const SamplePiece& piece : pieces) {
    total += (piece.density - 1.0) * triangle_area(corners_of(mesh, piece));
    least_density = std::min(least_density, piece.density);
  }
  const double step = total / static_cast<double>(count);
  assert(step > 0.0 && std::isfinite(step));
  SampleWriter writer(mesh, weld, count, std::sqrt(step / least_density), creases);
  std::uint64_t written = 0;
  double passed = 0.0;
  std::size_t last_proper = 0;
  for (const SamplePiece& piece : pieces) {
    const std::array<glm::dvec3, 3> corners = corners_of(mesh, piece);
    const double area = piece.density * triangle_area(corners);
    if (!(area > 0.0)) continue;
    last_proper = piece.triangle;
    const int apex = apex_of(corners, area / step);
    while (written < count) {
      const double at = (static_cast<double>(written) + share_offset) * step;
      if (at >= passed + area) break;
      const double height = std::sqrt(std::max(at - passed, 0.0) / area);
      side -= side >= 1.0 ? 1.0 : 0.0;
      glm::dvec3 weights;
      weights[apex] = 1.0 - height;
      weights[(apex + 1) % 3] = height * (1.0 - side);
      weights[(apex + 2) % 3] = height * side;
      writer.add(piece.triangle,
                 weights.x * piece.corners[0] + weights.y * piece.corners[1] + weights.z * piece.corners[2]);
      side += GOLDEN_RATIO_PART;
      ++written;
    }
    passed += area;
  }
  for (; written < count; ++written) {  // rounding of the summed area may leave the last share over
    writer.add(last_proper, glm::dvec3(1.0 / 3.0));
  }
  if (creases.clip) writer.clip();
  return writer.finish();
}

}  // namespace splatray
