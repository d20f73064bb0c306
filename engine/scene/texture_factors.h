/// What textures make of single splats: numbers that multiply their material's values, as glTF 2.0's textures multiply its
/// factors. They stand in columns of bytes (columns.h) that only scenes with such textures have; the device gets them packed as
/// words (shaders/layout.h).
#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "engine/scene/scene.h"

namespace splatray {

/// One number of each splat, the byte q of a column of uint8: q / 255 or, of a colour's channel, (q / 255)^2, as colours are
/// stored. Points without it have 255, which changes nothing.
struct TextureFactor {
  std::string_view column;
  std::uint32_t word;       ///< FEATURE_TEXTURE_*: the device's word
  std::uint32_t shift;      ///< of its lowest bit there
  float Material::*number;  ///< the value that it multiplies, or
  vec3 Material::*color;    ///< a channel of this one; both null: how opaque the splat is
  int channel;              ///< of the colour
};

/// How much of a splat is there: 0 nothing, 255 all of it. Paths meet it by chance, light is weakened by it.
inline constexpr std::string_view COLUMN_OPACITY = "texture-opacity";

/// All that there are, in no order that matters.
[[nodiscard]] std::span<const TextureFactor> texture_factors();

/// The byte for a value of 0..1; NaN is 0.
[[nodiscard]] std::uint8_t encode_factor(const TextureFactor& factor, float value);

/// Multiplies what a factor is of.
void multiply(const TextureFactor& factor, float value, Material& material);

/// Columns of uint16 with a normal map's normal, octahedral: u + NORMAL_MAP_SCALE and v, world axes. ABSENT_NORMAL: the splat's
/// own.
inline constexpr std::string_view COLUMN_NORMAL_U = "texture-normal-u", COLUMN_NORMAL_V = "texture-normal-v";
inline constexpr int NORMAL_MAP_SCALE = TEXTURE_NORMAL_SCALE;
inline constexpr std::uint16_t ABSENT_NORMAL = 4095;

/// The value of points that have no such column, where others have: 255 of a texture factor, ABSENT_NORMAL, else 0.
[[nodiscard]] std::uint16_t absent_value(std::string_view column);

/// FEATURE_TEXTURE_* of a scene's columns, and FEATURE_OPACITY; 0 for scenes without texture factors.
[[nodiscard]] std::uint32_t texture_features(const std::vector<Column>& columns);

/// How many words a splat has with these features.
[[nodiscard]] std::uint32_t texture_word_count(std::uint32_t features);

/// The device's words of these splats, one splat after the other: for each texture_word_count() of them, the lowest feature's
/// first.
[[nodiscard]] std::vector<std::uint32_t> texture_words(const std::vector<Column>& columns,
                                                       std::span<const std::uint32_t> splats);

/// Radiance that splats send out: their material's times their own factor.
class SplatEmission {
 public:
  /// The scene must outlive it.
  explicit SplatEmission(const Scene& scene);
  /// Radiance of one splat whose material sends out `radiance`.
  [[nodiscard]] vec3 of(std::size_t splat, const vec3& radiance) const;

 private:
  std::span<const std::uint8_t> channels_[3];  ///< beside the splats, or empty
};

}  // namespace splatray
