#include "preprocess/mesh/mesh_transform.h"

#include <cmath>
#include <utility>

#include "preprocess/base/unit_or_zero.h"

namespace splatray {

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
  for (glm::vec3& normal : mesh.vertices.normal) {
    const glm::dvec3 turned = side * (cofactors * glm::dvec3(normal));
    const double length = glm::length(turned);
    normal = length > 0.0 ? glm::vec3(turned / length) : glm::vec3(0.0F);
  }
  for (float& radius : mesh.vertices.radius) {
    radius = static_cast<float>(radius * std::cbrt(std::abs(volume)));
  }
  for (PointEllipse& ellipse : mesh.vertices.ellipse) {
    ellipse.short_axis = glm::vec3(unit_or_zero(linear * glm::dvec3(ellipse.short_axis)));
    ellipse.half_length = static_cast<float>(ellipse.half_length * std::cbrt(std::abs(volume)));
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
