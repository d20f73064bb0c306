/// Whether the slabs and halves of a scene's leaves hold what they must.
#pragma once
#include "engine/scene/scene_check.h"

namespace splatray {

/// The first leaf whose slab leaves out what a listed disc has inside its cell, or whose halves leave out a disc that reaches
/// them; nothing where there is none. The scene must be without find_scene_defect's defects. What a disc has in a cell is
/// bounded as splatray-preprocess bounds it, so slabs thinner than its may be refused. It unpacks every listed splat, several
/// times the work of reading the file: for tests and fuzzers, not for loading.
[[nodiscard]] std::optional<SceneDefect> find_slab_defect(const Scene& scene);

}  // namespace splatray
