/// The textures of glTF's materials: how they lie on surfaces, and which of them are factors of a surface.
#pragma once
#include <tiny_gltf.h>

#include <glm/glm.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "preprocess/points.h"

namespace splatray {

/// KHR_texture_transform: translation * rotation * scale; the rotation is counter-clockwise as seen with v
/// downwards, as its text and the sample viewer have it (the formula printed in it turns the other way).
[[nodiscard]] glm::mat3 uv_transform_of(const tinygltf::TextureInfo& info);

/// TEXCOORD_n of a texture; KHR_texture_transform may name another.
[[nodiscard]] int texcoord_of(const tinygltf::TextureInfo& info);

/// A texture that glTF knows, and the columns that its channels fill; "" where it has no such channel.
struct KnownMap {
  const char* extension;  ///< null: the material itself
  const char* name;
  std::string_view columns[4];
};
[[nodiscard]] std::span<const KnownMap> known_maps();

/// A material's texture of that kind; its index is -1 where there is none.
[[nodiscard]] tinygltf::TextureInfo info_of(const tinygltf::Material& from, const KnownMap& known);

/// The channels that a texture fills.
[[nodiscard]] std::vector<MapChannel> channels_of(const KnownMap& known);

}  // namespace splatray
