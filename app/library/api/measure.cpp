#include <algorithm>
#include <array>
#include <cmath>

#include "app/library/api/guard.h"
#include "app/library/api/request_impl.h"
#include "app/library/api/scene_impl.h"
#include "app/library/picture/measuring.h"
#include "app/library/request/value_text.h"

namespace splatray::api {
namespace {

GivenPlace given_place(const MeasurePlace& place, std::size_t number) {
  const std::string name = " of place " + std::to_string(number);
  if (!finite(place.at)) refuse("coordinates" + name + " that are not finite", "three numbers");
  if (!place.direction) return {vector(place.at), {}};
  const glm::dvec3 direction = finite(*place.direction) ? unit(*place.direction) : glm::dvec3(0.0);
  if (direction == glm::dvec3(0.0))
    refuse("a direction" + name + " that is not finite or of length 0", "any other");
  return {vector(place.at), direction};
}

GivenMeasure given_measure(const Measuring& measuring) {
  const std::optional<MeasureKind> kind = measure_kind(measuring.kind);
  if (!kind)
    refuse("a measure '" + measuring.kind + "'",
           "point, distance, horizontal, vertical, angle, area, sphere, cylinder, plane or volume");
  GivenMeasure given{*kind, {}, std::isfinite(measuring.reach) ? measuring.reach : 0.0};
  for (const MeasurePlace& place : measuring.places)
    given.places.push_back(given_place(place, given.places.size()));
  try {
    if (!measuring.base.empty()) given.base = read_base(measuring.base);
    require_places(given);
  } catch (const Expected& expected) {
    refuse(std::to_string(given.places.size()) + " places of " + measuring.kind + " and a reach of " +
               std::to_string(measuring.reach),
           expected.what);
  }
  return given;
}

const char* unit_name(MeasureUnit unit) {
  constexpr std::array NAMES = {"length", "area", "degrees", "volume"};
  return NAMES[static_cast<std::size_t>(unit)];
}

}  // namespace

Measure measure(const Scene& scene, const Measuring& measuring, const Request& request,
                const Progress& progress) {
  return guarded(progress, [&](ProgressRelay& relay) {
    const std::shared_ptr<Scene::Impl> impl = SceneAccess::impl(scene);
    const splatray::Scene& inner = impl->loaded.scene;
    const GivenMeasure given = given_measure(measuring);
    const Region region = region_of(RequestAccess::inner(request).view.region, inner.up);
    const bool has_rays = std::any_of(given.places.begin(), given.places.end(),
                                      [](const GivenPlace& place) { return place.direction.has_value(); });
    const splatray::Measure found =
        has_rays
            ? impl->on_device(
                  relay, [&](SceneOnDevice& shown) { return take_measure(inner, region, given, &shown); })
            : take_measure(inner, region, given, nullptr);
    Measure result;
    for (const SurfacePoint& point : found.points) result.points.push_back(array(point.place));
    for (const splatray::MeasureValue& value : values_of(found, inner.up))
      result.values.push_back({value.name, value.value, value.within, unit_name(value.unit)});
    return result;
  });
}

}  // namespace splatray::api
