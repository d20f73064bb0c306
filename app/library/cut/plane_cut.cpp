#include "app/library/cut/plane_cut.h"

#include "app/library/cut/cut_join.h"
#include "app/library/cut/cut_surface.h"
#include "app/library/cut/cut_trace.h"

namespace splatray {

std::vector<CutCurve> plane_cut(const Scene& scene, const Region& region, const CutPlane& plane,
                                double tolerance) {
  const CutSurface surface(scene, plane);
  const auto holds = [&](const glm::dvec2& place) { return region.holds(plane.world(place)); };
  std::vector<CutCurve> curves = joined(surface, trace_curves(surface, holds));
  for (CutCurve& curve : curves) curve = simplified(curve, tolerance);
  return curves;
}

}  // namespace splatray
