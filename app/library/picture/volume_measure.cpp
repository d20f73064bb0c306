#include "app/library/picture/volume_measure.h"

#include <array>
#include <cmath>

#include "app/library/cut/volume.h"
#include "app/library/measure/least_squares.h"
#include "app/library/measure/outline_crossing.h"
#include "app/library/shot/scene_source.h"
#include "engine/base/crs.h"
#include "engine/base/error.h"
#include "engine/base/number_text.h"
#include "engine/image/view.h"

namespace splatray {
namespace {

CutPlane ground_axes(const Scene& scene) {
  const glm::dmat3 axes = upright_axes(scene.up);
  return {axes[0], -axes[2], axes[1], 0.0};
}

glm::dvec2 on_ground(const CutPlane& axes, const glm::dvec3& place) {
  return {glm::dot(place, axes.right), glm::dot(place, axes.top)};
}

[[noreturn]] void refuse_base(const std::string& what) {
  throw Error(ExitCode::failed, "cannot measure a volume: " + what);
}

VolumeBase base_of_plane(const CutPlane& axes, const GivenBase& given) {
  constexpr double LEAST_COSINE = 0.1;
  const glm::dvec3 normal = glm::normalize(given.normal);
  const double cosine = glm::dot(normal, axes.toward);
  if (!(std::abs(cosine) >= LEAST_COSINE))
    refuse_base("found a plane across " + number_text(given.normal) +
                ", which stands upright, expected one that lies below or above a surface");
  const glm::dvec2 slope = -on_ground(axes, normal) / cosine;
  return {glm::dot(given.place, axes.toward) - glm::dot(slope, on_ground(axes, given.place)), slope};
}

/// The plane whose heights are nearest to those of places.
VolumeBase base_of_places(const CutPlane& axes, const std::vector<glm::dvec3>& places) {
  const glm::dvec3 middle = places.front();  // far from the origin squares would lose the plane
  LeastSquares<3> sums;
  for (const glm::dvec3& place : places) {
    const glm::dvec2 at = on_ground(axes, place - middle);
    sums.add({1.0, at.x, at.y}, glm::dot(place - middle, axes.toward));
  }
  const auto plane = sums.solve();
  if (!plane) refuse_base("the outline's corners lie in a line, expected three that do not");
  const glm::dvec2 slope((*plane)[1], (*plane)[2]);
  return {(*plane)[0] + glm::dot(middle, axes.toward) - glm::dot(slope, on_ground(axes, middle)), slope};
}

/// The bases of corners each of which is off by a standard deviation.
std::vector<VolumeBase> shifted_bases(const CutPlane& axes, const std::vector<SurfacePoint>& corners) {
  std::vector<glm::dvec3> places;
  for (const SurfacePoint& corner : corners) places.push_back(corner.place);
  std::vector<VolumeBase> bases;
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (const glm::dvec3& error : {corners[i].error, corners[i].sideways}) {
      if (error == glm::dvec3(0.0)) continue;
      std::vector<glm::dvec3> moved = places;
      moved[i] += error;
      bases.push_back(base_of_places(axes, moved));
    }
  return bases;
}

Scene earlier_scene(const Scene& scene, const std::filesystem::path& path) {
  Request request;
  request.source.inputs = {path};
  LoadedScene loaded = load_scene(request, {});
  const unsigned found = describe_crs(loaded.scene.crs).epsg, wanted = describe_crs(scene.crs).epsg;
  if (found > 0 && wanted > 0 && found != wanted)
    refuse_base("found '" + path.string() + "' in EPSG:" + std::to_string(found) +
                ", expected the scan's EPSG:" + std::to_string(wanted));
  return std::move(loaded.scene);
}

}  // namespace

void take_volume(const Scene& scene, const Region& region, const GivenBase& given, Measure& measure) {
  VolumeGround ground{scene, region, ground_axes(scene), {}};
  const CutPlane& axes = ground.axes;
  std::vector<glm::dvec3> places;
  for (const SurfacePoint& point : measure.points) {
    places.push_back(point.place);
    ground.outline.push_back(on_ground(axes, point.place));
  }
  if (const std::string crossing = crossing_of(ground.outline); !crossing.empty())
    refuse_base("the outline's side " + crossing + ", expected the places in their order around it");
  std::optional<Scene> earlier;
  VolumeBase base{given.height};
  std::vector<VolumeBase> shifted;
  if (given.kind == GivenBase::Kind::plane) base = base_of_plane(axes, given);
  if (given.kind == GivenBase::Kind::corners) {
    base = base_of_places(axes, places);
    shifted = shifted_bases(axes, measure.points);
  }
  if (given.kind == GivenBase::Kind::earlier) {
    earlier.emplace(earlier_scene(scene, given.earlier));
    base.earlier = &*earlier;
  }
  if (ground.outline.empty()) {
    ground.outline = outline_of(scene, region, axes);
    ground.is_all = true;
    for (const glm::dvec2& corner : ground.outline) {
      const double height = earlier ? glm::dot(scene.bounds_min_world, axes.toward)
                                    : base.height + glm::dot(base.slope, corner);
      measure.points.push_back({corner.x * axes.right + corner.y * axes.top + height * axes.toward});
    }
  }
  measure.volume = volume_over(ground, base, shifted);
  if (!measure.volume)
    refuse_base("found no surface over the outline" + std::string(earlier ? " in both scans" : "") +
                ", expected one in the region");
}

}  // namespace splatray
