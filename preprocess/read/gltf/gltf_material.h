/// glTF materials -> our materials and textures.
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/mesh/texture/texture.h"
#include "preprocess/points.h"
#include "preprocess/read/gltf/gltf_file.h"

namespace splatray {

/// Materials and pictures of one file; pictures (PNG, JPEG) are decoded when first asked for. All of a file's pictures
/// together may have MOST_FREE_PIXELS, and MOST_PIXELS_PER_BYTE for each byte of its buffers and images beyond that: more
/// is refused before it is decoded.
///
/// Material::phong is diffuse + Phong specular, mirror or dielectric, whichever is nearest to pbrMetallicRoughness:
/// - transmissionFactor > 0: dielectric, which path tracing shows as the mixture that it is; ior of KHR_materials_ior (1.5), or 1
/// when neither that nor
///   KHR_materials_volume is there (a thin pane, which does not bend light); tint = base colour, times the
///   attenuation colour of KHR_materials_volume to the power of thickness / (2 attenuation distance) (the
///   ray crosses the surface twice).
/// - metallic > 0.5, roughness < 0.35, one colour: mirror = 1, tint = base colour.
/// - other metals: diffuse = 0.6 base colour, specular 0.3 to 0.9.
/// - all else: diffuse = base colour, specular 0.04 (rough) to 0.3 (smooth).
/// Phong exponent: (2 / alpha^2 - 2) / 4 with alpha = roughness^2, 1 to 1000 (Blinn-Phong's for a Beckmann
/// slope, Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces"; Phong's lobe is
/// about 4 times as wide). There metallic and roughness textures count by their mean. doubleSided: two-sided.
/// alphaMode BLEND: opacity of each point; what alpha leaves nothing of is not there.
/// extras.mirror (0..1), extras.specular (0..1) and extras.shininess (>= 1) set those fields.
class GltfMaterials {
 public:
  static constexpr std::uint64_t MOST_FREE_PIXELS = std::uint64_t{1} << 24U;  ///< one of 4096 x 4096
  /// A JPEG of one colour has 340, a photograph 2 to 20.
  static constexpr std::uint64_t MOST_PIXELS_PER_BYTE = 256;

  GltfMaterials(const GltfFile& file, std::vector<std::string>& notes);

  /// The material with this index, default_material() for -1, with KHR_materials_ior, _specular, _clearcoat, _transmission,
  /// _volume and _emissive_strength; where `extras` change its phong, all follows from that. `colored`: points bring the base
  /// colour themselves, so that it is left out. `sampled`: of its maps(), those that points bring as texture factors; the others
  /// count by their mean. Throws Error (input_unreadable) for an index out of range.
  [[nodiscard]] Material material(int index, bool colored, const std::vector<bool>& sampled = {});

  /// A texture of factors, and which TEXCOORD_n it uses; -1: none, as it is the same all over.
  struct Map {
    SurfaceMap map;  ///< without coordinates
    int texcoord = 0;
  };
  /// A material's textures of factors that can be decoded (others are noted); none where `extras` change its phong.
  [[nodiscard]] const std::vector<Map>& maps(int index);

  /// Linear base colour factor; white for -1.
  [[nodiscard]] glm::vec3 base_color(int index) const;

  /// The base colour texture times its factor, nullptr when there is none or it cannot be decoded (noted).
  [[nodiscard]] std::shared_ptr<const Texture> base_texture(int index);

  /// Least alpha of alphaMode BLEND: below it, a byte of opacity would be 0, and nothing is there.
  static constexpr float LEAST_ALPHA = 0.5F / 255.0F;
  /// A texture of the base colour's factor alone, the same all over: for surfaces without a texture whose alpha matters. Null
  /// where it does not: of alphaMode OPAQUE, and where neither the vertices have any (`varies`) nor a mask cuts out all.
  [[nodiscard]] std::shared_ptr<const Texture> even_texture(int index, bool varies);
  /// The channel of such a texture that thins a surface.
  [[nodiscard]] static std::vector<MapChannel> opacity_channel();

  /// Which TEXCOORD_n the base colour texture uses.
  [[nodiscard]] int base_texcoord(int index) const;

 private:
  [[nodiscard]] const tinygltf::Material& source(int index) const;
  /// material() with its phong, flags and ior alone.
  [[nodiscard]] Material phong_material(int index, bool colored);
  /// Gives a base colour texture its factors and its cutoff.
  void set_alpha(int index, Texture& texture) const;
  [[nodiscard]] std::shared_ptr<const TextureImage> image(int texture);
  [[nodiscard]] std::shared_ptr<const TextureImage> decode(std::size_t image);
  /// Opacity of a material with alphaMode BLEND; nothing where it is opaque all over.
  [[nodiscard]] std::optional<Map> opacity(int index);
  /// A texture as it is laid on the surface; nullptr when there is none or it cannot be decoded, which is noted as `what`.
  [[nodiscard]] std::shared_ptr<Texture> laid(int index, const tinygltf::TextureInfo& info, const char* what);
  /// Notes numbers out of their range.
  void note_ranges(int index);
  void note_once(int index, const std::string& what);

  const GltfFile& file_;
  std::vector<std::string>& notes_;
  std::map<std::size_t, std::shared_ptr<const TextureImage>> images_;
  std::map<int, std::shared_ptr<const Texture>> textures_;
  std::map<int, std::vector<Map>> maps_;
  std::uint64_t pixels_left_;
};

}  // namespace splatray
