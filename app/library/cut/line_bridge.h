/// Curves with gaps in them.
#pragma once
#include <vector>

#include "app/library/cut/plane_cut.h"

namespace splatray {

/// How far from each other two curves may be that are one.
struct BridgeReach {
  double gap = 0.0;    ///< along their line, world units
  double aside = 0.0;  ///< across it
};

/// Joins open curves of which one goes on in the other's line, the nearest ends first.
[[nodiscard]] std::vector<CutCurve> bridged(const std::vector<CutCurve>& curves, const BridgeReach& reach);

}  // namespace splatray
