#include "preprocess/mesh/texture/texture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/srgb.h"

namespace splatray {
namespace {

std::array<float, 256> make_linear_table() {
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    table[i] = srgb_to_linear(static_cast<float>(i) / 255.0F);
  }
  return table;
}

/// Index of a texel in 0..size-1.
std::uint32_t wrapped(std::int64_t index, std::uint32_t size, TextureWrap wrap) {
  const auto n = static_cast<std::int64_t>(size);
  switch (wrap) {
    case TextureWrap::repeat:
      index = ((index % n) + n) % n;
      break;
    case TextureWrap::clamp:
      index = std::min(std::max<std::int64_t>(index, 0), n - 1);
      break;
    case TextureWrap::mirror:
      index = ((index % (2 * n)) + 2 * n) % (2 * n);
      index = index < n ? index : 2 * n - 1 - index;
      break;
  }
  return static_cast<std::uint32_t>(index);
}

}  // namespace

glm::vec4 TextureImage::mean() const {
  glm::dvec4 sum{0.0};
  for (const glm::u8vec4& texel : texels) {
    sum += glm::dvec4(texel);
  }
  return glm::vec4(sum / (255.0 * static_cast<double>(texels.size())));
}

glm::vec3 Texture::color(glm::vec2 texcoord) const { return factor * glm::vec3(texel(texcoord)); }

bool Texture::cut_out(glm::vec2 texcoord, float alpha) const {
  return alpha_cutoff > 0.0F && alpha * alpha_factor * texel(texcoord).w < alpha_cutoff;
}

glm::vec4 Texture::numbers(glm::vec2 texcoord) const {
  return filtered(texcoord, [](const glm::u8vec4& stored) { return glm::vec4(stored) / 255.0F; });
}

glm::vec4 Texture::texel(glm::vec2 texcoord) const {
  static const std::array<float, 256> LINEAR = make_linear_table();
  return filtered(texcoord, [](const glm::u8vec4& stored) {
    return glm::vec4(LINEAR[stored.x], LINEAR[stored.y], LINEAR[stored.z], stored.w / 255.0F);
  });
}

glm::vec2 Texture::place(glm::vec2 texcoord) const {
  constexpr float FARTHEST = 1.0e6F;
  glm::vec2 uv(uv_transform * glm::vec3(texcoord, 1.0F));
  for (int axis = 0; axis < 2; ++axis) {
    uv[axis] = std::isfinite(uv[axis]) ? glm::clamp(uv[axis], -FARTHEST, FARTHEST) : 0.0F;
  }
  return uv;
}

template <class Decode>
glm::vec4 Texture::filtered(glm::vec2 texcoord, const Decode& decode) const {
  const glm::dvec2 at = glm::dvec2(place(texcoord)) * glm::dvec2(image->width, image->height) - 0.5;
  const glm::dvec2 base = glm::floor(at);
  const glm::vec2 weight(at - base);
  glm::vec4 sum{0.0F};
  for (int corner = 0; corner < 4; ++corner) {
    const int dx = corner & 1;
    const int dy = corner >> 1;
    const std::uint32_t column = wrapped(static_cast<std::int64_t>(base.x) + dx, image->width, wrap_s);
    const std::uint32_t row = wrapped(static_cast<std::int64_t>(base.y) + dy, image->height, wrap_t);
    const glm::u8vec4 stored = image->texels[std::size_t{row} * image->width + column];
    const float share = (dx == 1 ? weight.x : 1.0F - weight.x) * (dy == 1 ? weight.y : 1.0F - weight.y);
    sum += share * decode(stored);
  }
  return sum;
}

}  // namespace splatray
