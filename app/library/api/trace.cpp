#include <algorithm>
#include <limits>

#include "app/library/api/guard.h"
#include "app/library/api/scene_impl.h"
#include "app/library/picture/aimed_ray.h"
#include "engine/scene/wide/wide_tree.h"

namespace splatray::api {
namespace {

constexpr std::size_t RAYS_AT_ONCE = std::size_t{1} << 17;

/// Rays as they are given, in numbers of either size.
template <typename Vector>
struct Given {
  std::span<const Vector> origins, directions;
  std::span<const double> ends;

  [[nodiscard]] std::size_t size() const { return origins.size(); }
  [[nodiscard]] Double3 origin(std::size_t i) const { return wide(origins[i]); }
  [[nodiscard]] Double3 direction(std::size_t i) const { return wide(directions[i]); }
  [[nodiscard]] double end(std::size_t i) const {
    return ends.empty() ? std::numeric_limits<double>::infinity() : ends[ends.size() == 1 ? 0 : i];
  }

 private:
  static Double3 wide(const Vector& v) { return {v[0], v[1], v[2]}; }
};

template <typename Vector>
void check_rays(const Given<Vector>& rays) {
  const std::size_t count = rays.size();
  if (count != rays.directions.size())
    refuse(std::to_string(count) + " origins and " + std::to_string(rays.directions.size()) + " directions",
           "as many of each");
  if (rays.ends.size() > 1 && rays.ends.size() != count)
    refuse(std::to_string(rays.ends.size()) + " of t_max for " + std::to_string(count) + " rays",
           "one of each ray, one of all, or none");
  for (std::size_t i = 0; i < count; ++i) {
    if (!finite(rays.origin(i)) || !finite(rays.direction(i)))
      refuse("an origin or direction that is not finite in ray " + std::to_string(i), "three numbers each");
    if (unit(rays.direction(i)) == glm::dvec3(0.0))
      refuse("a direction of length 0 in ray " + std::to_string(i), "any other");
    if (!(rays.end(i) >= 0.0))
      refuse("t_max of " + std::to_string(rays.end(i)) + " in ray " + std::to_string(i), "0 and more");
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
  const std::optional<std::size_t> splat = find_splat(scene, hit.first);
  if (!splat) return;
  hits.splat[ray] = static_cast<std::int64_t>(*splat);
  if (hit.object < impl.has_points.size() && impl.has_points[hit.object])
    hits.point[ray] = static_cast<std::int64_t>(find_column(scene.columns, COLUMN_POINT)->number(*splat));
}

/// Calls take(ray, start, hit) for each ray that meets the scene's cube before its end.
template <typename Vector, typename Take>
void trace_rays(const Scene& scene, const Given<Vector>& given, std::uint32_t blend, ProgressRelay& relay,
                const Take& take) {
  const std::shared_ptr<Scene::Impl> impl = SceneAccess::impl(scene);
  const RootTransform& root = impl->loaded.scene.root;
  check_rays(given);
  splatray::Settings settings;
  settings.blend = blend;
  for (std::size_t begin = 0; begin < given.size(); begin += RAYS_AT_ONCE) {
    if (!relay("tracing", static_cast<double>(begin) / static_cast<double>(given.size())))
      throw Error(ErrorKind::cancelled, "tracing was cancelled");
    std::vector<std::size_t> rays;
    std::vector<RayQuery> queries;
    std::vector<double> starts;
    for (std::size_t i = begin; i < std::min(begin + RAYS_AT_ONCE, given.size()); ++i) {
      std::optional<AimedRay> aimed = aim_ray(root, vector(given.origin(i)), unit(given.direction(i)));
      if (!aimed) continue;
      const double left = given.end(i) / root.unit_world - aimed->start;
      if (!(left > 0.0)) continue;
      if (blend == BLEND_ANY)
        aimed->query.t_max = std::max(static_cast<float>(left), std::numeric_limits<float>::min());
      rays.push_back(i);
      queries.push_back(aimed->query);
      starts.push_back(aimed->start);
    }
    const std::vector<RayHit> found = impl->on_device(relay, [&](SceneOnDevice& shown) {
      return shown.tracer().intersect(shown.look(), queries, settings);
    });
    for (std::size_t i = 0; i < found.size(); ++i) take(*impl, rays[i], starts[i], found[i]);
  }
}

template <typename Vector>
Hits traced(const Scene& scene, const Given<Vector>& given, const Progress& progress) {
  return guarded(progress, [&](ProgressRelay& relay) {
    Hits hits;
    reserve(hits, given.size());
    trace_rays(scene, given, BLEND_WINDOW, relay,
               [&](const Scene::Impl& impl, std::size_t ray, double start, const RayHit& hit) {
                 const double first =
                     (start + static_cast<double>(hit.t_first)) * impl.loaded.scene.root.unit_world;
                 if (first < given.end(ray)) keep(impl, hit, start, ray, hits);
               });
    return hits;
  });
}

template <typename Vector>
std::vector<std::uint8_t> any_hit(const Scene& scene, const Given<Vector>& given, const Progress& progress) {
  return guarded(progress, [&](ProgressRelay& relay) {
    std::vector<std::uint8_t> met(given.size());
    trace_rays(scene, given, BLEND_ANY, relay,
               [&](const Scene::Impl&, std::size_t ray, double, const RayHit& hit) {
                 met[ray] = hit.object != NO_OBJECT ? 1 : 0;
               });
    return met;
  });
}

}  // namespace

Hits trace(const Scene& scene, std::span<const Double3> origins, std::span<const Double3> directions,
           std::span<const double> t_max, const Progress& progress) {
  return traced(scene, Given<Double3>{origins, directions, t_max}, progress);
}

Hits trace(const Scene& scene, std::span<const Float3> origins, std::span<const Float3> directions,
           std::span<const double> t_max, const Progress& progress) {
  return traced(scene, Given<Float3>{origins, directions, t_max}, progress);
}

std::vector<std::uint8_t> occluded(const Scene& scene, std::span<const Double3> origins,
                                   std::span<const Double3> directions, std::span<const double> t_max,
                                   const Progress& progress) {
  return any_hit(scene, Given<Double3>{origins, directions, t_max}, progress);
}

std::vector<std::uint8_t> occluded(const Scene& scene, std::span<const Float3> origins,
                                   std::span<const Float3> directions, std::span<const double> t_max,
                                   const Progress& progress) {
  return any_hit(scene, Given<Float3>{origins, directions, t_max}, progress);
}

}  // namespace splatray::api
