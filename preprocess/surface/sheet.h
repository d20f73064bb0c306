/// Which neighbours of a point belong to its sheet of surface.
#pragma once

namespace splatray {

inline constexpr double SHEET_COSINE = 0.5;   ///< least cosine of the normals
inline constexpr double SHEET_LATERAL = 0.5;  ///< least share of the distance along the tangent plane

}  // namespace splatray
