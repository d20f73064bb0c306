#include "app/library/camera_path.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace splatray {
namespace {

/// Change of a key's value per frame: the slope between its neighbours; at an end, between it and its neighbour.
template <typename Value>
Value slope(const CameraPath& path, std::size_t key, Value Camera::*member) {
  const CameraKey& before = path[key == 0 ? 0 : key - 1];
  const CameraKey& after = path[std::min(key + 1, path.size() - 1)];
  return (after.camera.*member - before.camera.*member) / double(after.frame - before.frame);
}

/// The spline between a key and the next in Hermite form; `s` in [0, 1] is the share of the way.
template <typename Value>
Value interpolate(const CameraPath& path, std::size_t key, double s, Value Camera::*member) {
  const double frames = path[key + 1].frame - path[key].frame;
  const Value from = path[key].camera.*member, to = path[key + 1].camera.*member;
  const Value leave = slope(path, key, member) * frames, arrive = slope(path, key + 1, member) * frames;
  const double r = 1.0 - s;
  return from * ((1.0 + 2.0 * s) * r * r) + to * (s * s * (3.0 - 2.0 * s)) + leave * (s * r * r) -
         arrive * (s * s * r);
}

}  // namespace

Camera camera_at(const CameraPath& path, std::uint32_t frame) {
  assert(!path.empty() && frame >= path.front().frame && frame <= path.back().frame);
  const auto next =
      std::find_if(path.begin(), path.end(), [=](const CameraKey& key) { return key.frame >= frame; });
  if (next->frame == frame) return next->camera;
  const auto key = static_cast<std::size_t>(next - path.begin()) - 1;
  const double s = double(frame - path[key].frame) / (next->frame - path[key].frame);
  return {interpolate(path, key, s, &Camera::eye),          interpolate(path, key, s, &Camera::target),
          interpolate(path, key, s, &Camera::up),           interpolate(path, key, s, &Camera::fov_y_deg),
          interpolate(path, key, s, &Camera::ortho_height), interpolate(path, key, s, &Camera::lens_shift),
          interpolate(path, key, s, &Camera::pixel_aspect), next->camera.panorama};
}

Camera turned_camera(const Camera& camera, const glm::dvec3& up, double turns) {
  if (turns == 0.0) return camera;  // bit for bit: target + (eye - target) need not be the eye
  const glm::dvec3 axis = glm::normalize(up);
  const double angle = 2.0 * std::numbers::pi * turns;
  const auto turned = [&](const glm::dvec3& v) {
    const glm::dvec3 along = axis * glm::dot(axis, v);
    return along + (v - along) * std::cos(angle) + glm::cross(axis, v) * std::sin(angle);
  };
  Camera result = camera;
  result.eye = camera.target + turned(camera.eye - camera.target);
  result.up = turned(camera.up);
  return result;
}

}  // namespace splatray
