/// glTF 2.0 scenes.
#pragma once
#include <filesystem>

#include "preprocess/points.h"
#include "preprocess/read/read_listener.h"

namespace splatray {

/// Reads .gltf or .glb into objects of world-space meshes (points_from_meshes makes points of them), lights,
/// the first camera and the environment's path. Each node with a mesh is one object, or one per material. Of
/// a node with `extras.points` that file's geometry is the object instead of the mesh, under the node's
/// transform, with the material `extras.material`, else that of the node's mesh, else default_material().
/// `extras.environment` of the scene names the environment. Files are looked for by find_scene_file; the hint
/// is `extras.source` of the node or `extras.hint` of the scene. Throws Error (input_unreadable).
[[nodiscard]] Input read_gltf(const std::filesystem::path& path, const ReadOptions& options,
                              const ReadListener& listener);

}  // namespace splatray
