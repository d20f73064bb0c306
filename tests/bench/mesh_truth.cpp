#include "tests/bench/mesh_truth.h"

#include <embree3/rtcore.h>

#include <memory>
#include <optional>

#include "preprocess/mesh_normals.h"
#include "tests/bench/analytic.h"
#include "tests/bench/pixel_rays.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

/// Finds the first triangle along a ray, in float32.
class TriangleFinder {
 public:
  explicit TriangleFinder(const Mesh& mesh)
      : device_(rtcNewDevice(nullptr), rtcReleaseDevice),
        scene_(rtcNewScene(device_.get()), rtcReleaseScene) {
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    const auto& positions = mesh.vertices.position;
    auto* corners = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), positions.size()));
    std::copy(positions.begin(), positions.end(), corners);
    auto* indices = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), mesh.triangles.size()));
    std::copy(mesh.triangles.begin(), mesh.triangles.end(), indices);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(scene_.get());
  }

  [[nodiscard]] std::optional<std::size_t> first(const dvec3& origin, const dvec3& dir) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query{};
    query.ray.org_x = float(origin.x);
    query.ray.org_y = float(origin.y);
    query.ray.org_z = float(origin.z);
    query.ray.dir_x = float(dir.x);
    query.ray.dir_y = float(dir.y);
    query.ray.dir_z = float(dir.z);
    query.ray.tfar = std::numeric_limits<float>::infinity();
    query.ray.mask = ~0U;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_.get(), &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return query.hit.primID;
  }

 private:
  std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)> device_;
  std::unique_ptr<RTCSceneTy, decltype(&rtcReleaseScene)> scene_;
};

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
  const TriangleFinder finder(mesh);
  const PixelRays rays(view);
  Truth truth{view.width, view.height, 0.0, {}};
  truth.pixels.resize(std::size_t{view.width} * view.height);
  for (std::uint32_t y = 0; y < view.height; ++y) {
    for (std::uint32_t x = 0; x < view.width; ++x) {
      const dvec3 dir = rays.dir_world(x, y);
      const auto triangle = finder.first(rays.eye_world(), dir);
      if (triangle)
        truth.pixels[std::size_t{y} * view.width + x] =
            pixel_of(mesh, normals, *triangle, rays.eye_world(), dir);
    }
  }
  mark_edges(truth, JUMP_PIXELS * rays.pixel_width_world());
  return truth;
}

}  // namespace splatray::testing
