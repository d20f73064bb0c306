#include "engine/image/framing/sensor_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "engine/base/rank.h"

namespace splatray {
namespace {

/// Fractions of the points at each end, and of a frame's parts: two rooms fill 0.98 and 1, a disc 0.92, a dragon's range image 0.83, a
/// head 0.65.
constexpr double FRAME_ENDS = 0.005, FILLED = 0.95;
constexpr double BAND_FILLED = 0.5;  ///< of the parts at each end of a band, where a thing ends in a point
/// A band's width over its height: rings of a scanner with a camera's field are 3 to 4 times as wide as high, a sofa 2.4.
constexpr double BAND_ASPECT = 3.0;
constexpr double BAND_CROP_MOST = 2.0;

/// What one place saw, on the plane at distance 1 ahead of it.
struct SensorFrame {
  glm::dvec2 low{0.0}, high{0.0};  ///< to the right and up, without FRAME_ENDS of the points at each end
  double filled = 0.0;             ///< the fraction of its parts, 16 x 12, in which points lie
  double ends = 0.0;               ///< the same of the eighth at its left or right end, whichever is less
};

/// A frame is parted into these, row by row.
constexpr int ACROSS = 16, DOWN = 12;
using FrameParts = std::array<bool, ACROSS * DOWN>;

double filled_between(const FrameParts& met, int first, int last) {
  std::size_t filled = 0;
  for (int y = 0; y < DOWN; ++y)
    for (int x = first; x < last; ++x) filled += met[static_cast<std::size_t>(y * ACROSS + x)] ? 1 : 0;
  return share_of(filled, static_cast<std::size_t>((last - first) * DOWN));
}

SensorFrame sensor_frame(const PointSample& sample, const glm::dvec3& sensor, const glm::dvec3& ahead,
                         const glm::dvec3& up) {
  const glm::dvec3 right = glm::normalize(glm::cross(ahead, up)), above = glm::cross(right, ahead);
  std::vector<glm::dvec2> places;
  std::array<std::vector<double>, 2> along;
  for (const glm::dvec3& point : sample.position) {
    const glm::dvec3 q = point - sensor;
    const double depth = glm::dot(q, ahead);
    if (!(depth > 0.0)) return {};
    places.emplace_back(glm::dot(q, right) / depth, glm::dot(q, above) / depth);
    for (int axis = 0; axis < 2; ++axis) along[static_cast<std::size_t>(axis)].push_back(places.back()[axis]);
  }
  if (places.empty()) return {};
  SensorFrame frame;
  frame.low = {value_at(along[0], FRAME_ENDS), value_at(along[1], FRAME_ENDS)};
  frame.high = {value_at(along[0], 1.0 - FRAME_ENDS), value_at(along[1], 1.0 - FRAME_ENDS)};
  FrameParts met{};
  for (const glm::dvec2& place : places) {
    const glm::dvec2 cell = glm::dvec2(ACROSS, DOWN) * (place - frame.low) / (frame.high - frame.low);
    if (cell.x >= 0.0 && cell.x < ACROSS && cell.y >= 0.0 && cell.y < DOWN)
      met[static_cast<std::size_t>(static_cast<int>(cell.y) * ACROSS + static_cast<int>(cell.x))] = true;
  }
  frame.filled = filled_between(met, 0, ACROSS);
  frame.ends = std::min(filled_between(met, 0, ACROSS / 8), filled_between(met, ACROSS - ACROSS / 8, ACROSS));
  return frame;
}

/// By how much a frame may be cropped to an aspect; 0 = it is to be seen whole.
double most_crop(const SensorFrame& frame, double aspect) {
  if (frame.filled >= FILLED) return CROP_MOST;
  const glm::dvec2 size = frame.high - frame.low;
  return size.x > std::max(aspect, BAND_ASPECT) * size.y && frame.ends >= BAND_FILLED ? BAND_CROP_MOST : 0.0;
}

}  // namespace

bool fill_with_frame(const PointSample& sample, double aspect, Camera& camera) {
  const double distance = glm::distance(camera.eye, camera.target);
  glm::dvec3 ahead = (camera.target - camera.eye) / distance;
  SensorFrame frame = sensor_frame(sample, camera.eye, ahead, camera.up);
  if (most_crop(frame, aspect) == 0.0) return false;
  const glm::dvec2 middle = 0.5 * (frame.low + frame.high);
  const glm::dvec3 right = glm::normalize(glm::cross(ahead, camera.up));
  ahead = glm::normalize(ahead + middle.x * right + middle.y * glm::cross(right, ahead));
  frame = sensor_frame(sample, camera.eye, ahead, camera.up);
  const double crop = most_crop(frame, aspect);
  if (crop == 0.0) return false;
  camera.target = camera.eye + distance * ahead;
  const glm::dvec2 half = 0.5 * (frame.high - frame.low) / glm::dvec2(aspect, 1.0);
  const double slope = std::max(std::min(half.x, half.y), std::max(half.x, half.y) / crop);
  camera.fov_y_deg = std::clamp(glm::degrees(2.0 * std::atan(slope)), 1.0, SENSOR_MOST_DEG);
  return true;
}

}  // namespace splatray
