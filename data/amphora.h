/// A painted amphora as a scanner would bring it home.
#pragma once
#include "data/shapes.h"

namespace splatray {

/// The object "amphora": 1 m high, on y = 0, a handle on either side along x. Geometric bands of black glaze on clay, worn,
/// mended of sherds; points with a scanner's noise of 0.4 mm along their normals, and of colour.
[[nodiscard]] Model amphora();

}  // namespace splatray
