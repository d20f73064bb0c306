#include "app/library/picture/measuring.h"

#include <cassert>

#include "app/library/measure/outline_crossing.h"
#include "app/library/measure/surface_point.h"
#include "app/library/picture/aimed_ray.h"
#include "app/library/picture/volume_measure.h"
#include "engine/base/error.h"
#include "engine/base/number_text.h"

namespace splatray {
namespace {

/// From how far a place is moved to a surface, in spacings of its points: as far as someone may be off who means a point of it. The
/// nearest point of what is farther away is a guess.
constexpr double SNAP_SPACINGS = 4.0;

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

/// The surface's point nearest to a place, if it is that near. A place of a sphere or cylinder may be its middle.
SurfacePoint snapped(const Scene& scene, const Region& region, const GivenMeasure& given,
                     const glm::dvec3& place) {
  const std::optional<SnappedPoint> nearest = nearest_point(scene, region, place);
  if (!nearest) throw Error(ExitCode::failed, "found nothing in the region, expected something to measure");
  const double most = std::max(SNAP_SPACINGS * nearest->spacing_world, given.reach);
  if (nearest->distance_world <= most) return nearest->point;
  throw Error(ExitCode::failed,
              "the place " + number_text(place) + " lies " + short_number(nearest->distance_world) +
                  " from the nearest surface, at " + number_text(nearest->point.place) +
                  "; expected at most " + short_number(most) +
                  ", four spacings of the points there, or a ray, of which the first hit counts");
}

/// Throws Error where an area's outline crosses itself.
void require_inside(const Measure& measure) {
  if (measure.kind != MeasureKind::area) return;
  std::vector<glm::dvec3> places;
  for (const SurfacePoint& point : measure.points) places.push_back(point.place);
  const std::string crossing = crossing_of(flat_outline(places));
  if (!crossing.empty())
    throw Error(ExitCode::failed, "cannot measure an area: the side " + crossing +
                                      ", expected the places in their order around it");
}

}  // namespace

Measure take_measure(const Scene& scene, const Region& region, const GivenMeasure& given,
                     SceneOnDevice* shown) {
  Measure measure{.kind = given.kind, .points = {}, .name = given.name};
  for (const GivenPlace& place : given.places) {
    assert(!place.direction || shown != nullptr);
    // An outline is anywhere above or below the surface, unless the base is laid through its corners.
    if (!place.direction && given.base && given.base->kind != GivenBase::Kind::corners)
      measure.points.push_back({place.place});
    else
      measure.points.push_back(place.direction ? first_hit(*shown, scene, region, place)
                                               : snapped(scene, region, given, place.place));
  }
  require_inside(measure);
  if (given.base) take_volume(scene, region, *given.base, measure);
  if (!is_fitted(given.kind)) return measure;
  if (!fit_near(scene, region, measure.points[0].place, given.reach, measure))
    throw Error(ExitCode::failed, std::string("cannot fit a ") + measure_name(given.kind) + " within " +
                                      number_text(given.reach) + " of " +
                                      number_text(measure.points[0].place) +
                                      (given.kind == MeasureKind::plane
                                           ? ": what is there lies in no plane or in a line, or is too little"
                                           : ": what is there lies in a plane, or is too little"));
  return measure;
}

}  // namespace splatray
