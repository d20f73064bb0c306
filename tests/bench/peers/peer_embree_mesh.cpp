#include "tests/bench/peers/peer_embree_mesh.h"

#include "preprocess/mesh/mesh_normals.h"
#include "tests/bench/peers/embree_triangles.h"

namespace splatray::testing {

EmbreeMesh::EmbreeMesh(const Mesh& mesh, const RootTransform& root)
    : mesh_(mesh), corner_normals_(corner_normals(mesh, weld_positions(mesh.vertices.position))) {
  embree_.build(triangle_geometry(embree_.device(), mesh, root));
}

void EmbreeMesh::trace(std::span<const RayQuery> rays, std::span<RayHit> hits) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  EmbreeBundle<16> bundle(rays);
  bundle.intersect(embree_.scene(), context);
  for (std::size_t lane = 0; lane < rays.size(); ++lane) {
    RayHit& hit = hits[lane] = {};
    hit.t = hit.t_first = bundle.query.ray.tfar[lane];
    hit.object = NO_OBJECT;
    if (bundle.query.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) continue;
    const double u = bundle.query.hit.u[lane];
    const double v = bundle.query.hit.v[lane];
    const vec3 normal =
        normal_on_triangle(mesh_, corner_normals_, bundle.query.hit.primID[lane], {1.0 - u - v, u, v});
    hit.normal = glm::dot(normal, rays[lane].dir) > 0.0F ? -normal : normal;
    hit.object = 0;
    hit.members = 1;
  }
}

void EmbreeMesh::occluded(std::span<const RayQuery> rays, std::span<std::uint8_t> blocked) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  EmbreeBundle<16>(rays).occluded(embree_.scene(), context, blocked);
}

std::uint64_t EmbreeMesh::bytes() const { return embree_.bytes() + sizeof(vec3) * corner_normals_.size(); }

}  // namespace splatray::testing
