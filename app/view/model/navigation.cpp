#include "app/view/model/navigation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace splatray {
namespace {

using std::numbers::pi;

constexpr double ZOOM_PER_NOTCH = 0.85;     ///< of the distance
constexpr double MOST_NOTCHES = 50.0;       ///< of one zoom
constexpr double FLY_RADII_A_SECOND = 0.5;  ///< scene radii
constexpr double FLY_FAST = 5.0;
constexpr double WALK_RADII_A_SECOND = 0.1;
constexpr double LONGEST_FLIGHT_S = 0.25;  ///< a stall must not carry the camera away
constexpr double LOOK_SHARE = 0.5;         ///< of the angle that the same drag orbits
/// Distances and orthographic heights that zoom reaches, scene radii.
constexpr double NEAREST_RADII = 1e-6, FARTHEST_RADII = 100.0;
/// How far from the scene's centre the pivot goes, scene radii; with FARTHEST_RADII within what make_frame_params takes.
constexpr double LOST_RADII = 1000.0;
/// Radius that preprocess gives points that all lie in one place.
constexpr double LONE_RADIUS_WORLD = 1.0;
/// Coordinates this many rounding steps apart still give directions of three digits.
constexpr double STEPS_APART = 1e4;
/// Below this cosine of the elevation the azimuth is read from the camera's up, not from its view direction.
constexpr double POLE_COSINE = 1e-4;
/// Vertical field of view with which an orthographic picture is framed, degrees.
constexpr double NARROW_FOV_DEG = 0.01;

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool finite(const glm::dvec2& v) { return std::isfinite(v.x) && std::isfinite(v.y); }

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// The least length that float64 resolves well at both points.
double resolved_length(const glm::dvec3& a, const glm::dvec3& b) {
  return STEPS_APART * std::numeric_limits<double>::epsilon() * std::max(largest(a), largest(b));
}

glm::dvec3 center_of(const Document& document) {
  return 0.5 * (document.bounds_min_world + document.bounds_max_world);
}

/// Where the camera stands about its pivot: angles in the axes of the scene, radians.
struct Stand {
  double azimuth;    ///< from the front towards the scene's right
  double elevation;  ///< above the horizon, -pi/2..pi/2
  double distance;   ///< world units, > 0
};

/// Unit axes of the picture.
struct PictureAxes {
  glm::dvec3 right, top, back;
  double distance;  ///< eye to pivot
};

PictureAxes picture_axes(const Camera& camera) {
  const glm::dvec3 to_eye = camera.eye - camera.target;
  const double distance = glm::length(to_eye);
  const glm::dvec3 back = to_eye / distance;
  const glm::dvec3 right = glm::normalize(glm::cross(camera.up, back));
  return {right, glm::cross(back, right), back, distance};
}

/// Picture axes of a stand without roll; defined at the poles too.
PictureAxes picture_axes(const Stand& stand, const glm::dvec3& up) {
  const glm::dmat3 axes = upright_axes(up);
  const glm::dvec3 level = std::sin(stand.azimuth) * axes[0] + std::cos(stand.azimuth) * axes[2];
  const glm::dvec3 back = std::cos(stand.elevation) * level + std::sin(stand.elevation) * axes[1];
  const glm::dvec3 top = std::cos(stand.elevation) * axes[1] - std::sin(stand.elevation) * level;
  return {glm::cross(top, back), top, back, stand.distance};
}

Stand stand_of(const Camera& camera, const glm::dvec3& up) {
  const glm::dmat3 axes = upright_axes(up);
  const PictureAxes picture = picture_axes(camera);
  const glm::dvec3 back = glm::transpose(axes) * picture.back;
  const glm::dvec3 top = glm::transpose(axes) * picture.top;
  const bool pole = std::hypot(back.x, back.z) < POLE_COSINE;
  const glm::dvec3 level = pole ? top * (back.y > 0.0 ? -1.0 : 1.0) : back;
  return {std::atan2(level.x, level.z), std::asin(std::clamp(back.y, -1.0, 1.0)), picture.distance};
}

/// World size of a pixel at the pivot's depth.
double pixel_world(const Camera& camera, double distance, glm::dvec2 size_px) {
  const double height = camera.ortho_height > 0.0 ? camera.ortho_height
                                                  : 2.0 * distance * std::tan(camera.fov_y_deg * pi / 360.0);
  return height / size_px.y;
}

/// Whether make_frame_params takes the camera.
bool sees(const Camera& camera) {
  if (!finite(camera.eye) || !finite(camera.target) || !finite(camera.up)) return false;
  const glm::dvec3 back = glm::normalize(camera.eye - camera.target);
  const bool lens = camera.ortho_height > 0.0 ? std::isfinite(camera.ortho_height)
                                              : camera.fov_y_deg > 0.0 && camera.fov_y_deg < 180.0;
  return lens && finite(back) && glm::length(glm::cross(back, glm::normalize(camera.up))) > 1e-6;
}

/// The camera a gesture starts from: the document's, or one beside the pivot where that sees nothing.
Camera start_of(const Document& document) {
  Camera camera = document.camera;
  if (sees(camera)) return camera;
  const glm::dmat3 axes = upright_axes(up_of(document));
  camera = Camera{};
  camera.target = finite(document.camera.target) ? document.camera.target : center_of(document);
  camera.eye = camera.target + 2.0 * scene_radius_world(document) * axes[2];
  camera.up = axes[1];
  camera.fov_y_deg = DEFAULT_FOV_Y_DEG;
  return camera;
}

/// Takes the camera over unless it sees nothing or leaves the scene behind; moves an orthographic one out of the scene.
void finish(Document& document, Camera camera) {
  const glm::dvec3 center = center_of(document);
  const double off_center = glm::length(camera.target - center);
  const bool lost = off_center > LOST_RADII * scene_radius_world(document) &&
                    off_center > glm::length(document.camera.target - center);
  if (lost || !sees(camera)) return;
  if (camera.ortho_height > 0.0) {
    const glm::dvec3 back = glm::normalize(camera.eye - camera.target);
    const double outside = 2.0 * scene_radius_world(document) + off_center;
    camera.eye = camera.target + back * std::max(outside, glm::length(camera.eye - camera.target));
  }
  if (sees(camera)) document.camera = camera;
}

void stand_about(Camera& camera, const Stand& stand, const glm::dvec3& up) {
  const PictureAxes axes = picture_axes(stand, up);
  camera.eye = camera.target + stand.distance * axes.back;
  camera.up = axes.top;
}

/// The stand after a drag; `gain`: of half a turn over the picture's smaller edge.
Stand turned(Stand stand, glm::dvec2 drag_px, glm::dvec2 size_px, double gain) {
  const double angle_per_px = gain * pi / std::min(size_px.x, size_px.y);
  stand.azimuth -= angle_per_px * drag_px.x;
  stand.elevation = std::clamp(stand.elevation + angle_per_px * drag_px.y, -0.5 * pi, 0.5 * pi);
  return stand;
}

/// `length` times `factor`, but no farther out of the range that zoom reaches than it is.
double scaled(const Document& document, double length, double factor) {
  const double radius = scene_radius_world(document);
  const double resolved = resolved_length(document.camera.target, document.bounds_max_world);
  const double nearest = std::max(NEAREST_RADII * radius, resolved);
  return std::clamp(length * factor, std::min(nearest, length), std::max(FARTHEST_RADII * radius, length));
}

void move(Camera& camera, const glm::dvec3& shift) {
  camera.eye += shift;
  camera.target += shift;
}

/// What framing_camera looks at of a scene.
Scene framed_scene(const Document& document) {
  Scene scene;
  scene.up = up_of(document);
  scene.bounds_min_world = document.bounds_min_world;
  scene.bounds_max_world = document.bounds_max_world;
  scene.root.unit_world = NEAREST_RADII * scene_radius_world(document);
  return scene;
}

}  // namespace

