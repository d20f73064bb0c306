/// What a run of a program typically takes, for its progress.
#pragma once
#include "app/library/shot/shot.h"
#include "engine/base/work_plan.h"

namespace splatray {

/// The stages in which inputs become a scene: of a .soct its reading alone.
[[nodiscard]] WorkPlan work_of_scene(const Request::Source& source);
/// The same and those of the pictures, whose stage is "tracing".
[[nodiscard]] WorkPlan work_of_pictures(const Shot& shot);

/// How many pictures are made: of a page those that it shows.
[[nodiscard]] std::size_t pictures_of(const Shot& shot);

}  // namespace splatray
