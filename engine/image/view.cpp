#include "engine/image/view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/base/error.h"

namespace splatray {
namespace {

/// Beyond this distance, in root edges, primary rays start on a plane through the root instead of at the eye:
/// float32 ray parameters measured from a farther eye would be coarser than half a lattice unit.
constexpr double FAR_EDGES = 4.0;
/// Squares of longer ray directions leave float32's range.
constexpr double MAX_DISTANCE_ROOT = 1e18;

constexpr double ROOT_EDGE = 1U << LATTICE_BITS;
/// From this distance, in root edges, all of a root faces the same way.
constexpr double PARALLEL_EDGES = 1e6;

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void refuse(const char* sentence) { throw Error(ExitCode::usage, sentence); }

void check_view(const View& view) {
  const Camera& camera = view.camera;
  if (view.width == 0 || view.height == 0)
    refuse("the picture's size is zero, expected at least 1 pixel each way");
  if (!is_finite(camera.eye) || !is_finite(camera.target) || !is_finite(camera.up))
    refuse("the camera's eye, target or up is not finite, expected three numbers each");
  if (camera.eye == camera.target) refuse("the camera's eye is its target, expected two different points");
  if (!std::isfinite(camera.ortho_height) || camera.ortho_height < 0.0)
    refuse("the camera's orthographic height is negative or not finite, expected 0 or more");
  if (!(glm::length(camera.lens_shift) <= MOST_LENS_SHIFT))
    refuse(
        "the camera's lens shift is not finite or beyond 100 pictures, expected two numbers such as 0.1,0");
  if (!(camera.pixel_aspect >= 1.0 / MOST_PIXEL_ASPECT && camera.pixel_aspect <= MOST_PIXEL_ASPECT))
    refuse("the camera's pixel aspect is outside 0.01 to 100, expected for example 1");
  if (camera.panorama && view.width != 2 * std::uint64_t{view.height})
    throw Error(ExitCode::usage,
                "found a panorama of " + std::to_string(view.width) + "x" + std::to_string(view.height) +
                    " pixels, expected one twice as wide as high, such as " +
                    std::to_string(2 * std::uint64_t{view.height}) + "x" + std::to_string(view.height));
  if (camera.ortho_height == 0.0 && !(camera.fov_y_deg > 0.0 && camera.fov_y_deg < 180.0))
    refuse("the field of view is outside (0, 180) degrees, expected for example 40");
  const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
  const double up_length = glm::length(camera.up);
  if (!(up_length > 0.0) || glm::length(glm::cross(forward, camera.up / up_length)) < 1e-9)
    refuse("the camera's up is zero or parallel to its view direction, expected a direction across it");
}

/// Rays of one direction from the plane through the root's centre; only what lies before the eye plane is
/// seen.
void set_orthographic_rays(const ImagePlane& plane, double distance, FrameParams& frame) {
  frame.origin_00 = plane.eye + plane.corner + distance * plane.forward;
  frame.origin_dx = plane.dx;
  frame.origin_dy = plane.dy;
  frame.dir_00 = plane.forward;
  frame.depth_offset = static_cast<float>(distance);
  frame.t_min = static_cast<float>(-distance);
}

/// Rays from the eye.
void set_near_rays(const ImagePlane& plane, FrameParams& frame) {
  frame.origin_00 = plane.eye;
  frame.dir_00 = plane.forward + plane.corner;
  frame.dir_dx = plane.dx;
  frame.dir_dy = plane.dy;
}

/// The same rays, from the plane through the root's centre, `distance` before the eye.
void set_far_rays(const ImagePlane& plane, double distance, FrameParams& frame) {
  const glm::dvec3 corner = distance * (plane.forward + plane.corner);
  frame.origin_00 = plane.eye + corner;
  frame.origin_dx = frame.dir_dx = distance * plane.dx;
  frame.origin_dy = frame.dir_dy = distance * plane.dy;
  frame.dir_00 = corner;
  frame.depth_per_dir = 1.0F;
  frame.t_min = -std::numeric_limits<float>::infinity();
}

/// Rays from the eye in all directions.
void set_panorama_rays(const ImagePlane& plane, const View& view, FrameParams& frame) {
  frame.origin_00 = plane.eye;
  frame.dir_00 = plane.forward;
  frame.dir_dx = glm::normalize(plane.dx);
  frame.dir_dy = glm::normalize(plane.dy);
  frame.panorama = vec4(1.0 / view.width, 1.0 / view.height, 0.0, 0.0);
}

void set_rays(const Scene& scene, const View& view, FrameParams& frame) {
  const ImagePlane plane = image_plane(scene.root, view);
  const glm::dvec3 center(0.5 * ROOT_EDGE);
  const double distance = glm::dot(center - plane.eye, plane.forward);
  const double extent = glm::length(plane.corner) * std::max(1.0, std::abs(distance));
  if (!(glm::length(center - plane.eye) < MAX_DISTANCE_ROOT) || !(extent < MAX_DISTANCE_ROOT))
    refuse("the camera is too far away or too wide, expected within 1e11 sizes of the scene");
  if (view.camera.panorama) {
    if (glm::length(center - plane.eye) > FAR_EDGES * ROOT_EDGE)
      refuse(
          "the panorama's eye is far outside the scene, expected a place in it or within four of its sizes");
    return set_panorama_rays(plane, view, frame);
  }
  if (view.camera.ortho_height > 0.0) return set_orthographic_rays(plane, distance, frame);
  if (distance > FAR_EDGES * ROOT_EDGE) return set_far_rays(plane, distance, frame);
  set_near_rays(plane, frame);
}

/// Orthographic cameras and panoramas have no lens.
void set_lens(const Scene& scene, const Camera& camera, const Settings& settings, FrameParams& frame) {
  if (!(settings.lens_radius_world > 0.0) || camera.ortho_height > 0.0 || camera.panorama) return;
  const glm::dvec3 to_target = camera.target - camera.eye, forward = glm::normalize(to_target);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::normalize(camera.up)));
  const double radius = settings.lens_radius_world / scene.root.unit_world;
  const double focus = settings.focus_world > 0.0 ? settings.focus_world : glm::length(to_target);
  frame.lens_u = radius * right;
  frame.lens_v = radius * glm::cross(forward, right);
  frame.focus = static_cast<float>(focus / scene.root.unit_world);
}

}  // namespace

