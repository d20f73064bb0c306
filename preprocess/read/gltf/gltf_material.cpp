#include "preprocess/read/gltf/gltf_material.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "engine/base/number_text.h"
#include "engine/scene/material_fields.h"
#include "engine/scene/phong.h"
#include "engine/scene/texture_factors.h"
#include "preprocess/read/gltf/gltf_accessor.h"
#include "preprocess/read/gltf/gltf_texture.h"
#include "preprocess/read/gltf/image_size.h"

namespace splatray {
namespace {

/// What is shown of textures by their mean.
struct PlainNumbers {
  glm::vec3 base{1.0F};
  float metallic = 1.0F;
  float roughness = 1.0F;
};

float unit_clamp(double value) { return static_cast<float>(std::clamp(value, 0.0, 1.0)); }

float phong_exponent(float roughness) {
  const float alpha = std::max(roughness * roughness, 1e-3F);
  return std::clamp((2.0F / (alpha * alpha) - 2.0F) / 4.0F, 1.0F, 1000.0F);
}

glm::vec3 color_factor(const tinygltf::Material& source) {
  const std::vector<double>& factor = source.pbrMetallicRoughness.baseColorFactor;
  if (factor.size() < 3) {
    return glm::vec3(1.0F);
  }
  return {unit_clamp(factor[0]), unit_clamp(factor[1]), unit_clamp(factor[2])};
}

/// Transmittance of one crossing (KHR_materials_volume, Beer-Lambert over half the thickness).
glm::vec3 attenuation(const tinygltf::Material& source) {
  const tinygltf::Value* volume = find_extension(source.extensions, "KHR_materials_volume");
  if (volume == nullptr) {
    return glm::vec3(1.0F);
  }
  const double thickness = number_in(*volume, "thicknessFactor").value_or(0.0);
  const double distance = number_in(*volume, "attenuationDistance").value_or(INFINITY);
  const std::vector<double> color = numbers_in(*volume, "attenuationColor", {1.0, 1.0, 1.0});
  const double power = distance > 0.0 ? std::clamp(thickness / (2.0 * distance), 0.0, 16.0) : 0.0;
  return {std::pow(unit_clamp(color[0]), power), std::pow(unit_clamp(color[1]), power),
          std::pow(unit_clamp(color[2]), power)};
}

/// Whether light that a material transmits goes on unbent, as through a pane: nothing says what is behind its surface.
bool is_thin(const tinygltf::Material& source) {
  return find_extension(source.extensions, "KHR_materials_ior") == nullptr &&
         find_extension(source.extensions, "KHR_materials_volume") == nullptr;
}

void make_dielectric(Material& material, const tinygltf::Material& source, const PlainNumbers& plain) {
  constexpr double GLASS = 1.5;
  const tinygltf::Value* ior = find_extension(source.extensions, "KHR_materials_ior");
  const double found = ior == nullptr ? GLASS : number_in(*ior, "ior").value_or(GLASS);
  material.flags |= MATERIAL_DIELECTRIC;
  material.ior = is_thin(source) ? 1.0F : static_cast<float>(found > 0.0 ? found : GLASS);
  material.phong.tint = plain.base * attenuation(source);
}

float alpha_of(const tinygltf::Material& from) {
  const std::vector<double>& factor = from.pbrMetallicRoughness.baseColorFactor;
  return factor.size() == 4 ? unit_clamp(factor[3]) : 1.0F;
}

void make_opaque(Phong& phong, const PlainNumbers& plain, bool colored) {
  const glm::vec3 base = colored ? glm::vec3(1.0F) : plain.base;
  const float smooth = 1.0F - plain.roughness;
  if (plain.metallic > 0.5F && plain.roughness < 0.35F && !colored) {
    phong.mirror = 1.0F;
    phong.tint = plain.base;
  } else if (plain.metallic > 0.5F) {
    phong.diffuse = 0.6F * base;
    phong.specular = 0.3F + 0.6F * smooth * smooth;
  } else {
    phong.diffuse = base;
    phong.specular = 0.04F + 0.26F * smooth * smooth;
  }
}

void apply_extras(Phong& phong, const tinygltf::Value& extras) {
  if (const auto mirror = number_in(extras, "mirror")) {
    phong.mirror = unit_clamp(*mirror);
  }
  if (const auto specular = number_in(extras, "specular")) {
    phong.specular = unit_clamp(*specular);
  }
  if (const auto shininess = number_in(extras, "shininess")) {
    phong.shininess = static_cast<float>(std::max(*shininess, 1.0));
  }
}

/// Whether a material's extras, which are for the paper's look, change it.
bool changes_look(const tinygltf::Value& extras) {
  return number_in(extras, "mirror") || number_in(extras, "specular") || number_in(extras, "shininess");
}

float number_of(const tinygltf::Value* extension, const char* name, double otherwise) {
  return extension == nullptr ? float(otherwise) : float(number_in(*extension, name).value_or(otherwise));
}

glm::vec3 color_of(const tinygltf::Value* extension, const char* name) {
  if (extension == nullptr) return glm::vec3(1.0F);
  const std::vector<double> color = numbers_in(*extension, name, {1.0, 1.0, 1.0});
  return glm::max(glm::vec3(color[0], color[1], color[2]), glm::vec3(0.0F));
}

/// Absorption that leaves the attenuation colour after the attenuation distance; a channel that is black leaves 1/1000.
glm::vec3 volume_absorption(const tinygltf::Value* volume) {
  if (volume == nullptr) return glm::vec3(0.0F);
  const float distance = number_of(volume, "attenuationDistance", INFINITY);
  const glm::vec3 color = glm::clamp(color_of(volume, "attenuationColor"), glm::vec3(1e-3F), glm::vec3(1.0F));
  return distance > 0.0F && std::isfinite(distance) ? -glm::log(color) / distance : glm::vec3(0.0F);
}

/// A number of a material, in an extension or, where that is null, in pbrMetallicRoughness.
struct RangedNumber {
  const char *extension, *name;
  double least, most;
};
constexpr RangedNumber RANGED_NUMBERS[] = {
    {nullptr, "metallicFactor", 0.0, 1.0},
    {nullptr, "roughnessFactor", 0.0, 1.0},
    {"KHR_materials_ior", "ior", 1.0, INFINITY},
    {"KHR_materials_specular", "specularFactor", 0.0, 1.0},
    {"KHR_materials_clearcoat", "clearcoatFactor", 0.0, 1.0},
    {"KHR_materials_clearcoat", "clearcoatRoughnessFactor", 0.0, 1.0},
    {"KHR_materials_transmission", "transmissionFactor", 0.0, 1.0},
    {"KHR_materials_emissive_strength", "emissiveStrength", 0.0, EMISSION_MOST},
};

std::optional<double> number_of(const tinygltf::Material& from, const RangedNumber& ranged) {
  const auto& pbr = from.pbrMetallicRoughness;
  if (ranged.extension == nullptr)
    return std::string_view(ranged.name) == "metallicFactor" ? pbr.metallicFactor : pbr.roughnessFactor;
  const tinygltf::Value* extension = find_extension(from.extensions, ranged.extension);
  return extension == nullptr ? std::nullopt : number_in(*extension, ranged.name);
}

/// Gives a material the numbers of another's emission and extensions.
void take_extensions(const tinygltf::Material& from, Material& material) {
  const auto extension = [&](const char* name) { return find_extension(from.extensions, name); };
  material.layer_ior = std::max(number_of(extension("KHR_materials_ior"), "ior", 1.5), 1.0F);
  const tinygltf::Value* specular = extension("KHR_materials_specular");
  material.specular = unit_clamp(number_of(specular, "specularFactor", 1.0));
  material.specular_color = color_of(specular, "specularColorFactor");
  const tinygltf::Value* coat = extension("KHR_materials_clearcoat");
  material.coat = unit_clamp(number_of(coat, "clearcoatFactor", 0.0));
  material.coat_roughness = unit_clamp(number_of(coat, "clearcoatRoughnessFactor", 0.0));
  material.transmission =
      unit_clamp(number_of(extension("KHR_materials_transmission"), "transmissionFactor", 0.0));
  material.absorption = volume_absorption(extension("KHR_materials_volume"));
  const float strength =
      std::max(number_of(extension("KHR_materials_emissive_strength"), "emissiveStrength", 1.0), 0.0F);
  if (from.emissiveFactor.size() == 3) {
    const glm::vec3 factor(from.emissiveFactor[0], from.emissiveFactor[1], from.emissiveFactor[2]);
    material.emission =
        glm::clamp(std::min(strength, EMISSION_MOST) * factor, glm::vec3(0.0F), glm::vec3(EMISSION_MOST));
  }
}

TextureWrap wrap_of(int gltf_wrap) {
  switch (gltf_wrap) {
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
      return TextureWrap::clamp;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
      return TextureWrap::mirror;
    default:
      return TextureWrap::repeat;
  }
}

/// Bytes of all buffers and of images that are files of their own.
std::uint64_t stored_bytes(const tinygltf::Model& model) {
  std::uint64_t bytes = 0;
  for (const tinygltf::Buffer& buffer : model.buffers) bytes += buffer.data.size();
  for (const tinygltf::Image& image : model.images) bytes += image.image.size();
  return bytes;
}

std::shared_ptr<const TextureImage> white_texel() {
  return std::make_shared<TextureImage>(TextureImage{1, 1, {glm::u8vec4(255)}});
}

}  // namespace

GltfMaterials::GltfMaterials(const GltfFile& file, std::vector<std::string>& notes)
    : file_(file),
      notes_(notes),
      pixels_left_(MOST_FREE_PIXELS + MOST_PIXELS_PER_BYTE * stored_bytes(file.model)) {}

const tinygltf::Material& GltfMaterials::source(int index) const {
  return file_.model.materials[file_.checked(index, file_.model.materials.size(), "material")];
}

void GltfMaterials::note_once(int index, const std::string& what) {
  const std::string name = source(index).name;
  const std::string note =
      file_.path.string() + ": material " + (name.empty() ? std::to_string(index) : name) + ": " + what;
  if (std::find(notes_.begin(), notes_.end(), note) == notes_.end()) {
    notes_.push_back(note);
  }
}

void GltfMaterials::note_ranges(int index) {
  for (const RangedNumber& ranged : RANGED_NUMBERS) {
    const std::optional<double> found = number_of(source(index), ranged);
    if (!found || (*found >= ranged.least && *found <= ranged.most)) continue;
    note_once(index, std::string(ranged.name) + ": found " + number_text(*found) + ", expected " +
                         number_text(ranged.least) +
                         (std::isinf(ranged.most) ? " or more" : " to " + number_text(ranged.most)) +
                         "; the nearest is taken");
  }
}

Material GltfMaterials::phong_material(int index, bool colored) {
  Material material = default_material();
  if (index < 0) {
    material.phong.diffuse = colored ? glm::vec3(1.0F) : material.phong.diffuse;
    return material;
  }
  const tinygltf::Material& from = source(index);
  note_ranges(index);
  material.flags = from.doubleSided ? MATERIAL_TWO_SIDED : 0U;
  material.phong.diffuse = glm::vec3(0.0F);
  PlainNumbers plain{color_factor(from), unit_clamp(from.pbrMetallicRoughness.metallicFactor),
                     unit_clamp(from.pbrMetallicRoughness.roughnessFactor)};
  if (from.pbrMetallicRoughness.metallicRoughnessTexture.index >= 0) {
    if (const auto picture = image(from.pbrMetallicRoughness.metallicRoughnessTexture.index)) {
      const glm::vec4 mean = picture->mean();
      plain.metallic *= mean.z;
      plain.roughness *= mean.y;
    }
  }
  const tinygltf::Value* transmission = find_extension(from.extensions, "KHR_materials_transmission");
  material.phong.shininess = phong_exponent(plain.roughness);
  if (transmission != nullptr && number_in(*transmission, "transmissionFactor").value_or(0.0) > 0.0) {
    make_dielectric(material, from, plain);
  } else {
    make_opaque(material.phong, plain, colored);
  }
  apply_extras(material.phong, from.extras);
  return material;
}

const std::vector<GltfMaterials::Map>& GltfMaterials::maps(int index) {
  static const std::vector<Map> NONE;
  if (index < 0) return NONE;
  const auto [found, is_new] = maps_.try_emplace(index);
  if (!is_new) return found->second;
  if (const auto map = opacity(index)) found->second.push_back(*map);
  if (changes_look(source(index).extras)) return found->second;
  for (const KnownMap& known : known_maps()) {
    const tinygltf::TextureInfo info = info_of(source(index), known);
    if (auto texture = laid(index, info, known.name))
      found->second.push_back({{std::move(texture), channels_of(known), 0.0F, nullptr}, texcoord_of(info)});
  }
  const tinygltf::NormalTextureInfo& normal = source(index).normalTexture;
  tinygltf::TextureInfo info;
  info.index = normal.index;
  info.texCoord = normal.texCoord;
  info.extensions = normal.extensions;
  if (auto texture = laid(index, info, "normalTexture"))
    found->second.push_back(
        {{std::move(texture), {}, static_cast<float>(normal.scale), nullptr}, texcoord_of(info)});
  return found->second;
}

std::optional<GltfMaterials::Map> GltfMaterials::opacity(int index) {
  const tinygltf::Material& from = source(index);
  const tinygltf::TextureInfo& info = from.pbrMetallicRoughness.baseColorTexture;
  if (from.alphaMode != "BLEND") return {};
  auto texture = laid(index, info, "the base colour texture");
  const bool is_even = texture == nullptr;
  if (is_even) {
    texture = std::make_shared<Texture>();
    texture->image = white_texel();
  }
  texture->alpha_factor = alpha_of(from);
  const std::vector<glm::u8vec4>& texels = texture->image->texels;
  const bool is_opaque =
      texture->alpha_factor == 1.0F &&
      std::all_of(texels.begin(), texels.end(), [](const auto& texel) { return texel.w == 255; });
  if (is_opaque) return {};
  return Map{{std::move(texture), opacity_channel(), 0.0F, nullptr}, is_even ? -1 : texcoord_of(info)};
}

std::vector<MapChannel> GltfMaterials::opacity_channel() {
  const TextureFactor& factor = *std::find_if(texture_factors().begin(), texture_factors().end(),
                                              [](const auto& one) { return one.column == COLUMN_OPACITY; });
  return {{&factor, 3}};
}

void GltfMaterials::set_alpha(int index, Texture& texture) const {
  texture.factor = base_color(index);
  texture.alpha_factor = alpha_of(source(index));
  if (source(index).alphaMode == "MASK") texture.alpha_cutoff = unit_clamp(source(index).alphaCutoff);
  if (source(index).alphaMode == "BLEND") texture.alpha_cutoff = LEAST_ALPHA;
}

std::shared_ptr<const Texture> GltfMaterials::even_texture(int index, bool varies) {
  if (index < 0) return nullptr;
  const tinygltf::Material& from = source(index);
  const bool cuts_all = from.alphaMode == "MASK" && alpha_of(from) < unit_clamp(from.alphaCutoff);
  if (!cuts_all && (!varies || (from.alphaMode != "MASK" && from.alphaMode != "BLEND"))) return nullptr;
  auto texture = std::make_shared<Texture>();
  texture->image = white_texel();
  set_alpha(index, *texture);
  return texture;
}

Material GltfMaterials::material(int index, bool colored, const std::vector<bool>& sampled) {
  Material material = phong_material(index, colored);
  if (index < 0 || changes_look(source(index).extras)) {
    follow_phong(material);
    return material;
  }
  const tinygltf::Material& from = source(index);
  const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
  take_extensions(from, material);
  material.base = colored ? glm::vec3(1.0F) : color_factor(from);
  material.metallic = unit_clamp(pbr.metallicFactor);
  material.roughness = unit_clamp(pbr.roughnessFactor);
  const std::vector<Map>& known = maps(index);
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (i < sampled.size() && sampled[i]) continue;
    const glm::vec4 mean = known[i].map.texture->image->mean();
    for (const auto& [factor, channel] : known[i].map.channels) multiply(*factor, mean[channel], material);
  }
  // A pane mirrors as glass does, though its index of refraction is 1.
  if (material.transmission > 0.0F && material.coat <= 0.0F && is_thin(from)) {
    material.coat = material.specular;
    material.coat_roughness = material.roughness;
  }
  return material;
}

