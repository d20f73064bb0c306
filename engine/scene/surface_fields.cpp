#include "engine/scene/surface_fields.h"

#include <limits>

namespace splatray {
namespace {

constexpr float ANY = std::numeric_limits<float>::max();

constexpr SurfaceField number(const char* what, float Surface::*member, float least, float most,
                              std::uint32_t feature, const char* key = nullptr) {
  return {what, member, nullptr, least, most, feature, key};
}
constexpr SurfaceField color(const char* what, vec3 Surface::*member, float most, std::uint32_t feature,
                             const char* key = nullptr) {
  return {what, nullptr, member, 0.0F, most, feature, key};
}

constexpr SurfaceField FIELDS[] = {
    color("a base colour", &Surface::base, 1.0F, 0),
    number("a metallic", &Surface::metallic, 0.0F, 1.0F, FEATURE_METAL, "metallic"),
    number("a roughness", &Surface::roughness, 0.0F, 1.0F, 0, "roughness"),
    number("a specular", &Surface::specular, 0.0F, 1.0F, 0),
    color("a specular colour", &Surface::specular_color, ANY, 0),
    number("a clearcoat", &Surface::coat, 0.0F, 1.0F, FEATURE_COAT, "coat"),
    number("a clearcoat roughness", &Surface::coat_roughness, 0.0F, 1.0F, 0, "coat-roughness"),
    color("an emission", &Surface::emission, EMISSION_MOST, FEATURE_EMISSION, "emission"),
    number("a transmission", &Surface::transmission, 0.0F, 1.0F, 0),
    color("an absorption", &Surface::absorption, ANY, 0),
    number("a surface's index of refraction", &Surface::ior, 1.0F, ANY, 0),
};

}  // namespace

std::span<const SurfaceField> surface_fields() { return FIELDS; }

}  // namespace splatray
