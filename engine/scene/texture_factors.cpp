#include "engine/scene/texture_factors.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace splatray {
namespace {

constexpr TextureFactor number(std::string_view column, std::uint32_t word, std::uint32_t shift,
                               float Material::*member) {
  return {column, word, shift, member, nullptr, 0};
}
constexpr TextureFactor color(std::string_view column, std::uint32_t word, std::uint32_t shift,
                              vec3 Material::*member, int channel) {
  return {column, word, shift, nullptr, member, channel};
}

constexpr TextureFactor FACTORS[] = {
    number("texture-metallic", FEATURE_TEXTURE_LAYER, 0, &Material::metallic),
    number("texture-roughness", FEATURE_TEXTURE_LAYER, 8, &Material::roughness),
    number("texture-transmission", FEATURE_TEXTURE_LAYER, 16, &Material::transmission),
    number(COLUMN_OPACITY, FEATURE_TEXTURE_LAYER, 24, nullptr),
    color("texture-emission-r", FEATURE_TEXTURE_GLOW, 0, &Material::emission, 0),
    color("texture-emission-g", FEATURE_TEXTURE_GLOW, 8, &Material::emission, 1),
    color("texture-emission-b", FEATURE_TEXTURE_GLOW, 16, &Material::emission, 2),
    number("texture-specular", FEATURE_TEXTURE_GLOW, 24, &Material::specular),
    color("texture-specular-r", FEATURE_TEXTURE_COLOR, 0, &Material::specular_color, 0),
    color("texture-specular-g", FEATURE_TEXTURE_COLOR, 8, &Material::specular_color, 1),
    color("texture-specular-b", FEATURE_TEXTURE_COLOR, 16, &Material::specular_color, 2),
    number("texture-coat", FEATURE_TEXTURE_COLOR, 24, &Material::coat),
    number("texture-coat-roughness", FEATURE_TEXTURE_NORMAL, 24, &Material::coat_roughness),
};

constexpr std::uint32_t WORDS =
    FEATURE_TEXTURE_LAYER | FEATURE_TEXTURE_GLOW | FEATURE_TEXTURE_COLOR | FEATURE_TEXTURE_NORMAL;

/// A factor's column; empty where there is none, or it is of another type and so none of ours.
template <class Value = std::uint8_t>
std::span<const Value> bytes_of(const std::vector<Column>& columns, std::string_view name) {
  const Column* column = find_column(columns, name);
  const auto* values = column == nullptr ? nullptr : std::get_if<Pool<Value>>(&column->values);
  return values == nullptr ? std::span<const Value>() : *values;
}

/// Whether there are normals of maps.
bool has_normals(const std::vector<Column>& columns) {
  return !bytes_of<std::uint16_t>(columns, COLUMN_NORMAL_U).empty() &&
         !bytes_of<std::uint16_t>(columns, COLUMN_NORMAL_V).empty();
}

}  // namespace

std::span<const TextureFactor> texture_factors() { return FACTORS; }

std::uint8_t encode_factor(const TextureFactor& factor, float value) {
  const float clamped = value > 0.0F ? std::min(value, 1.0F) : 0.0F;
  return static_cast<std::uint8_t>(
      std::lround(255.0F * (factor.color != nullptr ? std::sqrt(clamped) : clamped)));
}

void multiply(const TextureFactor& factor, float value, Material& material) {
  if (factor.number != nullptr)
    material.*factor.number *= value;
  else if (factor.color != nullptr)
    (material.*factor.color)[factor.channel] *= value;
}

std::uint16_t absent_value(std::string_view column) {
  if (column == COLUMN_NORMAL_U || column == COLUMN_NORMAL_V) return ABSENT_NORMAL;
  const bool factor = std::any_of(std::begin(FACTORS), std::end(FACTORS),
                                  [&](const TextureFactor& one) { return one.column == column; });
  return factor ? 255 : 0;
}

std::uint32_t texture_features(const std::vector<Column>& columns) {
  std::uint32_t features = 0;
  for (const TextureFactor& factor : FACTORS)
    if (!bytes_of(columns, factor.column).empty()) features |= factor.word;
  if (has_normals(columns)) features |= FEATURE_TEXTURE_NORMAL;
  return bytes_of(columns, COLUMN_OPACITY).empty() ? features : features | FEATURE_OPACITY;
}

std::uint32_t texture_word_count(std::uint32_t features) {
  return static_cast<std::uint32_t>(std::popcount(features & WORDS));
}

std::vector<std::uint32_t> texture_words(const std::vector<Column>& columns,
                                         std::span<const std::uint32_t> splats) {
  const std::uint32_t features = texture_features(columns);
  const std::size_t stride = texture_word_count(features);
  std::vector<std::uint32_t> words(stride * splats.size(), 0);
  // Sets bits of each splat's word to its value in a column, which may be empty; files may hold more than a normal's 12 bits.
  const auto fill = [&](std::string_view name, const auto& values, std::uint32_t feature,
                        std::uint32_t shift) {
    const std::uint32_t most = absent_value(name);
    auto word = static_cast<std::size_t>(std::popcount(features & WORDS & (feature - 1)));
    for (const std::uint32_t splat : splats) {
      const std::uint32_t value = values.empty() ? most : std::uint32_t{values[splat]};
      words[word] |= std::min(value, most) << shift;
      word += stride;
    }
  };
  for (const TextureFactor& factor : FACTORS)
    if ((features & factor.word) != 0)
      fill(factor.column, bytes_of(columns, factor.column), factor.word, factor.shift);
  if ((features & FEATURE_TEXTURE_NORMAL) == 0) return words;
  const bool maps = has_normals(columns);
  for (const auto& [name, shift] : {std::pair{COLUMN_NORMAL_U, 0U}, std::pair{COLUMN_NORMAL_V, 12U}})
    fill(name, maps ? bytes_of<std::uint16_t>(columns, name) : std::span<const std::uint16_t>(),
         FEATURE_TEXTURE_NORMAL, shift);
  return words;
}

SplatEmission::SplatEmission(const Scene& scene) {
  for (const TextureFactor& factor : FACTORS)
    if (factor.color == &Material::emission)
      channels_[factor.channel] = bytes_of(scene.columns, factor.column);
}

vec3 SplatEmission::of(std::size_t splat, const vec3& radiance) const {
  vec3 sent = radiance;
  for (int channel = 0; channel < 3; ++channel) {
    if (channels_[channel].empty()) continue;
    const float root = static_cast<float>(channels_[channel][splat]) / 255.0F;
    sent[channel] *= root * root;
  }
  return sent;
}

}  // namespace splatray
