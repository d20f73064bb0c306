/// Documents to navigate in: ordinary, tiny, huge, millimetres at UTM coordinates, and a single point.
#pragma once
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "app/view/model/document.h"

namespace splatray {

/// A document whose scene is a box of `size_world` about `center_world`, seen from the front, 3 sizes away.
inline Document box_document(const glm::dvec3& center_world, double size_world) {
  Document document;
  document.bounds_min_world = center_world - 0.5 * size_world;
  document.bounds_max_world = center_world + 0.5 * size_world;
  const double distance = size_world > 0.0 ? 3.0 * size_world : 1.0;
  document.camera = {
      center_world + glm::dvec3(0.1, 0.2, 1.0) * distance, center_world, {0.0, 1.0, 0.0}, 40.0, 0.0};
  return document;
}

struct NamedDocument {
  std::string name;
  Document document;
};

inline std::vector<NamedDocument> navigated_documents() {
  return {{"ordinary", box_document({1.0, 2.0, 3.0}, 2.0)},
          {"tiny", box_document({1e-7, 0.0, 0.0}, 1e-6)},
          {"huge", box_document({0.0, 1e8, 0.0}, 1e9)},
          {"millimetres at UTM", box_document({5.6e5, 5.9e6, 120.0}, 0.05)},
          {"one point", box_document({1.0, 2.0, 3.0}, 0.0)}};
}

/// Where a world point lies in a picture, pixels; own maths, to check point_under against.
inline glm::dvec2 projected(const Camera& camera, const glm::dvec3& point, glm::dvec2 size_px) {
  const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up)), top = glm::cross(right, forward);
  const glm::dvec3 offset = point - camera.eye;
  const double half_height =
      camera.ortho_height > 0.0
          ? 0.5 * camera.ortho_height
          : glm::dot(offset, forward) * std::tan(camera.fov_y_deg * std::numbers::pi / 360.0);
  const double scale = 0.5 * size_px.y / half_height;
  return 0.5 * size_px + scale * glm::dvec2(glm::dot(offset, right), -glm::dot(offset, top));
}

}  // namespace splatray
