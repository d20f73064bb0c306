/// What lies under the cursor.
#pragma once
#include <optional>

#include "app/view/model/frame.h"
#include "engine/scene/scene.h"

namespace splatray {

/// The ray through a place in the picture, pixels from its top left corner, as Tracer::intersect takes it. Throws as
/// make_frame_params does.
[[nodiscard]] RayQuery cursor_query(const Scene& scene, const View& view, glm::dvec2 position_px);

/// The splat that `hit` of `query` names; nothing on a miss. `hit` is what Tracer::intersect gave for this scene.
[[nodiscard]] std::optional<Inspected> inspect(const Scene& scene, const Camera& camera,
                                               const RayQuery& query, const RayHit& hit);

}  // namespace splatray
