/// glTF mesh primitives -> meshes.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "preprocess/points.h"
#include "preprocess/read/gltf/gltf_file.h"
#include "preprocess/read/gltf/gltf_material.h"

namespace splatray {

/// One primitive in its mesh's own space: triangles (lists, strips, fans; indexed or not) or points (no
/// triangles), with NORMAL, COLOR_0 (linear, times the base colour), the base colour texture and
/// the textures of factors for which it has coordinates; points with what applications add (gltf_attributes.h). nullopt for
/// lines (noted). Throws Error (input_unreadable).
[[nodiscard]] std::optional<Mesh> read_primitive(const GltfFile& file, const tinygltf::Primitive& primitive,
                                                 GltfMaterials& materials, std::vector<std::string>& notes);

}  // namespace splatray
