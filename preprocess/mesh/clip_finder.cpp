#include "preprocess/mesh/clip_finder.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/scene/splat.h"
#include "preprocess/base/segment_distance.h"

namespace splatray {
namespace {

constexpr std::size_t MOST_CLIP_PATCH = 128;  // triangles: a disc over more stays whole
constexpr double COS_ALIKE = 0.999;           // 2.5 degrees: edges that are tried once
constexpr double COS_SECOND = 0.966;          // 15 degrees: a second line differs by more
constexpr double EDGES_CUT_WITHIN = 0.98;     // of the reach: lines further out cut nothing

/// The shares of the way from a to b between which a point is within `reach` of the origin.
std::optional<std::pair<double, double>> within(const glm::dvec2& a, const glm::dvec2& b, double reach) {
  const glm::dvec2 along = b - a;
  const double squared = glm::dot(along, along);
  const double middle = squared > 0.0 ? -glm::dot(a, along) / squared : 0.0;
  const glm::dvec2 nearest = a + middle * along;
  const double left = reach * reach - glm::dot(nearest, nearest);
  if (!(left >= 0.0)) return {};
  const double half = squared > 0.0 ? std::sqrt(left / squared) : 0.0;
  const double from = std::max(middle - half, 0.0), to = std::min(middle + half, 1.0);
  if (from > to) return {};
  return std::pair(from, to);
}

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

bool holds(const glm::dvec2 (&corners)[3], const glm::dvec2& point) {
  const double a = cross(corners[1] - corners[0], point - corners[0]);
  const double b = cross(corners[2] - corners[1], point - corners[1]);
  const double c = cross(corners[0] - corners[2], point - corners[2]);
  return (a >= 0.0 && b >= 0.0 && c >= 0.0) || (a <= 0.0 && b <= 0.0 && c <= 0.0);
}

}  // namespace

/// Whether the triangles within reach that are joined smoothly to the seeds have an edge there, and are not too many.
bool ClipFinder::find_patch(const glm::dvec3& place, std::span<const std::uint32_t> seeds, double reach) {
  ++patches_;
  patch_.assign(seeds.begin(), seeds.end());
  for (const std::uint32_t seed : seeds) seen_[seed] = patches_;
  bool edge = false;
  for (std::size_t next = 0; next < patch_.size(); ++next) {
    if (patch_.size() > MOST_CLIP_PATCH) return false;
    const glm::uvec3& corners = mesh_.triangles[patch_[next]];
    for (std::uint32_t side = 0; side < 3; ++side) {
      const std::uint32_t across = edges_.across(patch_[next], side);
      if (across != MeshEdges::NONE && seen_[across] == patches_) continue;
      const auto from = static_cast<glm::length_t>(side);
      const glm::dvec3& a = mesh_.vertices.position[corners[from]];
      if (!(distance_squared(place, a, mesh_.vertices.position[corners[(from + 1) % 3]]) < reach * reach))
        continue;
      edge = edge || across == MeshEdges::NONE;
      if (across == MeshEdges::NONE) continue;
      seen_[across] = patches_;
      patch_.push_back(across);
    }
  }
  return edge;
}

/// The patch in the disc's plane.
void ClipFinder::flatten_patch(const glm::dvec3& place, const glm::dvec3& u, const glm::dvec3& v,
                               const glm::dvec3& normal, double reach) {
  corners_.clear(), pieces_.clear(), dirs_.clear();
  for (const std::uint32_t triangle : patch_) {
    Corners flat;
    double height[3];
    for (glm::length_t i = 0; i < 3; ++i) {
      const glm::dvec3 offset = mesh_.vertices.position[mesh_.triangles[triangle][i]] - place;
      flat.at[i] = {glm::dot(offset, u), glm::dot(offset, v)};
      height[i] = glm::dot(offset, normal);
    }
    corners_.push_back(flat);
    for (std::uint32_t side = 0; side < 3; ++side) {
      const std::uint32_t end = (side + 1) % 3;
      const glm::dvec2 from = flat.at[side], to = flat.at[end];
      const auto inside = within(from, to, reach);
      if (!inside) continue;
      const auto at = [&](double share) { return from + share * (to - from); };
      const auto height_at = [&](double share) {
        return height[side] + share * (height[end] - height[side]);
      };
      const bool edge = edges_.across(triangle, side) == MeshEdges::NONE;
      pieces_.push_back(
          {at(inside->first), at(inside->second), height_at(inside->first), height_at(inside->second), edge});
      const glm::dvec2 out(to.y - from.y, from.x - to.x);
      const double length = glm::length(out);
      if (!edge || !(length > 0.0)) continue;
      const double inwards = glm::dot(out, flat.at[(side + 2) % 3] - from);
      dirs_.push_back(inwards > 0.0 ? -out / length : out / length);
    }
  }
}

/// How far the patch reaches in a direction, and on its edges as much further as they lie off the disc's plane: there the discs
/// of the other side, in another plane, end.
double ClipFinder::support(const glm::dvec2& dir, double reach) const {
  const glm::dvec2 farthest = reach * dir;
  for (const Corners& corners : corners_)
    if (holds(corners.at, farthest)) return reach;
  double most = 0.0;
  for (const Piece& piece : pieces_) {
    const double off = piece.edge ? std::max(std::abs(piece.height_from), std::abs(piece.height_to)) : 0.0;
    most = std::max(most, std::max(glm::dot(piece.from, dir), glm::dot(piece.to, dir)) + off);
  }
  return most;
}

PointClip ClipFinder::find(const glm::dvec3& place, const glm::dvec3& normal,
                           std::span<const std::uint32_t> seeds, double reach) {
  PointClip clip;
  const TangentFrame frame(normal);
  if (!find_patch(place, seeds, reach)) return clip;
  flatten_patch(place, frame.u, frame.v, normal, reach);
  std::vector<std::pair<double, glm::dvec2>> lines;
  for (std::size_t i = 0; i < dirs_.size(); ++i) {
    const auto alike = [&](const glm::dvec2& other) { return glm::dot(other, dirs_[i]) > COS_ALIKE; };
    const auto before = dirs_.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::any_of(dirs_.begin(), before, alike)) continue;
    const double distance = support(dirs_[i], reach);
    if (distance < EDGES_CUT_WITHIN * reach) lines.emplace_back(distance, dirs_[i]);
  }
  std::stable_sort(lines.begin(), lines.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  const auto set = [&](std::size_t line, const std::pair<double, glm::dvec2>& found) {
    clip.dir[line] = glm::vec3(found.second.x * frame.u + found.second.y * frame.v);
    clip.distance[line] = static_cast<float>(found.first);
  };
  if (lines.empty()) return clip;
  clip.reach = static_cast<float>(reach);
  set(0, lines.front());
  const auto second = std::find_if(lines.begin(), lines.end(), [&](const auto& line) {
    return glm::dot(line.second, lines.front().second) < COS_SECOND;
  });
  if (second != lines.end()) set(1, *second);
  return clip;
}

}  // namespace splatray