double scene_radius_world(const Document& document) {
  const double radius = 0.5 * glm::length(document.bounds_max_world - document.bounds_min_world);
  const double resolved = resolved_length(document.bounds_min_world, document.bounds_max_world);
  return std::max(radius > 0.0 ? radius : LONE_RADIUS_WORLD, resolved);
}

glm::dvec3 point_under(const Camera& camera, glm::dvec2 position_px, glm::dvec2 size_px) {
  const PictureAxes axes = picture_axes(camera);
  const glm::dvec2 offset = pixel_world(camera, axes.distance, size_px) * (position_px - 0.5 * size_px);
  return camera.target + offset.x * axes.right - offset.y * axes.top;
}

std::optional<glm::dvec2> place_in_picture(const Camera& camera, const glm::dvec3& point_world,
                                           glm::dvec2 size_px) {
  const PictureAxes axes = picture_axes(camera);
  const glm::dvec3 from_eye = point_world - camera.eye;
  const double depth = -glm::dot(from_eye, axes.back);
  if (!(depth > 0.0)) return {};
  const glm::dvec3 at = camera.ortho_height > 0.0 ? from_eye : from_eye * (axes.distance / depth);
  const glm::dvec2 offset(glm::dot(at, axes.right), -glm::dot(at, axes.top));
  return 0.5 * size_px + offset / pixel_world(camera, axes.distance, size_px);
}

