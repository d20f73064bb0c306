#include <algorithm>
#include <cmath>
#include <utility>

#include "data/shapes.h"

namespace splatray {

OrientedPoints rectangle(const Sampling& sampling, glm::dvec3 corner, glm::dvec3 edge_u, glm::dvec3 edge_v) {
  const glm::dvec3 normal = glm::normalize(glm::cross(edge_u, edge_v));
  OrientedPoints cloud;
  for (const glm::dvec2& uv : unit_square(sampling)) {
    cloud.position.push_back(corner + uv.x * edge_u + uv.y * edge_v);
    cloud.normal.push_back(normal);
  }
  return cloud;
}

OrientedPoints grid(const Sampling& sampling, glm::dvec3 corner, glm::dvec3 edge_u, glm::dvec3 edge_v) {
  const double aspect = glm::length(edge_u) / glm::length(edge_v);
  const double rows = std::max(1.0, std::round(std::sqrt(static_cast<double>(sampling.count) / aspect)));
  const double columns = std::max(1.0, std::round(rows * aspect));
  const glm::dvec3 normal = glm::normalize(glm::cross(edge_u, edge_v));
  OrientedPoints cloud;
  for (double row = 0.5; row < rows; ++row) {
    for (double column = 0.5; column < columns; ++column) {
      cloud.position.push_back(corner + column / columns * edge_u + row / rows * edge_v);
      cloud.normal.push_back(normal);
    }
  }
  return cloud;
}

SurfacePatch rectangle_surface(std::string object, glm::dvec3 corner, glm::dvec3 edge_u, glm::dvec3 edge_v) {
  return {std::move(object), glm::length(glm::cross(edge_u, edge_v)),
          [=](const Sampling& sampling) { return rectangle(sampling, corner, edge_u, edge_v); }};
}

Model box(const std::string& object, glm::dvec3 size, bool inwards) {
  Model model;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      glm::dvec3 normal(0.0);
      glm::dvec3 edge_u(0.0);
      glm::dvec3 edge_v(0.0);
      normal[axis] = side;
      edge_u[(axis + 1) % 3] = size[(axis + 1) % 3];
      edge_v[(axis + 2) % 3] = size[(axis + 2) % 3];
      if ((side > 0.0) == inwards) std::swap(edge_u, edge_v);
      const glm::dvec3 corner = 0.5 * (normal * size - edge_u - edge_v);
      model.push_back(rectangle_surface(object, corner, edge_u, edge_v));
    }
  }
  return model;
}

}  // namespace splatray