glm::vec3 GltfMaterials::base_color(int index) const {
  return index < 0 ? glm::vec3(1.0F) : color_factor(source(index));
}

int GltfMaterials::base_texcoord(int index) const {
  return texcoord_of(source(index).pbrMetallicRoughness.baseColorTexture);
}

std::shared_ptr<const Texture> GltfMaterials::base_texture(int index) {
  if (index < 0 || source(index).pbrMetallicRoughness.baseColorTexture.index < 0) {
    return nullptr;
  }
  if (const auto known = textures_.find(index); known != textures_.end()) {
    return known->second;
  }
  const std::shared_ptr<Texture> texture =
      laid(index, source(index).pbrMetallicRoughness.baseColorTexture, "the base colour texture");
  if (texture) set_alpha(index, *texture);
  textures_[index] = texture;
  return texture;
}

std::shared_ptr<Texture> GltfMaterials::laid(int index, const tinygltf::TextureInfo& info, const char* what) {
  if (info.index < 0) return nullptr;
  auto texture = std::make_shared<Texture>();
  texture->image = image(info.index);
  if (!texture->image) {
    note_once(index, std::string(what) + " cannot be decoded, its factor is shown");
    return nullptr;
  }
  texture->uv_transform = uv_transform_of(info);
  const int sampler = file_.model.textures[static_cast<std::size_t>(info.index)].sampler;
  if (sampler >= 0) {
    const tinygltf::Sampler& found =
        file_.model.samplers[file_.checked(sampler, file_.model.samplers.size(), "sampler")];
    texture->wrap_s = wrap_of(found.wrapS);
    texture->wrap_t = wrap_of(found.wrapT);
  }
  return texture;
}

