#include <algorithm>
#include <limits>

#include "app/library/api/guard.h"
#include "app/library/api/scene_impl.h"
#include "app/library/picture/aimed_ray.h"

namespace splatray::api {
namespace {

constexpr std::size_t RAYS_AT_ONCE = std::size_t{1} << 17;

void check_rays(std::span<const Double3> origins, std::span<const Double3> directions) {
  if (origins.size() != directions.size())
    refuse(
        std::to_string(origins.size()) + " origins and " + std::to_string(directions.size()) + " directions",
        "as many of each");
  for (std::size_t i = 0; i < origins.size(); ++i) {
    if (!finite(origins[i]) || !finite(directions[i]))
      refuse("an origin or direction that is not finite in ray " + std::to_string(i), "three numbers each");
    if (unit(directions[i]) == glm::dvec3(0.0))
      refuse("a direction of length 0 in ray " + std::to_string(i), "any other");
  }
}

void reserve(Hits& hits, std::size_t count) {
  hits.t.resize(count, std::numeric_limits<double>::infinity());
  hits.normal.resize(count, Float3{});
  hits.object.resize(count, -1);
  hits.splat.resize(count, -1);
  hits.point.resize(count, -1);
}

void keep(const Scene::Impl& impl, const RayHit& hit, double start, std::size_t ray, Hits& hits) {
  if (hit.object == NO_OBJECT) return;
  const splatray::Scene& scene = impl.loaded.scene;
  hits.t[ray] = (start + static_cast<double>(hit.t)) * scene.root.unit_world;
  hits.normal[ray] = array(hit.normal);
  hits.object[ray] = static_cast<std::int32_t>(hit.object);
  const std::optional<std::size_t> splat = find_splat(scene, hit);
  if (!splat) return;
  hits.splat[ray] = static_cast<std::int64_t>(*splat);
  if (hit.object < impl.has_points.size() && impl.has_points[hit.object])
    hits.point[ray] = static_cast<std::int64_t>(find_column(scene.columns, COLUMN_POINT)->number(*splat));
}

}  // namespace

Hits trace(const Scene& scene, std::span<const Double3> origins, std::span<const Double3> directions,
           const Progress& progress) {
  return guarded(progress, [&](ProgressRelay& relay) {
    const std::shared_ptr<Scene::Impl> impl = SceneAccess::impl(scene);
    const splatray::Scene& inner = impl->loaded.scene;
    check_rays(origins, directions);
    Hits hits;
    reserve(hits, origins.size());
    for (std::size_t begin = 0; begin < origins.size(); begin += RAYS_AT_ONCE) {
      if (!relay("tracing", static_cast<double>(begin) / static_cast<double>(origins.size())))
        throw Error(ErrorKind::cancelled, "tracing was cancelled");
      std::vector<std::size_t> rays;
      std::vector<RayQuery> queries;
      std::vector<double> starts;
      for (std::size_t i = begin; i < std::min(begin + RAYS_AT_ONCE, origins.size()); ++i) {
        const std::optional<AimedRay> aimed = aim_ray(inner.root, vector(origins[i]), unit(directions[i]));
        if (!aimed) continue;
        rays.push_back(i);
        queries.push_back(aimed->query);
        starts.push_back(aimed->start);
      }
      const std::vector<RayHit> found = impl->on_device(relay, [&](SceneOnDevice& shown) {
        return shown.tracer().intersect(shown.look(), queries, splatray::Settings{});
      });
      for (std::size_t i = 0; i < found.size(); ++i) keep(*impl, found[i], starts[i], rays[i], hits);
    }
    return hits;
  });
}

}  // namespace splatray::api
