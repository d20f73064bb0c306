#include "preprocess/mesh/mesh_normals.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>
#include "preprocess/base/unit_or_zero.h"

namespace splatray {
namespace {

constexpr double LEAST_SUM = 0.4;  ///< of a vertex' weighted normals, in units of its angles' sum

std::uint64_t hash_position(const glm::dvec3& position) {
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis) {
    hash ^= std::bit_cast<std::uint64_t>(position[axis] + 0.0);
    hash *= 0x9E3779B97F4A7C15ULL;
    hash ^= hash >> 32U;
  }
  return hash;
}

bool is_usable(const glm::vec3& normal) {
  const float squared = glm::dot(normal, normal);
  return squared > 0.0F && std::isfinite(squared);
}

glm::dvec3 face_normal(const Mesh& mesh, const glm::uvec3& triangle) {
  const glm::dvec3 a = mesh.vertices.position[triangle.x];
  return unit_or_zero(
      glm::cross(mesh.vertices.position[triangle.y] - a, mesh.vertices.position[triangle.z] - a));
}

double corner_angle(const Mesh& mesh, const glm::uvec3& triangle, int corner) {
  const glm::dvec3 at = mesh.vertices.position[triangle[corner]];
  const glm::dvec3 to = unit_or_zero(mesh.vertices.position[triangle[(corner + 1) % 3]] - at);
  const glm::dvec3 fro = unit_or_zero(mesh.vertices.position[triangle[(corner + 2) % 3]] - at);
  return std::atan2(glm::length(glm::cross(to, fro)), glm::dot(to, fro));
}

/// The face normals times corner angles that meet at each welded position: rows of one array.
struct CornerFans {
  std::vector<std::size_t> begin;   ///< per vertex, +1; used at weld representatives only
  std::vector<glm::vec3> weighted;  ///< angle * face normal
};

CornerFans gather_fans(const Mesh& mesh, const std::vector<glm::uint>& weld) {
  CornerFans fans;
  fans.begin.assign(mesh.vertices.size() + 2, 0);
  for (const glm::uvec3& triangle : mesh.triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      ++fans.begin[weld[triangle[corner]] + 2];
    }
  }
  for (std::size_t i = 2; i < fans.begin.size(); ++i) {
    fans.begin[i] += fans.begin[i - 1];
  }
  fans.weighted.resize(3 * mesh.triangles.size());
  for (const glm::uvec3& triangle : mesh.triangles) {
    const glm::dvec3 normal = face_normal(mesh, triangle);
    for (int corner = 0; corner < 3; ++corner) {
      const std::size_t slot = fans.begin[weld[triangle[corner]] + 1]++;
      fans.weighted[slot] = glm::vec3(normal * corner_angle(mesh, triangle, corner));
    }
  }
  return fans;
}

/// Sum over the fan of those within the crease angle of `face`.
glm::vec3 smooth_normal(const CornerFans& fans, std::size_t vertex, const glm::vec3& face,
                        double crease_cosine) {
  constexpr std::size_t WIDEST_FAN = 256;
  const std::size_t begin = fans.begin[vertex];
  const std::size_t end = fans.begin[vertex + 1];
  glm::vec3 sum{0.0F};
  for (std::size_t i = begin; i < end && end - begin <= WIDEST_FAN; ++i) {
    const glm::vec3& weighted = fans.weighted[i];
    if (glm::dot(weighted, face) > static_cast<float>(crease_cosine) * glm::length(weighted)) {
      sum += weighted;
    }
  }
  return is_usable(sum) ? glm::normalize(sum) : face;
}

glm::vec3 unit(const glm::vec3& vector) {
  const float length = glm::length(vector);
  return length > 1e-6F ? vector / length : glm::vec3(0.0F);
}

/// The normal, turned towards the facet's where it leans more than 20 degrees: discs that lean far out of a
/// facet are seen from behind and shade each other.
glm::vec3 near_facet(const glm::vec3& normal, glm::vec3 facet) {
  constexpr float COS_LEAN = 0.940F;
  constexpr float SIN_LEAN = 0.342F;
  facet *= glm::dot(facet, normal) < 0.0F ? -1.0F : 1.0F;
  const float along = glm::dot(facet, normal);
  const glm::vec3 aside = unit(normal - along * facet);
  if (along >= COS_LEAN || along <= 0.0F || aside == glm::vec3(0.0F)) return normal;
  return COS_LEAN * facet + SIN_LEAN * aside;
}

}  // namespace

