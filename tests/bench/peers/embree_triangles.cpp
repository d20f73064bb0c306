#include "tests/bench/peers/embree_triangles.h"

#include <algorithm>

namespace splatray::testing {

RTCGeometry triangle_geometry(RTCDevice device, const Mesh& mesh, const RootTransform& root) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* positions = static_cast<vec3*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3), mesh.vertices.size()));
  auto* triangles = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), mesh.triangles.size()));
  std::transform(mesh.vertices.position.begin(), mesh.vertices.position.end(), positions,
                 [&](const glm::dvec3& world) { return vec3(root.to_root(world)); });
  std::copy(mesh.triangles.begin(), mesh.triangles.end(), triangles);
  return geometry;
}

}  // namespace splatray::testing
