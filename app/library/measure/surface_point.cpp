#include "app/library/measure/surface_point.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "app/library/measure/least_squares.h"
#include "engine/scene/scene_splat.h"

namespace splatray {
namespace {

constexpr std::size_t NEAR = 64;     ///< splats that say how smooth a surface is
constexpr std::size_t AVERAGED = 3;  ///< points whose mean a smoothed surface is as good as
constexpr double SAME_SIDE = 0.5;    ///< cosine of normals of one surface
constexpr double STEEPEST = 0.1;     ///< least cosine of a ray with the surface that its error grows by

struct Near {
  double distance_squared;
  glm::dvec3 place, normal;

  bool operator<(const Near& other) const { return distance_squared < other.distance_squared; }
};

/// The splats of the spot's surface that are nearest.
std::vector<Near> near_splats(const Scene& scene, const SurfaceSpot& spot) {
  std::vector<Near> heap;
  for_each_splat(scene, [&](std::size_t, const SceneSplat& splat) {
    const glm::dvec3 place = splat.center_world(), to = place - spot.place;
    Near near{glm::dot(to, to), place, glm::dvec3(0.0)};
    if (heap.size() == NEAR && !(near < heap.front())) return;
    near.normal = splat.normal();
    if (std::abs(glm::dot(near.normal, spot.normal)) < SAME_SIDE) return;
    heap.push_back(near);
    std::push_heap(heap.begin(), heap.end());
    if (heap.size() <= NEAR) return;
    std::pop_heap(heap.begin(), heap.end());
    heap.pop_back();
  });
  return heap;
}

/// Root of the mean square of what a quadric leaves of the heights of the splats.
double quadric_residual(const std::vector<Near>& near, const SurfaceSpot& spot) {
  const glm::dvec3 any =
      std::abs(spot.normal.x) < 0.6 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 u = glm::normalize(glm::cross(spot.normal, any)), v = glm::cross(spot.normal, u);
  double scale = 0.0;
  for (const Near& splat : near) scale = std::max(scale, std::sqrt(splat.distance_squared));
  if (!(scale > 0.0)) return 0.0;
  const auto row_of = [&](const Near& splat) {
    const glm::dvec3 to = (splat.place - spot.place) / scale;
    const double a = glm::dot(to, u), b = glm::dot(to, v);
    return std::array<double, 6>{1.0, a, b, a * a, a * b, b * b};
  };
  LeastSquares<6> sums;
  for (const Near& splat : near) sums.add(row_of(splat), glm::dot(splat.place - spot.place, spot.normal));
  const auto quadric = sums.solve();
  double squares = 0.0;
  for (const Near& splat : near) {
    double height = glm::dot(splat.place - spot.place, spot.normal);
    if (quadric) {
      const auto row = row_of(splat);
      for (std::size_t i = 0; i < row.size(); ++i) height -= row[i] * (*quadric)[i];
    }
    squares += height * height;
  }
  return std::sqrt(squares / std::max(static_cast<double>(near.size()) - 6.0, 1.0));
}

double surface_error(const Scene& scene, const SurfaceSpot& spot, const std::vector<Near>& near) {
  const double noise = most_noise_world(scene.stations);
  double step = scene.root.unit_world;
  for (const Station& station : scene.stations) step = std::max(step, station.step_world);
  const double residual = near.empty() ? 0.0 : quadric_residual(near, spot);
  return std::sqrt(residual * residual + noise * noise / AVERAGED + step * step / 12.0);
}

/// The mean normal of splats, towards the spot's side: one disc's own is as rough as its points.
glm::dvec3 mean_normal(const std::vector<Near>& near, const SurfaceSpot& spot) {
  glm::dvec3 sum(0.0);
  for (const Near& splat : near)
    sum += glm::dot(splat.normal, spot.normal) < 0.0 ? -splat.normal : splat.normal;
  return near.empty() ? spot.normal : glm::normalize(sum);
}

/// The side of the square that each splat of a disc around the spot has for itself.
double spacing_of(const std::vector<Near>& near) {
  double farthest = 0.0;
  for (const Near& splat : near) farthest = std::max(farthest, splat.distance_squared);
  return std::sqrt(std::numbers::pi * farthest / static_cast<double>(std::max<std::size_t>(near.size(), 1)));
}

/// Centres and normals of the splats in the region within `reach` of a place, and the mean of their squared radii.
struct NearSurface {
  std::vector<glm::dvec3> points, normals;
  double radius_squared = 0.0;
};

NearSurface surface_near(const Scene& scene, const Region& region, const glm::dvec3& place, double reach) {
  NearSurface surface;
  for_each_splat(scene, [&](std::size_t, const SceneSplat& splat) {
    const glm::dvec3 center = splat.center_world();
    if (glm::distance(center, place) > reach || !region.holds(center)) return;
    surface.points.push_back(center);
    surface.normals.push_back(splat.normal());
    surface.radius_squared += splat.radius_world() * splat.radius_world();
  });
  if (!surface.points.empty()) surface.radius_squared /= static_cast<double>(surface.points.size());
  return surface;
}

/// How far smoothing moved what is bent towards its inside: by the mean curvature times a quarter of the square of the radius over which
/// means were taken, which holds as many points as make the residual of the noise; each has the square of a disc's radius.
double smoothed_inwards(const RadiusFit& fit, double noise, double radius_squared) {
  const double bend = (fit.axis == glm::dvec3(0.0) ? 1.0 : 0.5) / fit.radius;
  const double points = std::max(noise * noise / (fit.residual * fit.residual) - 1.0, 0.0);
  return bend * points * radius_squared / (4.0 * std::numbers::pi);
}

}  // namespace

SurfacePoint point_on_ray(const Scene& scene, const SurfaceSpot& spot, const glm::dvec3& direction) {
  const glm::dvec3 along = glm::normalize(direction);
  const double facing = std::max(std::abs(glm::dot(along, spot.normal)), STEEPEST);
  return {spot.place, surface_error(scene, spot, near_splats(scene, spot)) / facing * along};
}

std::optional<SnappedPoint> nearest_point(const Scene& scene, const Region& region, const glm::dvec3& place) {
  double least = std::numeric_limits<double>::infinity();
  SurfaceSpot spot;
  for_each_splat(scene, [&](std::size_t, const SceneSplat& splat) {
    const glm::dvec3 center = splat.center_world(), to = place - center;
    const double radius = splat.radius_world();
    if (glm::length(to) - radius > least || !region.holds(center)) return;
    const glm::dvec3 normal = splat.normal();
    glm::dvec3 on_disc = to - glm::dot(to, normal) * normal;
    if (const double length = glm::length(on_disc); length > radius) on_disc *= radius / length;
    const double distance = glm::distance(to, on_disc);
    if (!(distance < least)) return;
    least = distance;
    spot = {center + on_disc, normal};
  });
  if (!std::isfinite(least)) return {};
  const std::vector<Near> near = near_splats(scene, spot);
  const glm::dvec3 moved = spot.place - place, normal = mean_normal(near, spot);
  const SurfacePoint point{spot.place, surface_error(scene, spot, near) * spot.normal,
                           moved - glm::dot(moved, normal) * normal};
  return SnappedPoint{point, glm::length(moved), spacing_of(near)};
}

std::optional<RadiusFit> radius_near(const Scene& scene, const Region& region, const glm::dvec3& place,
                                     double reach, MeasureKind kind) {
  const NearSurface near = surface_near(scene, region, place, reach);
  auto fit = kind == MeasureKind::sphere ? fit_sphere(near.points, near.normals)
                                         : fit_cylinder(near.points, near.normals);
  const double noise = most_noise_world(scene.stations);
  if (fit && fit->residual > 0.0)
    fit->radius_error = std::hypot(fit->radius_error * std::max(1.0, noise / fit->residual),
                                   smoothed_inwards(*fit, noise, near.radius_squared));
  return fit;
}

std::optional<PlaneFit> plane_near(const Scene& scene, const Region& region, const glm::dvec3& place,
                                   double reach) {
  std::optional<PlaneFit> fit = fit_plane(surface_near(scene, region, place, reach).points);
  const double noise = most_noise_world(scene.stations);
  if (fit && fit->residual > 0.0) fit->turn_error *= std::max(1.0, noise / fit->residual);
  return fit;
}

bool fit_near(const Scene& scene, const Region& region, const glm::dvec3& place, double reach,
              Measure& measure) {
  if (measure.kind == MeasureKind::plane)
    measure.plane = plane_near(scene, region, place, reach);
  else
    measure.fit = radius_near(scene, region, place, reach, measure.kind);
  return measure.plane || measure.fit;
}

}  // namespace splatray