namespace {

/// Pixels of a panorama as angles.
ImagePlane panorama_plane(const RootTransform& root, const View& view, const glm::dvec3& right) {
  const glm::dvec3 up = glm::normalize(view.camera.up);
  return {root.to_root(view.camera.eye), glm::cross(up, right), glm::dvec3(0.0),
          right * (2.0 * std::numbers::pi / view.width), -up * (std::numbers::pi / view.height)};
}

}  // namespace

ImagePlane image_plane(const RootTransform& root, const View& view) {
  const Camera& camera = view.camera;
  const bool ortho = camera.ortho_height > 0.0;
  const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::normalize(camera.up)));
  if (camera.panorama) return panorama_plane(root, view, right);
  const glm::dvec3 down = glm::cross(forward, right);
  const double height = ortho ? camera.ortho_height / root.unit_world
                              : 2.0 * std::tan(camera.fov_y_deg * std::numbers::pi / 360.0);
  const double pixel = height / view.height;
  ImagePlane plane{
      root.to_root(camera.eye), forward, {}, right * (pixel * camera.pixel_aspect), down * pixel};
  const glm::dvec2 ahead = (0.5 + camera.lens_shift) * glm::dvec2(view.width, view.height);
  plane.corner = -(ahead.x * plane.dx + ahead.y * plane.dy);
  return plane;
}

glm::dmat3 upright_axes(const glm::dvec3& up) {
  const glm::dvec3 unit_up = glm::normalize(up);
  const glm::dvec3 x_axis(1.0, 0.0, 0.0), y_axis(0.0, 1.0, 0.0);
  const glm::dvec3 reference = std::abs(unit_up.x) < 0.999 ? x_axis : y_axis;
  const glm::dvec3 right = glm::normalize(reference - unit_up * glm::dot(reference, unit_up));
  return {right, unit_up, glm::cross(right, unit_up)};
}

glm::dvec3 up_across(const glm::dvec3& up, const glm::dvec3& view_dir) {
  const glm::dmat3 axes = upright_axes(up);
  return glm::length(glm::cross(axes[1], view_dir)) > 1e-6 * glm::length(view_dir) ? axes[1] : -axes[2];
}

FrameParams make_frame_params(const Scene& scene, const View& view, const Settings& settings) {
  check_view(view);
  FrameParams frame{};
  set_rays(scene, view, frame);
  frame.width = view.width;
  frame.tile_width = view.made().width;
  frame.height = view.height;
  frame.tile_height = view.made().height;
  frame.tile_x = view.made().x;
  frame.tile_y = view.made().y;
  frame.root_unit_world = static_cast<float>(scene.root.unit_world);
  frame.sample_begin = frame.mean_begin = settings.sample_offset;
  frame.sample_end = settings.sample_offset + settings.samples;
  frame.seed = settings.seed;
  frame.max_bounces = settings.max_bounces;
  frame.background = settings.transparent ? vec3(0.0F) : settings.background.value_or(vec3(-1.0F));
  frame.clamp = settings.clamp;
  frame.kappa = settings.kappa;
  frame.delta = static_cast<float>(settings.delta_world / scene.root.unit_world);

  set_region(scene.root, settings.region, frame);
  set_lens(scene, view.camera, settings, frame);
  const ImagePlane plane = image_plane(scene.root, view);
  frame.cut_eye = frame.panorama.x == 0.0F && view.camera.ortho_height > 0.0
                      ? plane.eye - PARALLEL_EDGES * ROOT_EDGE * plane.forward
                      : plane.eye;
  const double reach =
      settings.reach_world > 0.0 ? settings.reach_world : REACH_SHARE * scene.diagonal_world();
  frame.reach = static_cast<float>(reach / scene.root.unit_world);

  const glm::dmat3 axes = upright_axes(scene.up);
  const double angle = 2.0 * std::numbers::pi * settings.environment_turn;
  frame.environment_up = axes[1];
  frame.environment_right = std::cos(angle) * axes[0] - std::sin(angle) * axes[2];
  return frame;
}

void set_media(FrameParams& frame, std::span<const Material> materials) {
  for (const Material& material : materials) {
    if ((material.flags & MATERIAL_DIELECTRIC) == 0) continue;
    frame.media[material.mask_bit / 4][static_cast<glm::length_t>(material.mask_bit % 4)] = material.ior;
    frame.absorption[material.mask_bit] = vec4(material.absorption * frame.root_unit_world, 0.0F);
  }
}

}  // namespace splatray