void orbit(Document& document, glm::dvec2 drag_px, glm::dvec2 size_px,
           std::optional<glm::dvec3> about_world) {
  if (!finite(drag_px)) return;
  Camera camera = start_of(document);
  const glm::dvec3 about = about_world && finite(*about_world) ? *about_world : camera.target;
  const PictureAxes before = picture_axes(camera);
  const PictureAxes after =
      picture_axes(turned(stand_of(camera, up_of(document)), drag_px, size_px, 1.0), up_of(document));
  const auto turned_about = [&](const glm::dvec3& point) {
    const glm::dvec3 v = point - about;
    return about + glm::dot(v, before.right) * after.right + glm::dot(v, before.top) * after.top +
           glm::dot(v, before.back) * after.back;
  };
  camera.target = turned_about(camera.target);
  camera.eye = camera.target + after.distance * after.back;
  camera.up = after.top;
  finish(document, camera);
}

void pan(Document& document, glm::dvec2 from_px, glm::dvec2 to_px, glm::dvec2 size_px) {
  Camera camera = start_of(document);
  move(camera, point_under(camera, from_px, size_px) - point_under(camera, to_px, size_px));
  finish(document, camera);
}

void zoom(Document& document, double notches, glm::dvec2 position_px, glm::dvec2 size_px) {
  if (!std::isfinite(notches) || !finite(position_px)) return;
  Camera camera = start_of(document);
  const double wanted = std::pow(ZOOM_PER_NOTCH, std::clamp(notches, -MOST_NOTCHES, MOST_NOTCHES));
  const glm::dvec3 fixed = point_under(camera, position_px, size_px);
  if (camera.ortho_height > 0.0) {
    const double height = scaled(document, camera.ortho_height, wanted);
    move(camera, (1.0 - height / camera.ortho_height) * (fixed - camera.target));
    camera.ortho_height = height;
  } else {
    const double distance = glm::length(camera.eye - camera.target);
    const double factor = scaled(document, distance, wanted) / distance;
    camera.eye = fixed + factor * (camera.eye - fixed);
    camera.target = fixed + factor * (camera.target - fixed);
  }
  finish(document, camera);
}

void look(Document& document, glm::dvec2 drag_px, glm::dvec2 size_px) {
  if (document.camera.ortho_height > 0.0) return orbit(document, drag_px, size_px);
  if (!finite(drag_px)) return;
  Camera camera = start_of(document);
  const glm::dvec3 eye = camera.eye;
  stand_about(camera, turned(stand_of(camera, up_of(document)), drag_px, size_px, LOOK_SHARE),
              up_of(document));
  move(camera, eye - camera.eye);
  finish(document, camera);
}

void fly(Document& document, glm::dvec3 direction, double seconds, bool fast) {
  if (!finite(direction) || !std::isfinite(seconds)) return;
  Camera camera = start_of(document);
  const PictureAxes axes = picture_axes(camera);
  const double radii =
      FLY_RADII_A_SECOND * (fast ? FLY_FAST : 1.0) * std::clamp(seconds, 0.0, LONGEST_FLIGHT_S);
  const glm::dvec3 way = radii * scene_radius_world(document) * glm::clamp(direction, -1.0, 1.0);
  move(camera, way.x * axes.right + way.y * axes.top);
  if (camera.ortho_height > 0.0)
    camera.ortho_height =
        scaled(document, camera.ortho_height, std::exp(-radii * std::clamp(direction.z, -1.0, 1.0)));
  else
    move(camera, -way.z * axes.back);
  finish(document, camera);
}

void walk(Document& document, glm::dvec3 direction, double seconds, double speed) {
  if (!finite(direction) || !std::isfinite(seconds) || !std::isfinite(speed)) return;
  Camera camera = start_of(document);
  const glm::dvec3 up = upright_axes(up_of(document))[1];
  const glm::dvec3 right = picture_axes(camera).right, ahead = glm::cross(up, right);
  const double way =
      WALK_RADII_A_SECOND * speed * std::clamp(seconds, 0.0, LONGEST_FLIGHT_S) * scene_radius_world(document);
  const glm::dvec3 step = glm::clamp(direction, -1.0, 1.0);
  move(camera, way * (step.x * right + step.y * up + step.z * ahead));
  finish(document, camera);
}

