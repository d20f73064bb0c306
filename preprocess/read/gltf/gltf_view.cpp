#include "preprocess/read/gltf/gltf_view.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace splatray {
namespace {

/// The node's array if it is there, checked for length and finite entries; `otherwise` if it is not.
std::vector<double> checked_array(const GltfFile& file, const std::vector<double>& array,
                                  std::vector<double> otherwise, const char* name) {
  if (array.empty()) {
    return otherwise;
  }
  const bool finite = std::all_of(array.begin(), array.end(), [](double v) { return std::isfinite(v); });
  if (array.size() != otherwise.size() || !finite) {
    file.fail("found a node's " + std::string(name) + " with " + std::to_string(array.size()) +
              " entries, expected " + std::to_string(otherwise.size()) + " finite numbers");
  }
  return array;
}

glm::dvec3 unit_axis(const glm::dmat4& to_world, int axis, double sign) {
  const glm::dvec3 direction = sign * glm::dvec3(to_world[axis]);
  const double length = glm::length(direction);
  glm::dvec3 fallback(0.0);
  fallback[axis] = sign;
  return length > 0.0 ? direction / length : fallback;
}

}  // namespace

glm::dmat4 node_transform(const GltfFile& file, const tinygltf::Node& node) {
  if (!node.matrix.empty()) {
    const std::vector<double> m = checked_array(file, node.matrix, std::vector<double>(16, 0.0), "matrix");
    glm::dmat4 matrix;
    for (int i = 0; i < 16; ++i) {
      matrix[i / 4][i % 4] = m[static_cast<std::size_t>(i)];
    }
    return matrix;
  }
  const std::vector<double> t = checked_array(file, node.translation, {0.0, 0.0, 0.0}, "translation");
  const std::vector<double> r = checked_array(file, node.rotation, {0.0, 0.0, 0.0, 1.0}, "rotation");
  const std::vector<double> s = checked_array(file, node.scale, {1.0, 1.0, 1.0}, "scale");
  const glm::dquat rotation(r[3], r[0], r[1], r[2]);
  const double length = glm::length(rotation);
  const glm::dmat3 turn = length > 0.0 ? glm::mat3_cast(rotation / length) : glm::dmat3(1.0);
  glm::dmat4 matrix(1.0);
  for (int axis = 0; axis < 3; ++axis) {
    matrix[axis] = glm::dvec4(turn[axis] * s[static_cast<std::size_t>(axis)], 0.0);
  }
  matrix[3] = glm::dvec4(t[0], t[1], t[2], 1.0);
  return matrix;
}

namespace {

/// Gives a light the size that the node's extras say: "size" as of --light and --sun, or "width" and "height" of a rectangle, which
/// shines along the node's -z with the light's intensity straight ahead. What makes no sense is refused with the scene (scene_check.h).
void apply_size(const tinygltf::Value& extras, const glm::dmat4& to_world, SceneLight& light) {
  const double size = number_in(extras, "size").value_or(0.0);
  light.size = light.kind == LIGHT_DIRECTIONAL ? glm::radians(0.5 * size) : size;
  const auto width = number_in(extras, "width"), height = number_in(extras, "height");
  if (light.kind != LIGHT_POINT || !width || !height) return;
  const glm::dvec3 ahead = unit_axis(to_world, 2, -1.0), right = unit_axis(to_world, 0, 1.0);
  const glm::dvec3 level = glm::normalize(right - glm::dot(right, ahead) * ahead);
  light.kind = LIGHT_RECTANGLE;
  light.size = 0.0;
  light.power /= static_cast<float>(*width * *height);
  light.edge_u = 0.5 * *width * level;
  light.edge_v = 0.5 * *height * glm::cross(ahead, level);
}

}  // namespace

std::optional<SceneLight> read_light(const GltfFile& file, const tinygltf::Node& node,
                                     const glm::dmat4& to_world) {
  const tinygltf::Value* extension = find_extension(node.extensions, "KHR_lights_punctual");
  if (extension == nullptr) {
    return std::nullopt;
  }
  const double index = number_in(*extension, "light").value_or(-1.0);
  const tinygltf::Light& source = file.model.lights[file.checked(
      static_cast<int>(std::clamp(index, -1.0, 1e9)), file.model.lights.size(), "light")];
  SceneLight light;
  glm::vec3 color(1.0F);
  for (std::size_t c = 0; c < std::min<std::size_t>(source.color.size(), 3); ++c) {
    color[static_cast<int>(c)] = static_cast<float>(source.color[c]);
  }
  light.power = color * static_cast<float>(source.intensity);
  if (source.type == "directional") {
    light.kind = LIGHT_DIRECTIONAL;
    light.position = unit_axis(to_world, 2, 1.0);
  } else {
    light.kind = LIGHT_POINT;
    light.position = glm::dvec3(to_world[3]);
  }
  apply_size(node.extras, to_world, light);
  if (light.kind == LIGHT_POINT) light.range = std::max(source.range, 0.0);
  if (source.type == "spot" && light.kind == LIGHT_POINT) {
    light.spot_axis = unit_axis(to_world, 2, -1.0);
    light.spot_inner = source.spot.innerConeAngle;
    light.spot_outer = source.spot.outerConeAngle;
  }
  return light;
}

std::optional<Camera> read_camera(const GltfFile& file, const tinygltf::Node& node,
                                  const glm::dmat4& to_world) {
  if (node.camera < 0) {
    return std::nullopt;
  }
  const tinygltf::Camera& source =
      file.model.cameras[file.checked(node.camera, file.model.cameras.size(), "camera")];
  Camera camera;
  camera.eye = glm::dvec3(to_world[3]);
  camera.target = camera.eye + unit_axis(to_world, 2, -1.0);
  camera.up = unit_axis(to_world, 1, 1.0);
  if (source.type == "orthographic") {
    camera.ortho_height = 2.0 * std::abs(source.orthographic.ymag);
    if (!(camera.ortho_height > 0.0)) {
      file.fail("found an orthographic camera with ymag 0");
    }
    return camera;
  }
  camera.fov_y_deg = glm::degrees(source.perspective.yfov);
  if (!(camera.fov_y_deg > 0.0 && camera.fov_y_deg < 180.0)) {
    file.fail("found a camera with yfov " + std::to_string(source.perspective.yfov) + ", expected 0 to pi");
  }
  return camera;
}

}  // namespace splatray
