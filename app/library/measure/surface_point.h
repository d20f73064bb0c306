/// Places on a scene's surface, and how far off they may be.
#pragma once
#include <optional>

#include "app/library/measure/measure.h"
#include "engine/image/region.h"
#include "engine/scene/scene.h"

namespace splatray {

/// What is known of the surface near a place.
struct SurfaceSpot {
  glm::dvec3 place{0.0};   ///< on it, world
  glm::dvec3 normal{0.0};  ///< unit
};

/// The point where a ray from outside meets the surface at `spot`: an error of the surface moves it along the ray. The standard
/// deviation of where the surface is along its normal is that of the residuals of splats nearby from a quadric through them, of what
/// the scans' noise (Station::noise_world) leaves where three points are averaged, and of the step of the coordinates. Depth cameras,
/// which measure in steps of disparity, are farther off than it says. The scene has its pools.
[[nodiscard]] SurfacePoint point_on_ray(const Scene& scene, const SurfaceSpot& spot,
                                        const glm::dvec3& direction);

/// The point of a surface to which a place is moved.
struct SnappedPoint {
  SurfacePoint point;  ///< off along the normal as point_on_ray has it, and by what it was moved sideways
  double distance_world = 0.0;  ///< from the place
  double spacing_world = 0.0;   ///< of the splats around the point, as if they lay in squares
};

/// The point of the splats' discs in the region that is nearest to a place. Nothing where the region holds no splat.
[[nodiscard]] std::optional<SnappedPoint> nearest_point(const Scene& scene, const Region& region,
                                                        const glm::dvec3& place);

/// Sphere or cylinder of the splats in the region within `reach` of a place; nothing where they make none. Smoothed points lie
/// closer to it than they were measured, and farther inside: the error is that of the scans' noise where the residuals say less, and how far
/// the smoothing that these tell of moves what is bent.
[[nodiscard]] std::optional<RadiusFit> radius_near(const Scene& scene, const Region& region,
                                                   const glm::dvec3& place, double reach, MeasureKind kind);

/// Plane of the splats in the region within `reach` of a place, with errors as radius_near has them.
[[nodiscard]] std::optional<PlaneFit> plane_near(const Scene& scene, const Region& region,
                                                 const glm::dvec3& place, double reach);

/// Gives a measure that is_fitted the sphere, cylinder or plane around a place. Returns whether there is one.
[[nodiscard]] bool fit_near(const Scene& scene, const Region& region, const glm::dvec3& place, double reach,
                            Measure& measure);

}  // namespace splatray
