/// Bounds-checked reading of glTF accessors.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "preprocess/read/gltf/gltf_file.h"

namespace splatray {

/// The bytes of a buffer view. Throws Error (input_unreadable) when it reaches beyond its buffer.
[[nodiscard]] std::span<const unsigned char> buffer_view_bytes(const GltfFile& file, int view);

/// An accessor's elements as floats, `components` a row (further components of an element are dropped);
/// sparse entries are put in, normalised integers become -1..1 or 0..1. `what` names it in messages. Throws
/// Error (input_unreadable).
[[nodiscard]] std::vector<float> read_floats(const GltfFile& file, int accessor, std::size_t components,
                                             const std::string& what);

/// An accessor of vertex indices, each checked to be less than `vertex_count`. Throws Error
/// (input_unreadable).
[[nodiscard]] std::vector<glm::uint> read_indices(const GltfFile& file, int accessor,
                                                  std::size_t vertex_count);

}  // namespace splatray
