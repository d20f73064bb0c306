#include "preprocess/mesh/edge_sites.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <unordered_map>

#include "preprocess/base/segment_distance.h"
#include "preprocess/mesh/clip_finder.h"

namespace splatray {
namespace {

constexpr double NEAR = 0.75;          // of the spacing: a sample this close will do
constexpr double STEP = 0.7;           // of the spacing: from place to place along an edge
constexpr double INSIDE = 0.35;        // of the spacing: from the edge
constexpr double LEAST_HEIGHT = 0.02;  // of the spacing: triangles that are flatter are nothing to be seen
constexpr double REACH = 2.0;          // of the spacing: how far edges that clip a disc are looked for
constexpr std::size_t PATCH_MOST = 64;

/// The samples of each triangle, and those that are added.
class SamplesOnMesh {
 public:
  SamplesOnMesh(const Mesh& mesh, const MeshEdges& edges, const std::vector<std::uint32_t>& triangle,
                const std::vector<glm::dvec3>& position)
      : mesh_(mesh),
        edges_(edges),
        position_(position),
        begin_(mesh.triangles.size() + 1, 0),
        sample_(triangle.size()) {
    for (const std::uint32_t t : triangle) ++begin_[t + 1];
    for (std::size_t t = 1; t < begin_.size(); ++t) begin_[t] += begin_[t - 1];
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t i = 0; i < triangle.size(); ++i)
      sample_[next[triangle[i]]++] = static_cast<std::uint32_t>(i);
  }

  void add(std::uint32_t triangle, const glm::dvec3& place) { added_[triangle].push_back(place); }

  /// Whether a sample of the patch of a place on a triangle is within `reach`.
  [[nodiscard]] bool any_near(std::uint32_t triangle, const glm::dvec3& place, double reach) {
    patch_.assign(1, triangle);
    for (std::size_t i = 0; i < patch_.size() && i < PATCH_MOST; ++i) {
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
  [[nodiscard]] bool has_near(std::uint32_t triangle, const glm::dvec3& place, double reach) const {
    const auto near = [&](const glm::dvec3& sample) {
      return glm::dot(sample - place, sample - place) < reach * reach;
    };
    for (std::size_t i = begin_[triangle]; i < begin_[triangle + 1]; ++i)
      if (near(position_[sample_[i]])) return true;
    const auto added = added_.find(triangle);
    return added != added_.end() && std::any_of(added->second.begin(), added->second.end(), near);
  }

  const Mesh& mesh_;
  const MeshEdges& edges_;
  const std::vector<glm::dvec3>& position_;
  std::vector<std::size_t> begin_;     ///< of each triangle's samples
  std::vector<std::uint32_t> sample_;  ///< by triangle
  std::unordered_map<std::uint32_t, std::vector<glm::dvec3>> added_;
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
      if (!(height > LEAST_HEIGHT * spacing_world)) continue;
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
        if (samples.any_near(t, place, NEAR * spacing_world) ||
            finder.find(place, normal, std::span(&t, 1), REACH * spacing_world).lines() == 0)
          continue;
        samples.add(t, place);
        sites.push_back({t, weights});
      }
    }
  }
  return sites;
}

}  // namespace splatray