void set_pivot(Document& document, const glm::dvec3& point_world) {
  if (!finite(point_world)) return;
  Camera camera = start_of(document);
  const PictureAxes axes = picture_axes(camera);
  const double depth = glm::dot(camera.eye - point_world, axes.back);
  if (!(depth > resolved_length(point_world, camera.eye))) return;
  const double distance = camera.ortho_height > 0.0 ? axes.distance : depth;
  camera.target = point_world;
  camera.eye = point_world + distance * axes.back;
  finish(document, camera);
}

void frame_all(Document& document, double aspect) {
  Camera camera = start_of(document);
  const bool ortho = camera.ortho_height > 0.0;
  const double fov_y_deg = ortho ? NARROW_FOV_DEG : camera.fov_y_deg;
  const PictureAxes axes = picture_axes(camera);
  const Camera framed =
      framing_camera(framed_scene(document), aspect, fov_y_deg, {axes.right, axes.top, axes.back});
  if (ortho) camera.ortho_height = pixel_world(framed, glm::length(framed.eye - framed.target), {1.0, 1.0});
  const double distance = ortho ? scene_radius_world(document) : glm::length(framed.eye - framed.target);
  camera.target = framed.target;
  camera.eye = framed.target + distance * axes.back;
  finish(document, camera);
}

void set_axis_view(Document& document, AxisView view) {
  Camera camera = start_of(document);
  Stand stand{0.0, 0.0, glm::length(camera.eye - camera.target)};
  switch (view) {
    case AxisView::front:
      break;
    case AxisView::back:
      stand.azimuth = pi;
      break;
    case AxisView::right:
      stand.azimuth = 0.5 * pi;
      break;
    case AxisView::left:
      stand.azimuth = -0.5 * pi;
      break;
    case AxisView::top:
      stand.elevation = 0.5 * pi;
      break;
    case AxisView::bottom:
      stand.elevation = -0.5 * pi;
      break;
  }
  stand_about(camera, stand, up_of(document));
  finish(document, camera);
}

void toggle_orthographic(Document& document) {
  Camera camera = start_of(document);
  const PictureAxes axes = picture_axes(camera);
  if (camera.ortho_height > 0.0) {
    if (!(camera.fov_y_deg > 0.0 && camera.fov_y_deg < 180.0)) camera.fov_y_deg = DEFAULT_FOV_Y_DEG;
    const double distance = 0.5 * camera.ortho_height / std::tan(camera.fov_y_deg * pi / 360.0);
    camera.ortho_height = 0.0;
    camera.eye = camera.target + distance * axes.back;
  } else {
    camera.ortho_height = pixel_world(camera, axes.distance, {1.0, 1.0});
  }
  finish(document, camera);
}

void set_up_axis(Document& document, const glm::dvec3& up) {
  if (!finite(up) || !(glm::length(up) > 0.0)) return;
  document.request.look.up = glm::normalize(up);
  Camera camera = start_of(document);
  stand_about(camera, stand_of(camera, up_of(document)), up_of(document));
  finish(document, camera);
}

void drag_light(const Document& document, glm::dvec2 position_px, glm::dvec2 size_px, SceneLight& light) {
  if (!finite(position_px)) return;
  const Camera camera = start_of(document);
  const glm::dvec3 center = center_of(document), under = point_under(camera, position_px, size_px);
  const bool ortho = camera.ortho_height > 0.0;
  const glm::dvec3 dir = glm::normalize(ortho ? camera.target - camera.eye : under - camera.eye);
  const glm::dvec3 origin = ortho ? under + (camera.eye - camera.target) : camera.eye;
  const double radius = scene_radius_world(document), nearest = glm::dot(center - origin, dir);
  const glm::dvec3 passing = origin + nearest * dir - center;
  const double half_chord = std::sqrt(std::max(0.0, radius * radius - glm::dot(passing, passing)));
  const bool inside = glm::length(origin - center) < radius;
  const glm::dvec3 touched = glm::normalize(passing + (inside ? half_chord : -half_chord) * dir);
  if (!(glm::length(touched) > 0.5)) return;  // too far away for numbers
  light.position =
      light.kind == LIGHT_POINT ? center + glm::length(light.position - center) * touched : touched;
}

}  // namespace splatray
