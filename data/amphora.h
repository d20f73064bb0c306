/// A painted amphora as a scanner would bring it home.
#pragma once
#include "data/shapes.h"

namespace splatray {

/// The object "amphora": 1 m high, on y = 0, a handle on either side along x. Geometric bands of black glaze on clay, worn, mended of sherds.
/// Its points are those that laser scanners at five places around it measure, in rows and columns, with a noise of 0.4 mm along each
/// ray: not where no scanner sees it, without normals in their file.
[[nodiscard]] Model amphora();

}  // namespace splatray
