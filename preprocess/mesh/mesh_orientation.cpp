#include "preprocess/mesh/mesh_orientation.h"

#include <algorithm>

namespace splatray {
namespace {

/// Edges by their lower vertex: the upper vertex times 2, plus 1 when the edge is run upwards.
struct EdgeRows {
  std::vector<std::size_t> begin;
  std::vector<std::uint64_t> edges;
};

template <class Body>
void for_each_side(const Mesh& mesh, const std::vector<glm::uint>& weld, const Body& body) {
  for (const glm::uvec3& triangle : mesh.triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      const glm::uint from = weld[triangle[corner]];
      const glm::uint to = weld[triangle[(corner + 1) % 3]];
      if (from != to) {
        body(std::min(from, to), std::max(from, to), from < to);
      }
    }
  }
}

EdgeRows gather_edges(const Mesh& mesh, const std::vector<glm::uint>& weld) {
  EdgeRows rows;
  rows.begin.assign(mesh.vertices.size() + 2, 0);
  for_each_side(mesh, weld, [&](glm::uint low, glm::uint, bool) { ++rows.begin[std::size_t{low} + 2]; });
  for (std::size_t i = 2; i < rows.begin.size(); ++i) {
    rows.begin[i] += rows.begin[i - 1];
  }
  rows.edges.resize(rows.begin.back());
  for_each_side(mesh, weld, [&](glm::uint low, glm::uint high, bool upwards) {
    rows.edges[rows.begin[std::size_t{low} + 1]++] = std::uint64_t{high} * 2 + (upwards ? 1 : 0);
  });
  return rows;
}

double open_edge_share(const Mesh& mesh, const std::vector<glm::uint>& weld) {
  EdgeRows rows = gather_edges(mesh, weld);
  std::size_t edges = 0;
  std::size_t open = 0;
  for (std::size_t vertex = 0; vertex + 1 < rows.begin.size(); ++vertex) {
    const auto begin = rows.edges.begin() + static_cast<std::ptrdiff_t>(rows.begin[vertex]);
    const auto end = rows.edges.begin() + static_cast<std::ptrdiff_t>(rows.begin[vertex + 1]);
    std::sort(begin, end);
    for (auto edge = begin; edge != end;) {
      const std::uint64_t upper = *edge / 2;
      std::ptrdiff_t balance = 0;
      for (; edge != end && *edge / 2 == upper; ++edge) {
        balance += *edge % 2 == 1 ? 1 : -1;
      }
      ++edges;
      open += balance == 0 ? 0 : 1;
    }
  }
  return edges == 0 ? 1.0 : static_cast<double>(open) / static_cast<double>(edges);
}

}  // namespace

MeshOrientation measure_orientation(const Mesh& mesh, const std::vector<glm::uint>& weld) {
  MeshOrientation result;
  if (mesh.triangles.empty()) {
    return result;
  }
  result.open_share = open_edge_share(mesh, weld);
  const glm::dvec3 origin = mesh.vertices.position[mesh.triangles.front().x];
  std::size_t agreeing = 0;
  for (const glm::uvec3& triangle : mesh.triangles) {
    const glm::dvec3 a = mesh.vertices.position[triangle.x] - origin;
    const glm::dvec3 b = mesh.vertices.position[triangle.y] - origin;
    const glm::dvec3 c = mesh.vertices.position[triangle.z] - origin;
    result.signed_volume += glm::dot(a, glm::cross(b, c)) / 6.0;
    if (!mesh.vertices.normal.empty()) {
      const glm::dvec3 given(mesh.vertices.normal[triangle.x] + mesh.vertices.normal[triangle.y] +
                             mesh.vertices.normal[triangle.z]);
      agreeing += glm::dot(given, glm::cross(b - a, c - a)) >= 0.0 ? 1 : 0;
    }
  }
  if (!mesh.vertices.normal.empty()) {
    result.agreeing_share = static_cast<double>(agreeing) / static_cast<double>(mesh.triangles.size());
  }
  return result;
}

}  // namespace splatray
