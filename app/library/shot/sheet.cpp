#include "app/library/shot/sheet.h"

#include <algorithm>

namespace splatray {

Camera Sheet::camera() const {
  const glm::dvec2 middle = corner + 0.5 * glm::dvec2(width, -static_cast<double>(height)) * pixel_world;
  // Behind the plane of the cut, which ends rays by itself.
  const double eye = near + (near - far) * 0.01;
  Camera camera;
  camera.eye = middle.x * right + middle.y * top + eye * toward;
  camera.target = camera.eye - std::max(near - far, pixel_world) * toward;
  camera.up = top;
  camera.ortho_height = height * pixel_world;
  return camera;
}

std::vector<HalfSpace> Sheet::planes() const {
  std::vector<HalfSpace> planes;
  if (cuts) planes.push_back({near * toward, -toward});
  if (asked.depth) planes.push_back({far * toward, toward});
  return planes;
}

}  // namespace splatray
