#include "app/library/picture/measuring.h"

#include <cassert>

#include "app/library/measure/surface_point.h"
#include "app/library/picture/aimed_ray.h"
#include "engine/base/error.h"
#include "engine/base/number_text.h"

namespace splatray {
namespace {

SurfacePoint first_hit(SceneOnDevice& shown, const Scene& scene, const Region& region,
                       const GivenPlace& given) {
  Settings settings;
  settings.region = region;
  const glm::dvec3 along = glm::normalize(*given.direction);
  const std::optional<AimedRay> ray = aim_ray(scene.root, given.place, along);
  std::vector<RayHit> hits;
  if (ray) hits = shown.tracer().intersect(shown.look(), {&ray->query, 1}, settings);
  if (hits.empty() || hits[0].object == NO_OBJECT)
    throw Error(ExitCode::failed, "the ray from " + number_text(given.place) + " towards " +
                                      number_text(*given.direction) + " meets nothing");
  const double t_world = (ray->start + double{hits[0].t}) * scene.root.unit_world;
  return point_on_ray(scene, {given.place + t_world * along, glm::dvec3(hits[0].normal)}, along);
}

}  // namespace

Measure take_measure(const Scene& scene, const Region& region, const GivenMeasure& given,
                     SceneOnDevice* shown) {
  Measure measure{given.kind, {}};
  for (const GivenPlace& place : given.places) {
    assert(!place.direction || shown != nullptr);
    const std::optional<SurfacePoint> point =
        place.direction ? first_hit(*shown, scene, region, place) : nearest_point(scene, region, place.place);
    if (!point) throw Error(ExitCode::failed, "found nothing in the region, expected something to measure");
    measure.points.push_back(*point);
  }
  if (!is_fitted(given.kind)) return measure;
  measure.fit = radius_near(scene, region, measure.points[0].place, given.reach, given.kind);
  if (!measure.fit)
    throw Error(ExitCode::failed, std::string("cannot fit a ") + measure_name(given.kind) + " within " +
                                      number_text(given.reach) + " of " +
                                      number_text(measure.points[0].place) +
                                      ": what is there lies in a plane, or is too little");
  return measure;
}

}  // namespace splatray
