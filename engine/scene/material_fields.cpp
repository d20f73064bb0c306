#include "engine/scene/material_fields.h"

#include <limits>

namespace splatray {
namespace {

constexpr float ANY = std::numeric_limits<float>::max();

constexpr MaterialField number(const char* what, float Material::*member, float least, float most,
                               std::uint32_t feature, const char* key = nullptr) {
  return {what, member, nullptr, least, most, feature, key};
}
constexpr MaterialField color(const char* what, vec3 Material::*member, float most, std::uint32_t feature,
                              const char* key = nullptr) {
  return {what, nullptr, member, 0.0F, most, feature, key};
}

constexpr MaterialField FIELDS[] = {
    color("a base colour", &Material::base, 1.0F, 0),
    number("a metallic", &Material::metallic, 0.0F, 1.0F, FEATURE_METAL, "metallic"),
    number("a roughness", &Material::roughness, 0.0F, 1.0F, 0, "roughness"),
    number("a specular", &Material::specular, 0.0F, 1.0F, 0),
    color("a specular colour", &Material::specular_color, ANY, 0),
    number("a clearcoat", &Material::coat, 0.0F, 1.0F, FEATURE_COAT, "coat"),
    number("a clearcoat roughness", &Material::coat_roughness, 0.0F, 1.0F, 0, "coat-roughness"),
    color("an emission", &Material::emission, EMISSION_MOST, FEATURE_EMISSION, "emission"),
    number("a transmission", &Material::transmission, 0.0F, 1.0F, 0),
    color("an absorption", &Material::absorption, ANY, 0),
    number("a layer's index of refraction", &Material::layer_ior, 1.0F, ANY, 0),
};

}  // namespace

std::span<const MaterialField> material_fields() { return FIELDS; }

}  // namespace splatray
