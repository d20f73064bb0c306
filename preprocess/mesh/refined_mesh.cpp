#include "preprocess/mesh/refined_mesh.h"

#include <algorithm>
#include <cmath>

namespace splatray {
namespace {

constexpr double SHORTEST = 1.0 / 64.0;  // of a triangle's side: parts are halved no further

/// How far the middle of the line between two places of a triangle lies off the surface.
double sag_between(const SmoothTriangle& smooth, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 apart = b - a;
  return 0.125 * glm::length(apart.x * apart.y * smooth.bow[0] + apart.y * apart.z * smooth.bow[1] +
                             apart.z * apart.x * smooth.bow[2]);
}

/// The weights of a place on a part, in whose corners' terms they are given.
glm::dvec3 joined(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& weights) {
  return weights.x * corners[0] + weights.y * corners[1] + weights.z * corners[2];
}

}  // namespace

RefinedMesh::RefinedMesh(const Mesh& mesh, const MeshEdges& edges, const SmoothSurface& surface,
                         double tolerance_world)
    : mesh_(mesh), edges_(edges), tolerance_(tolerance_world) {
  refined_.vertices.position = mesh.vertices.position;
  refined_.texcoord = mesh.texcoord;
  refined_.alpha = mesh.alpha;
  refined_.texture = mesh.texture;
  refined_.triangles.reserve(mesh.triangles.size());
  parts_.reserve(mesh.triangles.size());
  begin_.reserve(mesh.triangles.size() + 1);
  begin_.push_back(0);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const glm::uvec3& corners = mesh.triangles[t];
    divide(surface.triangle(t), t,
           {Corner{{1, 0, 0}, corners.x}, Corner{{0, 1, 0}, corners.y}, Corner{{0, 0, 1}, corners.z}});
    begin_.push_back(static_cast<std::uint32_t>(parts_.size()));
  }
}

void RefinedMesh::divide(const SmoothTriangle& smooth, std::uint32_t triangle,
                         const std::array<Corner, 3>& corners) {
  std::size_t worst = 3;
  double most = tolerance_;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 &a = corners[i].weights, &b = corners[(i + 1) % 3].weights;
    const glm::dvec3 apart = glm::abs(b - a);
    const double sag = sag_between(smooth, a, b);
    if (sag > most && std::max({apart.x, apart.y, apart.z}) > SHORTEST) worst = i, most = sag;
  }
  if (worst == 3) {
    refined_.triangles.emplace_back(corners[0].vertex, corners[1].vertex, corners[2].vertex);
    parts_.push_back({triangle, {corners[0].weights, corners[1].weights, corners[2].weights}});
    return;
  }
  const Corner &from = corners[worst], &to = corners[(worst + 1) % 3], &apex = corners[(worst + 2) % 3];
  const Corner middle = middle_of(smooth, triangle, from, to);
  divide(smooth, triangle, {from, middle, apex});
  divide(smooth, triangle, {middle, to, apex});
}

RefinedMesh::Corner RefinedMesh::middle_of(const SmoothTriangle& smooth, std::uint32_t triangle,
                                           const Corner& a, const Corner& b) {
  const Corner middle{0.5 * (a.weights + b.weights), static_cast<glm::uint>(refined_.vertices.size())};
  refined_.vertices.position.push_back(smooth.place(middle.weights));
  const glm::uvec3& t = mesh_.triangles[triangle];
  const glm::vec3 w(middle.weights);
  if (!refined_.alpha.empty())
    refined_.alpha.push_back(w.x * mesh_.alpha[t.x] + w.y * mesh_.alpha[t.y] + w.z * mesh_.alpha[t.z]);
  if (!refined_.texcoord.empty()) {
    refined_.texcoord.push_back(w.x * mesh_.texcoord[t.x] + w.y * mesh_.texcoord[t.y] +
                                w.z * mesh_.texcoord[t.z]);
  }
  return middle;
}

/// Whether a part's side lies on a side of its triangle at which the surface ends or has a crease.
bool RefinedMesh::ends(std::uint32_t part, std::uint32_t side) const {
  const Part& own = parts_[part];
  const glm::dvec3 &a = own.corners[side], &b = own.corners[(side + 1) % 3];
  for (std::uint32_t i = 0; i < 3; ++i) {
    const auto apex = static_cast<glm::length_t>((i + 2) % 3);
    if (a[apex] == 0.0 && b[apex] == 0.0) return edges_.across(own.triangle, i) == MeshEdges::NONE;
  }
  return false;
}

MeshEdges RefinedMesh::edges(const std::vector<glm::uint>& weld) const {
  return MeshEdges(refined_, weld,
                   [this](std::uint32_t part, std::uint32_t side) { return ends(part, side); });
}

std::uint32_t RefinedMesh::part_at(std::uint32_t triangle, const glm::dvec3& weights) const {
  std::uint32_t found = begin_[triangle];
  double most = -1.0;
  for (std::uint32_t part = begin_[triangle]; part < begin_[triangle + 1] && begin_[triangle + 1] - found > 1;
       ++part) {
    const std::array<glm::dvec3, 3>& c = parts_[part].corners;
    const glm::dvec3 within = glm::inverse(glm::dmat3(c[0], c[1], c[2])) * weights;
    const double least = std::min({within.x, within.y, within.z});
    if (least > most) found = part, most = least;
    if (most >= 0.0) break;
  }
  return found;
}

glm::dvec3 RefinedMesh::weights_of(std::uint32_t part, const glm::dvec3& weights) const {
  return joined(parts_[part].corners, weights);
}

}  // namespace splatray
