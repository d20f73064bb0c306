#include "preprocess/mesh/edge_sites.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <map>
#include <span>
#include <unordered_map>

#include "preprocess/base/segment_distance.h"
#include "preprocess/mesh/clip_finder.h"

namespace splatray {
namespace {

constexpr double NEAR_ENOUGH = 0.75;  // of the spacing: a sample this close will do
constexpr double STEP = 0.7;          // of the spacing: from place to place along an edge
constexpr double INSIDE = 0.35;       // of the spacing: from the edge
constexpr double LEAST_TRIANGLE_HEIGHT =
    0.02;                           // of the spacing: triangles that are flatter are nothing to be seen
constexpr double CLIP_REACH = 2.0;  // of the spacing: how far edges that clip a disc are looked for
constexpr std::size_t MOST_SITE_PATCH = 64;

/// The samples of each triangle, and those that are added, in their order along the triangle's longest side: few of them lie in
/// a slab across it, however many a long triangle has.
class SamplesOnMesh {
 public:
  SamplesOnMesh(const Mesh& mesh, const MeshEdges& edges, const std::vector<std::uint32_t>& triangle,
                const std::vector<glm::dvec3>& position)
      : mesh_(mesh), edges_(edges), begin_(mesh.triangles.size() + 1, 0), samples_(triangle.size()) {
    for (const std::uint32_t t : triangle) ++begin_[t + 1];
    for (std::size_t t = 1; t < begin_.size(); ++t) begin_[t] += begin_[t - 1];
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t i = 0; i < triangle.size(); ++i)
      samples_[next[triangle[i]]++] = {along(triangle[i], position[i]), position[i]};
    tbb::parallel_for(std::size_t{0}, mesh.triangles.size(), [&](std::size_t t) {
      std::sort(samples_.begin() + static_cast<std::ptrdiff_t>(begin_[t]),
                samples_.begin() + static_cast<std::ptrdiff_t>(begin_[t + 1]),
                [](const Sample& a, const Sample& b) { return a.along < b.along; });
    });
  }

  void add(std::uint32_t triangle, const glm::dvec3& place) {
    added_[triangle].emplace(along(triangle, place), place);
  }

  /// Whether a sample of the patch of a place on a triangle is within `reach`.
  [[nodiscard]] bool any_near(std::uint32_t triangle, const glm::dvec3& place, double reach) {
    patch_.assign(1, triangle);
    for (std::size_t i = 0; i < patch_.size() && i < MOST_SITE_PATCH; ++i) {
      if (has_near(patch_[i], place, reach)) return true;
      for (std::uint32_t side = 0; side < 3; ++side) {
        const std::uint32_t across = edges_.across(patch_[i], side);
        if (across == MeshEdges::NONE || std::find(patch_.begin(), patch_.end(), across) != patch_.end())
          continue;
        const glm::uvec3& t = mesh_.triangles[patch_[i]];
        const auto corner = static_cast<glm::length_t>(side);
        const glm::dvec3 &a = mesh_.vertices.position[t[corner]],
                         &b = mesh_.vertices.position[t[(corner + 1) % 3]];
        if (distance_squared(place, a, b) < reach * reach) patch_.push_back(across);
      }
    }
    return false;
  }

 private:
  struct Sample {
    double along;  ///< world units
    glm::dvec3 place;
  };

  /// How far a place lies along the longest side of a triangle.
  [[nodiscard]] double along(std::uint32_t triangle, const glm::dvec3& place) const {
    const glm::uvec3& t = mesh_.triangles[triangle];
    const auto& p = mesh_.vertices.position;
    glm::dvec3 longest(0.0);
    for (const glm::dvec3& side : {p[t.y] - p[t.x], p[t.z] - p[t.y], p[t.x] - p[t.z]})
      if (glm::dot(side, side) > glm::dot(longest, longest)) longest = side;
    return glm::dot(place - p[t.x], longest / std::max(glm::length(longest), DBL_MIN));
  }

