/// What a view of a scan would show, before its picture is made.
#pragma once
#include <optional>
#include <vector>

#include "engine/image/point_sample.h"
#include "engine/image/scan_kind.h"
#include "engine/image/view.h"

namespace splatray {

/// Shares, 0..1, of a picture of 32 x 24 pixels that has the foremost of an even choice of the points in each.
struct ViewFigures {
  double background = 1.0;  ///< of all blocks of 4 x 4 pixels: nothing
  double behind = 0.0;      ///< of the others: a surface that is seen from behind
  double plane = 0.0;       ///< of these: of the largest plane
  double near = 0.0;        ///< of these: nearer than 3 % of the points' extent
};

/// Those of points from a camera; with `cutaway` without points that face away from it.
[[nodiscard]] ViewFigures view_figures(const PointSample& sample, const Camera& camera, bool cutaway);

/// Why a view shows nothing of a scan.
enum class ViewFault {
  none,
  closed,      ///< from outside, walls are seen from behind; of a doll's house nothing is
  background,  ///< most of the picture is empty
  one_plane,   ///< most of it is one plane
  in_wall,     ///< much of it is next to the camera
};
/// "closed" and so on.
[[nodiscard]] const char* view_fault_name(ViewFault fault);

/// A view that was tried.
struct CheckedView {
  Viewpoint viewpoint = Viewpoint::front;
  ViewFault fault = ViewFault::none;
  /// ViewFigures::behind of views from outside and of doll's houses that open, else the figure of the fault.
  double share = 0.0;
};

/// The check of one view of a scan. A view from outside, front or oblique, is closed where more than half of what it shows is seen from
/// behind and all scanners' places are known or found, which decides the sides, or more than 65 % and most of the points lie in upright or level
/// planes: it looks at the backs of walls, or of a roof over the scanner. A doll's house is closed where less than 15 % faces away
/// from the camera, and from one at the other side, so that nothing is left out; it shows background where 90 % is empty. A view from
/// inside is in a wall where a quarter is next to the camera, has one plane where that is more than 70 %, and background where more than
/// 75 % is empty.
[[nodiscard]] CheckedView check_view(const Scene& scene, const PointSample& sample, Viewpoint viewpoint);

/// The views of a scan of this kind that are tried, ending with the first without a fault, which is to be shown: `first`, the kind's own,
/// then of rooms the other one of inside and doll's house, of sweeps seen from inside the oblique one, of all but rooms the doll's house. Where all have faults the first
/// stands again at the end. A single one of what needs no check: models and what one sensor saw.
[[nodiscard]] std::vector<CheckedView> check_views(const Scene& scene, SceneKind kind, Viewpoint first);

}  // namespace splatray
