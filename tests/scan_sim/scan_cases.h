/// The scans that preprocess is measured with.
#pragma once
#include <memory>

#include "tests/scan_sim/scanner.h"

namespace splatray::testing {

/// A spinning scanner's sweep, and what it is of.
struct Sweep {
  SimulatedScan scan;
  Spinner spinner;
  std::shared_ptr<const TriangleTree> mesh;
};

/// One sweep of `rings` rings along a street.
[[nodiscard]] Sweep street_sweep(int rings);

/// The corner of corner_mesh as a depth camera sees it from 1.4 m above the floor, whose grid and rounding are `camera`'s.
[[nodiscard]] SimulatedScan corner_by_depth_camera(DepthCamera camera = {});

/// The same without stations.
[[nodiscard]] Sweep without_stations(Sweep sweep);

}  // namespace splatray::testing
