/// Which way a scan stands.
#pragma once
#include "engine/scene/scene.h"

namespace splatray {

/// The up direction of a scan: the scene's own, which is what its format promises, but for scans that plainly lie on
/// their side. The rules, the first that holds; of those without stations none does:
/// - A camera's frame (is_camera_frame) has y down.
/// - Stations in a ring around all points, as of a turntable, stand level: up is the ring's axis, on the side that most
///   normals look to.
/// - Of a sweep whose station's place is unknown up is the axis along which it is less than half as long as along the
///   others: formats of models promise y.
/// - Things are open below, where no scanner sees them: of an object up is the axis that the normals look to on the
///   mean, by 0.06 to 0.25, three times as much as to any other.
/// - Things stand on what is flat: of a room or an object up is the axis at whose lower end, within 3 % of the height,
///   most points lie with normals within 15 degrees of it, 3 % of all and three times as many as at the lower end of
///   the scene's own; not one along which an object is flat, as a wall is no floor.
/// By the last two nothing is stood on its head: scans lie on their backs, but hardly any hangs from a ceiling; sides that
/// are found by votes may be wrong, and a room's ceiling is larger than what furniture leaves of its floor.
[[nodiscard]] glm::dvec3 upright(const Scene& scene);

}  // namespace splatray