  [[nodiscard]] bool has_near(std::uint32_t triangle, const glm::dvec3& place, double reach) const {
    constexpr double ROUNDED = 1.001;  // of a slab's thickness: lengths along sides are rounded
    const double middle = along(triangle, place), low = middle - ROUNDED * reach,
                 high = middle + ROUNDED * reach;
    const auto near = [&](const glm::dvec3& sample) {
      return glm::dot(sample - place, sample - place) < reach * reach;
    };
    const auto end = samples_.begin() + static_cast<std::ptrdiff_t>(begin_[triangle + 1]);
    auto sample = std::lower_bound(samples_.begin() + static_cast<std::ptrdiff_t>(begin_[triangle]), end, low,
                                   [](const Sample& one, double value) { return one.along < value; });
    for (; sample != end && sample->along <= high; ++sample)
      if (near(sample->place)) return true;
    const auto found = added_.find(triangle);
    if (found == added_.end()) return false;
    const auto behind = found->second.upper_bound(high);
    return std::any_of(found->second.lower_bound(low), behind,
                       [&](const auto& added) { return near(added.second); });
  }

  const Mesh& mesh_;
  const MeshEdges& edges_;
  std::vector<std::size_t> begin_;  ///< of each triangle's samples
  std::vector<Sample> samples_;     ///< by triangle
  std::unordered_map<std::uint32_t, std::multimap<double, glm::dvec3>> added_;
  std::vector<std::uint32_t> patch_;
};

}  // namespace

std::vector<MeshPlace> edge_sites(const Mesh& mesh, const MeshEdges& edges,
                                  const std::vector<std::uint32_t>& triangle,
                                  const std::vector<glm::dvec3>& position, double spacing_world,
                                  std::size_t most) {
  std::vector<MeshPlace> sites;
  if (!edges.any()) return sites;
  SamplesOnMesh samples(mesh, edges, triangle, position);
  ClipFinder finder(mesh, edges);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::uint32_t side = 0; side < 3; ++side) {
      if (edges.across(t, side) != MeshEdges::NONE) continue;
      const auto from = static_cast<glm::length_t>(side);
      const glm::length_t to = (from + 1) % 3, apex = (from + 2) % 3;
      const auto corner = [&](glm::length_t i) { return mesh.vertices.position[mesh.triangles[t][i]]; };
      const glm::dvec3 edge = corner(to) - corner(from), to_apex = corner(apex) - corner(from);
      const double length = glm::length(edge);
      const double height = glm::length(glm::cross(edge, to_apex)) / length;
      if (!(height > LEAST_TRIANGLE_HEIGHT * spacing_world)) continue;
      const glm::dvec3 normal = glm::cross(edge, to_apex) / (length * height);
      const double foot =
          glm::dot(edge, to_apex) / (length * length);  // of the height, in shares of the edge
      const double steps = std::ceil(length / (STEP * spacing_world));
      for (double step = 0.5; step < steps; step += 1.0) {
        if (sites.size() == most) return sites;
        // Square to the edge, at most half the way to the triangle's other sides.
        const double share = step / steps;
        double inside = std::min(0.5, INSIDE * spacing_world / height);
        if (foot > 0.0) inside = std::min(inside, 0.5 * share / foot);
        if (foot < 1.0) inside = std::min(inside, 0.5 * (1.0 - share) / (1.0 - foot));
        glm::dvec3 weights;
        weights[apex] = inside;
        weights[to] = share - foot * inside;
        weights[from] = 1.0 - inside - weights[to];
        const glm::dvec3 place =
            weights[from] * corner(from) + weights[to] * corner(to) + weights[apex] * corner(apex);
        if (samples.any_near(t, place, NEAR_ENOUGH * spacing_world) ||
            finder.find(place, normal, std::span(&t, 1), CLIP_REACH * spacing_world).lines() == 0)
          continue;
        samples.add(t, place);
        sites.push_back({t, weights});
      }
    }
  }
  return sites;
}

}  // namespace splatray