std::vector<glm::uint> weld_positions(const std::vector<glm::dvec3>& positions) {
  constexpr glm::uint FREE = 0xFFFFFFFFU;
  std::vector<glm::uint> weld(positions.size());
  std::vector<glm::uint> table(std::bit_ceil(2 * positions.size() + 1), FREE);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    weld[i] = static_cast<glm::uint>(i);
    if (positions[i] != positions[i]) {
      continue;
    }
    std::size_t slot = hash_position(positions[i]) & (table.size() - 1);
    while (table[slot] != FREE && positions[table[slot]] != positions[i]) {
      slot = (slot + 1) & (table.size() - 1);
    }
    if (table[slot] == FREE) {
      table[slot] = static_cast<glm::uint>(i);
    }
    weld[i] = table[slot];
  }
  return weld;
}

std::vector<glm::vec3> vertex_normals(const Mesh& mesh, const std::vector<glm::uint>& weld) {
  const bool all_given = !mesh.vertices.normal.empty() &&
                         std::all_of(mesh.vertices.normal.begin(), mesh.vertices.normal.end(), is_usable);
  std::vector<glm::dvec3> sums(all_given ? 0 : mesh.vertices.size(), glm::dvec3(0.0));
  std::vector<double> angles(sums.size(), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size() && !all_given; ++t) {
    const glm::uvec3& triangle = mesh.triangles[t];
    const glm::dvec3 normal = face_normal(mesh, triangle);
    for (int corner = 0; corner < 3; ++corner) {
      const double angle = corner_angle(mesh, triangle, corner);
      sums[weld[triangle[corner]]] += normal * angle;
      angles[weld[triangle[corner]]] += angle;
    }
  }
  std::vector<glm::vec3> normals(mesh.vertices.size(), glm::vec3(0.0F));
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const bool given = !mesh.vertices.normal.empty() && is_usable(mesh.vertices.normal[i]);
    if (given) {
      normals[i] = glm::normalize(mesh.vertices.normal[i]);
    } else if (glm::length(sums[weld[i]]) > LEAST_SUM * angles[weld[i]]) {
      normals[i] = glm::vec3(unit_or_zero(sums[weld[i]]));
    }
  }
  return normals;
}

std::vector<glm::vec3> corner_normals(const Mesh& mesh, const std::vector<glm::uint>& weld,
                                      double crease_cosine) {
  const CornerFans fans = gather_fans(mesh, weld);
  std::vector<glm::vec3> normals(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const glm::uvec3& triangle = mesh.triangles[t];
    const glm::vec3 face(face_normal(mesh, triangle));
    for (int corner = 0; corner < 3; ++corner) {
      const std::size_t vertex = triangle[corner];
      const bool given = !mesh.vertices.normal.empty() && is_usable(mesh.vertices.normal[vertex]);
      normals[3 * t + static_cast<std::size_t>(corner)] =
          given ? glm::normalize(mesh.vertices.normal[vertex])
                : smooth_normal(fans, weld[vertex], face, crease_cosine);
    }
  }
  return normals;
}

glm::vec3 normal_on_triangle(const Mesh& mesh, const std::vector<glm::vec3>& corners, std::size_t triangle,
                             const glm::dvec3& weights) {
  const glm::vec3 w(weights);
  const glm::vec3* normals = &corners[3 * triangle];
  const glm::vec3 smooth = unit(w.x * normals[0] + w.y * normals[1] + w.z * normals[2]);
  return near_facet(smooth, glm::vec3(face_normal(mesh, mesh.triangles[triangle])));
}

void flip_mesh(Mesh& mesh) {
  for (glm::uvec3& triangle : mesh.triangles) {
    std::swap(triangle.y, triangle.z);
  }
  for (glm::vec3& normal : mesh.vertices.normal) {
    normal = -normal;
  }
}

}  // namespace splatray
