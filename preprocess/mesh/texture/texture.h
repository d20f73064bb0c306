/// Textures: pictures looked up at texture coordinates.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

namespace splatray {

/// Decoded picture, 8 bits a channel as stored (sRGB for base colours), rows from the top.
struct TextureImage {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<glm::u8vec4> texels;  ///< width * height

  /// Mean of the stored values, 0..1.
  [[nodiscard]] glm::vec4 mean() const;
};

/// What happens to coordinates outside 0..1 (glTF 2.0, samplers).
enum class TextureWrap { repeat, clamp, mirror };

/// A picture and how it is laid on the surface.
struct Texture {
  std::shared_ptr<const TextureImage> image;  ///< never null, never empty
  TextureWrap wrap_s = TextureWrap::repeat;
  TextureWrap wrap_t = TextureWrap::repeat;
  glm::mat3 uv_transform{1.0F};  ///< applied to (u, v, 1) first (KHR_texture_transform)
  glm::vec3 factor{1.0F};        ///< linear, multiplies the texture
  float alpha_factor = 1.0F;     ///< multiplies its alpha
  float alpha_cutoff = 0.0F;     ///< where alpha is below it, there is no surface; 0 = there is everywhere

  /// Linear rgb at a texture coordinate, bilinear between texels; (0, 0) is the top left corner.
  /// A coordinate that is not finite is read as 0.
  [[nodiscard]] glm::vec3 color(glm::vec2 texcoord) const;
  /// The stored values, 0..1, in the same way, without factors: what is no colour.
  [[nodiscard]] glm::vec4 numbers(glm::vec2 texcoord) const;
  /// Where in the picture a texture coordinate lies: (0, 0) to (1, 1) is all of it.
  [[nodiscard]] glm::vec2 place(glm::vec2 texcoord) const;
  /// Whether there is no surface at a texture coordinate where alpha is multiplied by this.
  [[nodiscard]] bool cut_out(glm::vec2 texcoord, float alpha) const;

 private:
  /// The mean of what `decode` makes of the texels around, without factors.
  template <class Decode>
  [[nodiscard]] glm::vec4 filtered(glm::vec2 texcoord, const Decode& decode) const;
  /// Linear rgb and alpha, without factors.
  [[nodiscard]] glm::vec4 texel(glm::vec2 texcoord) const;
};

}  // namespace splatray
