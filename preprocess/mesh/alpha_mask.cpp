#include "preprocess/mesh/alpha_mask.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/scene/splat.h"
#include "preprocess/mesh/texture/texture.h"

namespace splatray {
namespace {

constexpr int RINGS = 8, SPOKES = 24;     // where the mask is looked at around a point
constexpr double MASK_CUTS_WITHIN = 0.9;  // of the reach: lines further out cut next to nothing

}  // namespace

AlphaMask::AlphaMask(const Mesh& mesh)
    : mesh_(mesh), any_(mesh.texture && mesh.texture->alpha_cutoff > 0.0F && !mesh.texcoord.empty()) {}

bool AlphaMask::cut_out(std::size_t vertex) const {
  return any_ && mesh_.texture->cut_out(mesh_.texcoord[vertex], alpha(vertex));
}

bool AlphaMask::cut_out(std::uint32_t triangle, const glm::dvec3& weights) const {
  if (!any_) return false;
  const glm::uvec3& t = mesh_.triangles[triangle];
  const glm::vec3 w(weights);
  return mesh_.texture->cut_out(
      w.x * mesh_.texcoord[t.x] + w.y * mesh_.texcoord[t.y] + w.z * mesh_.texcoord[t.z],
      w.x * alpha(t.x) + w.y * alpha(t.y) + w.z * alpha(t.z));
}

void AlphaMask::clip(std::uint32_t triangle, const glm::dvec3& place, const glm::dvec3& normal, double reach,
                     PointClip& clip) const {
  const std::size_t line = clip.lines();
  if (!any_ || line == 2) return;
  const TangentFrame frame(normal);
  const glm::uvec3& t = mesh_.triangles[triangle];
  glm::dvec2 corner[3], coordinate[3];
  for (glm::length_t i = 0; i < 3; ++i) {
    const glm::dvec3 offset = mesh_.vertices.position[t[i]] - place;
    corner[i] = {glm::dot(offset, frame.u), glm::dot(offset, frame.v)};
    coordinate[i] = glm::dvec2(mesh_.texcoord[t[i]]);
  }
  const glm::dmat2 edges(corner[1] - corner[0], corner[2] - corner[0]);
  if (!(std::abs(glm::determinant(edges)) > 0.0)) return;
  const glm::dmat2 to_weights = glm::inverse(edges);  // of the second and the third corner
  const glm::dmat2 to_coordinate =
      glm::dmat2(coordinate[1] - coordinate[0], coordinate[2] - coordinate[0]) * to_weights;
  const glm::vec2 alpha_steps(alpha(t.y) - alpha(t.x), alpha(t.z) - alpha(t.x));
  glm::dvec2 cut_sum(0.0);
  std::array<glm::dvec2, RINGS * SPOKES> kept;
  std::size_t kept_count = 0;
  for (int i = 0; i < RINGS * SPOKES; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i % SPOKES) / SPOKES;
    const glm::dvec2 offset = reach * (i / SPOKES + 1) / RINGS * glm::dvec2(std::cos(angle), std::sin(angle));
    const glm::dvec2 from_corner = offset - corner[0];
    const float faded = alpha(t.x) + glm::dot(alpha_steps, glm::vec2(to_weights * from_corner));
    if (mesh_.texture->cut_out(glm::vec2(coordinate[0] + to_coordinate * from_corner), faded)) {
      cut_sum += offset;
    } else {
      kept[kept_count++] = offset;
    }
  }
  if (!(glm::length(cut_sum) > 0.0)) return;
  const glm::dvec2 dir = glm::normalize(cut_sum);
  double distance = 0.0;
  for (std::size_t i = 0; i < kept_count; ++i) distance = std::max(distance, glm::dot(kept[i], dir));
  distance += 0.5 * reach / RINGS;
  if (distance > MASK_CUTS_WITHIN * reach) return;
  clip.dir[line] = glm::vec3(dir.x * frame.u + dir.y * frame.v);
  clip.distance[line] = static_cast<float>(distance);
  clip.reach = line == 0 ? static_cast<float>(reach) : std::min(clip.reach, static_cast<float>(reach));
}

}  // namespace splatray
