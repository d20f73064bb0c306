#include "tests/bench/truth/mesh_truth.h"

#include <optional>

#include "preprocess/mesh/mesh_normals.h"
#include "tests/bench/cases/random_rays.h"
#include "tests/bench/peers/embree_triangles.h"
#include "tests/bench/truth/analytic.h"
#include "tests/bench/truth/pixel_rays.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

/// The first triangle along a ray, in float32.
std::optional<std::size_t> first_triangle(const EmbreeScene& embree, const dvec3& origin, const dvec3& dir) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit ray = embree_ray(primary_query(origin, dir));
  rtcIntersect1(embree.scene(), &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return ray.hit.primID;
}

/// Where the ray meets the triangle's plane, and the normal there.
TruePixel pixel_of(const Mesh& mesh, const std::vector<glm::vec3>& normals, std::size_t triangle,
                   const dvec3& origin, const dvec3& dir) {
  const glm::uvec3& corners = mesh.triangles[triangle];
  const dvec3 a = mesh.vertices.position[corners.x];
  const dvec3 ab = mesh.vertices.position[corners.y] - a;
  const dvec3 ac = mesh.vertices.position[corners.z] - a;
  const dvec3 across = glm::cross(dir, ac);
  const dvec3 from_a = origin - a;
  const double determinant = glm::dot(ab, across);
  const double v = glm::dot(from_a, across) / determinant;
  const dvec3 along = glm::cross(from_a, ab);
  const double w = glm::dot(dir, along) / determinant;
  const dvec3 normal(normal_on_triangle(mesh, normals, triangle, {1.0 - v - w, v, w}));
  return {glm::dot(ac, along) / determinant, glm::dot(normal, dir) > 0.0 ? -normal : normal};
}

}  // namespace

Truth mesh_truth(const Mesh& mesh, const View& view) {
  const std::vector<glm::vec3> normals = corner_normals(mesh, weld_positions(mesh.vertices.position));
  EmbreeScene embree;
  rtcSetSceneFlags(embree.scene(), RTC_SCENE_FLAG_ROBUST);
  embree.build(triangle_geometry(embree.device(), mesh, RootTransform{}));
  const PixelRays rays(view);
  Truth truth{view.width, view.height, 0.0, {}};
  truth.pixels.resize(std::size_t{view.width} * view.height);
  for (std::uint32_t y = 0; y < view.height; ++y) {
    for (std::uint32_t x = 0; x < view.width; ++x) {
      const dvec3 dir = rays.dir_world(x, y);
      const auto triangle = first_triangle(embree, rays.eye_world(), dir);
      if (triangle)
        truth.pixels[std::size_t{y} * view.width + x] =
            pixel_of(mesh, normals, *triangle, rays.eye_world(), dir);
    }
  }
  mark_edges(truth, JUMP_PIXELS * rays.pixel_width_world());
  return truth;
}

}  // namespace splatray::testing