std::shared_ptr<const TextureImage> GltfMaterials::image(int texture) {
  const tinygltf::Texture& found =
      file_.model.textures[file_.checked(texture, file_.model.textures.size(), "texture")];
  if (found.source < 0) {
    return nullptr;
  }
  const std::size_t index = file_.checked(found.source, file_.model.images.size(), "image");
  if (images_.count(index) == 0) {
    images_[index] = decode(index);
  }
  return images_[index];
}

std::shared_ptr<const TextureImage> GltfMaterials::decode(std::size_t index) {
  const tinygltf::Image& stored = file_.model.images[index];
  std::span<const unsigned char> bytes(stored.image);
  if (stored.bufferView >= 0) {
    bytes = buffer_view_bytes(file_, stored.bufferView);
  }
  const std::optional<std::uint64_t> pixels = image_pixels(bytes);
  if (!pixels) {
    return nullptr;
  }
  if (*pixels > pixels_left_) {
    file_.fail("image " + std::to_string(index) + ": found " + std::to_string(*pixels) + " pixels in " +
               std::to_string(bytes.size()) + " bytes, expected at most " + std::to_string(pixels_left_));
  }
  pixels_left_ -= *pixels;
  tinygltf::Image decoded;
  std::string error;
  std::string warning;
  if (bytes.size() > 0x7FFFFFFFU ||
      !tinygltf::LoadImageData(&decoded, static_cast<int>(index), &error, &warning, 0, 0, bytes.data(),
                               static_cast<int>(bytes.size()), nullptr) ||
      decoded.width <= 0 || decoded.height <= 0 || decoded.component != 4) {
    return nullptr;
  }
  auto picture = std::make_shared<TextureImage>();
  picture->width = static_cast<std::uint32_t>(decoded.width);
  picture->height = static_cast<std::uint32_t>(decoded.height);
  picture->texels.resize(std::size_t{picture->width} * picture->height);
  const std::size_t channel_bytes = decoded.bits == 16 ? 2 : 1;
  for (std::size_t i = 0; i < picture->texels.size(); ++i) {
    for (std::size_t c = 0; c < 4; ++c) {  // of 16-bit values the upper byte
      picture->texels[i][static_cast<int>(c)] = decoded.image[(4 * i + c + 1) * channel_bytes - 1];
    }
  }
  return picture;
}

}  // namespace splatray
