/// Curves along which a plane meets a surface, from point to point.
#pragma once
#include <functional>
#include <vector>

#include "app/library/cut/cut_surface.h"

namespace splatray {

struct TracedCurve {
  std::vector<CutPoint> points;  ///< along forward()
  bool closed = false;
};

/// Every curve once, the longest supported places first: from there half a radius at a time along the surface both ways, as far as it
/// goes on smoothly, has splats and `holds` the place.
[[nodiscard]] std::vector<TracedCurve> trace_curves(const CutSurface& surface,
                                                    const std::function<bool(const glm::dvec2&)>& holds);

}  // namespace splatray
