#include "preprocess/mesh/clip_points.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/release.h"
#include "preprocess/base/parallel.h"
#include "preprocess/mesh/alpha_mask.h"
#include "preprocess/mesh/clip_finder.h"

namespace splatray {
namespace {

constexpr double DETOUR = 1.5;      // ways along a mesh's edges are so much longer than straight ones
constexpr double BOUND = 2.0;       // of the mean reach: what is further from all edges is not looked at
constexpr double MASK_REACH = 0.8;  // of the edges': masks have finer outlines than meshes

/// About how far each place is from where the surface ends, along the mesh; infinite where farther than `bound`.
std::vector<float> distances_to_edges(const Mesh& mesh, const std::vector<glm::uint>& weld,
                                      const MeshEdges& edges, float bound) {
  constexpr int MOST_SWEEPS = 64;
  std::vector<float> distance(weld.size(), std::numeric_limits<float>::infinity());
  const auto place = [&](std::uint32_t t, std::uint32_t corner) {
    return weld[mesh.triangles[t][static_cast<glm::length_t>(corner % 3)]];
  };
  const auto triangles = static_cast<std::uint32_t>(mesh.triangles.size());
  for (std::uint32_t t = 0; t < triangles; ++t)
    for (std::uint32_t side = 0; side < 3; ++side)
      if (edges.across(t, side) == MeshEdges::NONE)
        distance[place(t, side)] = distance[place(t, side + 1)] = 0.0F;
  bool changed = true;
  for (int sweep = 0; sweep < MOST_SWEEPS && changed; ++sweep) {
    changed = false;
    for (std::uint32_t t = 0; t < triangles; ++t) {
      for (std::uint32_t side = 0; side < 3; ++side) {
        const glm::uint a = place(t, side), b = place(t, side + 1);
        if (!(std::min(distance[a], distance[b]) < bound)) continue;
        const auto length =
            static_cast<float>(glm::distance(mesh.vertices.position[a], mesh.vertices.position[b]));
        glm::uint far = distance[a] > distance[b] ? a : b;
        const float through = std::min(distance[a], distance[b]) + length;
        if (!(through < std::min(distance[far], bound))) continue;
        distance[far] = through;
        changed = true;
      }
    }
  }
  return distance;
}

}  // namespace

void clip_points(const Mesh& mesh, const std::vector<glm::uint>& weld, const MeshEdges& edges,
                 const std::function<PointOnMesh(std::size_t)>& on_mesh, Points& points) {
  const AlphaMask mask(mesh);
  if (!edges.any() && !mask.any()) return;
  points.clip.assign(points.size(), PointClip{});
  double reaches = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) reaches += on_mesh(i).reach_world;
  const auto bound = static_cast<float>(DETOUR * BOUND * reaches / static_cast<double>(points.size()));
  const std::vector<float> distance = distances_to_edges(mesh, weld, edges, bound);
  const auto near_edge = [&](const PointOnMesh& on) {
    const auto near = [&](std::uint32_t t) {
      const glm::uvec3& corners = mesh.triangles[t];
      double longest = 0.0, nearest = std::numeric_limits<double>::infinity();
      for (glm::length_t i = 0; i < 3; ++i) {
        const auto &a = mesh.vertices.position[corners[i]], &b = mesh.vertices.position[corners[(i + 1) % 3]];
        longest = std::max(longest, glm::distance(a, b));
        nearest = std::min(nearest, double{distance[weld[corners[i]]]});
      }
      return nearest < DETOUR * on.reach_world + longest;
    };
    return std::any_of(on.triangles.begin(), on.triangles.end(), near);
  };
  tbb::enumerable_thread_specific<ClipFinder> finders([&] { return ClipFinder(mesh, edges); });
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
    const PointOnMesh on = on_mesh(i);
    const glm::dvec3 normal(points.normal[i]);
    const double length = glm::length(normal);
    if (!(length > 0.0)) return;
    if (near_edge(on))
      points.clip[i] =
          finders.local().find(points.position[i], normal / length, on.triangles, on.reach_world);
    mask.clip(on.triangles.front(), points.position[i], normal / length, MASK_REACH * on.reach_world,
              points.clip[i]);
  });
  const auto has_lines = [](const PointClip& clip) { return clip.lines() > 0; };
  if (std::none_of(points.clip.begin(), points.clip.end(), has_lines)) release(points.clip);
}

}  // namespace splatray
