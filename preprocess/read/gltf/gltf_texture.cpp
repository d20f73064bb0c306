#include "preprocess/read/gltf/gltf_texture.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/scene/texture_factors.h"
#include "preprocess/read/gltf/gltf_file.h"

namespace splatray {
namespace {

/// A textureInfo that tinygltf leaves in an extension's JSON; its index is -1 where there is none.
tinygltf::TextureInfo texture_in(const tinygltf::Material& from, const char* extension, const char* name) {
  tinygltf::TextureInfo info;
  const tinygltf::Value* found = find_extension(from.extensions, extension);
  if (found == nullptr || !found->IsObject() || !found->Get(name).IsObject()) return info;
  const tinygltf::Value& texture = found->Get(name);
  info.index = static_cast<int>(std::clamp(number_in(texture, "index").value_or(-1.0), -1.0, 1e9));
  info.texCoord = static_cast<int>(std::clamp(number_in(texture, "texCoord").value_or(0.0), 0.0, 1000.0));
  const tinygltf::Value& extensions = texture.Get("extensions");
  if (extensions.IsObject() && extensions.Has("KHR_texture_transform"))
    info.extensions["KHR_texture_transform"] = extensions.Get("KHR_texture_transform");
  return info;
}

constexpr KnownMap KNOWN_MAPS[] = {
    {nullptr, "metallicRoughnessTexture", {"", "texture-roughness", "texture-metallic", ""}},
    {nullptr, "emissiveTexture", {"texture-emission-r", "texture-emission-g", "texture-emission-b", ""}},
    {"KHR_materials_transmission", "transmissionTexture", {"texture-transmission", "", "", ""}},
    {"KHR_materials_specular", "specularTexture", {"", "", "", "texture-specular"}},
    {"KHR_materials_specular",
     "specularColorTexture",
     {"texture-specular-r", "texture-specular-g", "texture-specular-b", ""}},
    {"KHR_materials_clearcoat", "clearcoatTexture", {"texture-coat", "", "", ""}},
    {"KHR_materials_clearcoat", "clearcoatRoughnessTexture", {"", "texture-coat-roughness", "", ""}},
};

}  // namespace

std::span<const KnownMap> known_maps() { return KNOWN_MAPS; }

glm::mat3 uv_transform_of(const tinygltf::TextureInfo& info) {
  const tinygltf::Value* transform = find_extension(info.extensions, "KHR_texture_transform");
  if (transform == nullptr) {
    return glm::mat3(1.0F);
  }
  const std::vector<double> offset = numbers_in(*transform, "offset", {0.0, 0.0});
  const std::vector<double> scale = numbers_in(*transform, "scale", {1.0, 1.0});
  const double angle = number_in(*transform, "rotation").value_or(0.0);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return glm::mat3(glm::dmat3(c * scale[0], -s * scale[0], 0.0, s * scale[1], c * scale[1], 0.0, offset[0],
                              offset[1], 1.0));
}

int texcoord_of(const tinygltf::TextureInfo& info) {
  const tinygltf::Value* transform = find_extension(info.extensions, "KHR_texture_transform");
  const auto replaced = transform == nullptr ? std::nullopt : number_in(*transform, "texCoord");
  return replaced ? static_cast<int>(std::clamp(*replaced, 0.0, 1000.0)) : info.texCoord;
}

tinygltf::TextureInfo info_of(const tinygltf::Material& from, const KnownMap& known) {
  if (known.extension != nullptr) return texture_in(from, known.extension, known.name);
  return std::string_view(known.name) == "emissiveTexture"
             ? from.emissiveTexture
             : from.pbrMetallicRoughness.metallicRoughnessTexture;
}

std::vector<MapChannel> channels_of(const KnownMap& known) {
  std::vector<MapChannel> channels;
  for (int channel = 0; channel < 4; ++channel)
    for (const TextureFactor& factor : texture_factors())
      if (factor.column == known.columns[channel]) channels.push_back({&factor, channel});
  return channels;
}

}  // namespace splatray
