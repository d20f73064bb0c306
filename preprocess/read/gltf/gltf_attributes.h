/// What applications add to the vertices of glTF.
#pragma once
#include <string>
#include <vector>

#include "engine/scene/columns.h"
#include "preprocess/read/gltf/gltf_file.h"

namespace splatray {

/// The attributes "_NAME" of a primitive of points that are one number each, under the names that known_columns gives them ("_INTENSITY"),
/// else as NAME; at most GLTF_COLUMNS_MOST. All others of any primitive that are not read are named in a note. Throws Error
/// (input_unreadable).
[[nodiscard]] std::vector<Column> read_added_attributes(const GltfFile& file,
                                                        const tinygltf::Primitive& primitive,
                                                        std::size_t vertex_count,
                                                        std::vector<std::string>& notes);

inline constexpr std::size_t GLTF_COLUMNS_MOST = COLUMNS_MOST / 2;  ///< beside those of textures

}  // namespace splatray
