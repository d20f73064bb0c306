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

/// Standard deviation of where the surface is along its normal: of the residuals of splats nearby from a quadric through them, of what
/// the scans' noise (Station::noise_world) leaves where three points are averaged, and of the step of the coordinates. Depth cameras,
/// which measure in steps of disparity, are farther off than it says. The scene has its pools.
[[nodiscard]] double surface_error(const Scene& scene, const SurfaceSpot& spot);

/// The point where a ray from outside meets the surface at `spot`: an error of that moves it along the ray.
[[nodiscard]] SurfacePoint point_on_ray(const Scene& scene, const SurfaceSpot& spot,
                                        const glm::dvec3& direction);

/// The point of the splats' discs in the region that is nearest to a place. Nothing where the region holds no splat.
[[nodiscard]] std::optional<SurfacePoint> nearest_point(const Scene& scene, const Region& region,
                                                        const glm::dvec3& place);

/// Sphere or cylinder of the splats in the region within `reach` of a place; nothing where they make none.
[[nodiscard]] std::optional<RadiusFit> radius_near(const Scene& scene, const Region& region,
                                                   const glm::dvec3& place, double reach, MeasureKind kind);

}  // namespace splatray
