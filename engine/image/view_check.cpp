#include "engine/image/view_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>

namespace splatray {
namespace {

/// So few that each has some of the points, also of a scan by ten stations seen from one of them.
constexpr int WIDTH = 32, HEIGHT = 24;
constexpr double NEAR = 0.03;         ///< of the points' diagonal
constexpr double PLANE_STEP = 0.03;   ///< of the same, between parallel planes that are told apart
constexpr double NORMAL_STEPS = 4.0;  ///< of a normal's components from 0 to 1, that are told apart
/// A view from outside is closed from here on: 0.75 to 0.94 of flats, courtyards and half a room, 0.5 of a street.
constexpr double CLOSED_BEHIND = 0.65;
/// The same where the sides were measured: most of what is seen is the back of what the scanner saw.
constexpr double MOST_BEHIND = 0.5;
/// A doll's house opens from here on: one room had 0.89 with its sides right, 0.08 with these turned.
constexpr double OPEN_BEHIND = 0.15;
constexpr double DOLL_BACKGROUND = 0.9, INSIDE_BACKGROUND = 0.75, INSIDE_PLANE = 0.7, INSIDE_NEAR = 0.25;

/// The foremost point of each pixel, by number.
struct CoarsePicture {
  std::array<std::uint32_t, WIDTH * HEIGHT> point;
  std::array<double, WIDTH * HEIGHT> depth;
  static constexpr std::uint32_t NOTHING = std::numeric_limits<std::uint32_t>::max();
};

/// The share of the picture that is empty, by blocks of 4 x 4 pixels, as points of a thin scan do not lie in each pixel.
double background_of(const CoarsePicture& picture) {
  constexpr int BLOCK = 4, ACROSS = WIDTH / BLOCK, DOWN = HEIGHT / BLOCK;
  std::array<bool, ACROSS * DOWN> met{};
  for (int y = 0; y < HEIGHT; ++y)
    for (int x = 0; x < WIDTH; ++x)
      if (picture.point[static_cast<std::size_t>(y * WIDTH + x)] != CoarsePicture::NOTHING)
        met[static_cast<std::size_t>(y / BLOCK * ACROSS + x / BLOCK)] = true;
  return share_of(static_cast<std::size_t>(std::count(met.begin(), met.end(), false)), met.size());
}

bool faces_away(const PointSample& sample, std::size_t i, const glm::dvec3& eye) {
  return glm::dot(sample.normal[i], eye - sample.position[i]) < 0.0;
}

CoarsePicture coarse_picture(const PointSample& sample, const Camera& camera, bool cutaway) {
  const glm::dvec3 ahead = glm::normalize(camera.target - camera.eye);
  const glm::dvec3 right = glm::normalize(glm::cross(ahead, camera.up)), up = glm::cross(right, ahead);
  const double scale = 0.5 * HEIGHT / std::tan(0.5 * camera.fov_y_deg * std::numbers::pi / 180.0);
  CoarsePicture picture;
  picture.point.fill(CoarsePicture::NOTHING);
  picture.depth.fill(std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const glm::dvec3 q = sample.position[i] - camera.eye;
    const double depth = glm::dot(q, ahead);
    if (!(depth > 0.0) || (cutaway && faces_away(sample, i, camera.eye))) continue;
    const double x = 0.5 * WIDTH + scale * glm::dot(q, right) / depth,
                 y = 0.5 * HEIGHT - scale * glm::dot(q, up) / depth;
    if (!(x >= 0.0 && x < WIDTH && y >= 0.0 && y < HEIGHT)) continue;
    const std::size_t pixel = static_cast<std::size_t>(y) * WIDTH + static_cast<std::size_t>(x);
    if (!(depth < picture.depth[pixel])) continue;
    picture.depth[pixel] = depth;
    picture.point[pixel] = static_cast<std::uint32_t>(i);
  }
  return picture;
}

/// The camera half a turn about the vertical through its target away: half a room that is open to one is closed to the other.
Camera from_other_side(Camera camera, const glm::dvec3& up) {
  const glm::dvec3 back = camera.eye - camera.target;
  camera.eye = camera.target + 2.0 * glm::dot(back, up) * up - back;
  return camera;
}

/// Whether each point was seen from a known or found place, so that its surface's front faces there.
bool has_measured_sides(const Scene& scene) {
  return !scene.stations.empty() &&
         std::all_of(scene.stations.begin(), scene.stations.end(),
                     [](const Station& station) { return sensor_place_world(station).has_value(); });
}

bool is_outside(Viewpoint viewpoint) {
  return viewpoint == Viewpoint::front || viewpoint == Viewpoint::oblique;
}

}  // namespace

ViewFigures view_figures(const PointSample& sample, const Camera& camera, bool cutaway) {
  const CoarsePicture picture = coarse_picture(sample, camera, cutaway);
  const double size = diagonal_of(sample);
  std::size_t met = 0, behind = 0, near = 0, largest = 0;
  std::map<std::array<int, 4>, std::size_t> planes;
  for (std::size_t pixel = 0; pixel < picture.point.size(); ++pixel) {
    const std::uint32_t i = picture.point[pixel];
    if (i == CoarsePicture::NOTHING) continue;
    ++met;
    behind += faces_away(sample, i, camera.eye) ? 1 : 0;
    near += picture.depth[pixel] < NEAR * size ? 1 : 0;
    const glm::dvec3 normal = glm::round(NORMAL_STEPS * sample.normal[i]);
    const double height = glm::dot(sample.normal[i], sample.position[i] - camera.eye);
    const std::array<int, 4> plane{static_cast<int>(normal.x), static_cast<int>(normal.y),
                                   static_cast<int>(normal.z),
                                   static_cast<int>(std::round(height / (PLANE_STEP * size)))};
    largest = std::max(largest, ++planes[plane]);
  }
  return {background_of(picture), share_of(behind, met), share_of(largest, met), share_of(near, met)};
}

const char* view_fault_name(ViewFault fault) {
  static constexpr std::array NAMES = {"none", "closed", "background", "one plane", "in a wall"};
  return NAMES[static_cast<std::size_t>(fault)];
}

CheckedView check_view(const Scene& scene, const PointSample& sample, Viewpoint viewpoint) {
  const Camera camera = viewpoint_camera(scene, viewpoint, double(WIDTH) / HEIGHT, {});
  const ViewFigures all = view_figures(sample, camera, false);
  if (is_outside(viewpoint)) {
    const bool closed = has_measured_sides(scene)
                            ? all.behind > MOST_BEHIND
                            : all.behind > CLOSED_BEHIND && is_built(sample, upright_axes(scene.up));
    return {viewpoint, closed ? ViewFault::closed : ViewFault::none, all.behind};
  }
  if (viewpoint == Viewpoint::dollhouse) {
    const double behind = std::max(
        all.behind, view_figures(sample, from_other_side(camera, glm::normalize(scene.up)), false).behind);
    if (behind < OPEN_BEHIND) return {viewpoint, ViewFault::closed, behind};
    const double background = view_figures(sample, camera, true).background;
    if (background > DOLL_BACKGROUND) return {viewpoint, ViewFault::background, background};
    return {viewpoint, ViewFault::none, behind};
  }
  if (all.near > INSIDE_NEAR) return {viewpoint, ViewFault::in_wall, all.near};
  if (all.background > INSIDE_BACKGROUND) return {viewpoint, ViewFault::background, all.background};
  return {viewpoint, all.plane > INSIDE_PLANE ? ViewFault::one_plane : ViewFault::none, all.plane};
}

std::vector<CheckedView> check_views(const Scene& scene, SceneKind kind, Viewpoint first) {
  if (kind == SceneKind::none || kind == SceneKind::camera) return {{first}};
  const PointSample sample = main_parts(sample_points(scene));
  std::vector<Viewpoint> views{first};
  if (kind == SceneKind::sweep && first == Viewpoint::inside) views.push_back(Viewpoint::oblique);
  views.push_back(first == Viewpoint::dollhouse ? Viewpoint::inside : Viewpoint::dollhouse);
  std::vector<CheckedView> checked;
  for (const Viewpoint viewpoint : views) {
    checked.push_back(check_view(scene, sample, viewpoint));
    if (checked.back().fault == ViewFault::none) return checked;
  }
  checked.push_back(checked.front());
  return checked;
}

}  // namespace splatray
