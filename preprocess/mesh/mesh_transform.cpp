#include "preprocess/mesh/mesh_transform.h"

#include <cmath>
#include <utility>

#include "preprocess/base/unit_or_zero.h"

namespace splatray {

void transform_ellipse(const glm::dmat3& linear, const glm::vec3& normal, PointEllipse& ellipse,
                       float& radius) {
  if (!(ellipse.half_length > 0.0F)) return;
  const double half_length = ellipse.half_length,
               half_width = half_length / static_cast<double>(ellipse.aspect);
  const glm::dvec3 short_axis(ellipse.short_axis);
  const glm::dvec3 a = linear * (half_length * unit_or_zero(glm::cross(glm::dvec3(normal), short_axis))),
                   b = linear * (half_width * short_axis);
  const double turn = 0.5 * std::atan2(2.0 * glm::dot(a, b), glm::dot(a, a) - glm::dot(b, b));
  const glm::dvec3 longer = std::cos(turn) * a + std::sin(turn) * b,
                   shorter = std::cos(turn) * b - std::sin(turn) * a;
  const double length = glm::length(longer), width = glm::length(shorter);
  constexpr double MOST_ASPECT = 1e6;  // of what is flattened to a line
  ellipse.short_axis = glm::vec3(unit_or_zero(shorter));
  ellipse.aspect = static_cast<float>(width > length / MOST_ASPECT ? length / width : MOST_ASPECT);
  ellipse.half_length = radius = static_cast<float>(length);
}

void transform_mesh(Mesh& mesh, const glm::dmat4& to_world) {
  const glm::dmat3 linear(to_world);
  const double volume = glm::determinant(linear);
  // The cofactor matrix is the inverse transpose times the determinant, and exists for flattening transforms
  // too.
  const glm::dmat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                             glm::cross(linear[0], linear[1]));
  const double side = volume < 0.0 ? -1.0 : 1.0;
  for (glm::dvec3& position : mesh.vertices.position) {
    position = glm::dvec3(to_world * glm::dvec4(position, 1.0));
  }
  for (float& radius : mesh.vertices.radius) {
    radius = static_cast<float>(radius * std::cbrt(std::abs(volume)));
  }
  for (std::size_t i = 0; i < mesh.vertices.ellipse.size(); ++i)
    transform_ellipse(linear, mesh.vertices.normal[i], mesh.vertices.ellipse[i], mesh.vertices.radius[i]);
  for (glm::vec3& normal : mesh.vertices.normal) {
    const glm::dvec3 turned = side * (cofactors * glm::dvec3(normal));
    const double length = glm::length(turned);
    normal = length > 0.0 ? glm::vec3(turned / length) : glm::vec3(0.0F);
  }
  for (Station& station : mesh.vertices.stations) {
    if (station.sensor_world)
      station.sensor_world = glm::dvec3(to_world * glm::dvec4(*station.sensor_world, 1.0));
  }
  if (volume < 0.0) {
    for (glm::uvec3& triangle : mesh.triangles) {
      std::swap(triangle.y, triangle.z);
    }
  }
}

}  // namespace splatray
