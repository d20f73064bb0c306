#include "app/library/materials.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "engine/scene/phong.h"

namespace splatray {
namespace {

struct NamedMaterial {
  const char* name;
  vec3 diffuse;
  float specular;
  vec3 tint;
  float shininess, mirror, ior;
  std::uint32_t flags;
};

constexpr std::uint32_t OPAQUE = MATERIAL_TWO_SIDED, CLEAR = MATERIAL_DIELECTRIC;

/// Metals: reflectance at normal incidence, linear sRGB; glass: crown glass, 1.52.
const std::array<NamedMaterial, 7> NAMED_MATERIALS = {{
    {"matte", vec3(0.72F, 0.72F, 0.7F), 0.0F, vec3(0.0F), 1.0F, 0.0F, 1.0F, OPAQUE},
    {"glossy", vec3(0.55F, 0.12F, 0.1F), 0.12F, vec3(1.0F), 120.0F, 0.06F, 1.0F, OPAQUE},
    {"mirror", vec3(0.0F), 0.0F, vec3(0.95F), 1.0F, 1.0F, 1.0F, OPAQUE},
    {"gold", vec3(0.0F), 0.0F, vec3(1.0F, 0.77F, 0.34F), 1.0F, 1.0F, 1.0F, OPAQUE},
    {"copper", vec3(0.0F), 0.0F, vec3(0.96F, 0.64F, 0.54F), 1.0F, 1.0F, 1.0F, OPAQUE},
    {"glass", vec3(0.0F), 0.0F, vec3(0.98F, 1.0F, 0.99F), 1.0F, 0.0F, 1.52F, CLEAR},
    {"ruby", vec3(0.0F), 0.0F, vec3(0.9F, 0.18F, 0.2F), 1.0F, 0.0F, 1.76F, CLEAR},
}};

}  // namespace

std::vector<std::string> material_names() {
  std::vector<std::string> names;
  for (const NamedMaterial& named : NAMED_MATERIALS) names.emplace_back(named.name);
  return names;
}

Material named_material(const std::string& name) {
  const auto found = std::find_if(NAMED_MATERIALS.begin(), NAMED_MATERIALS.end(),
                                  [&](const NamedMaterial& named) { return name == named.name; });
  assert(found != NAMED_MATERIALS.end());
  Material material{};
  material.ior = found->ior;
  material.flags = found->flags;
  material.phong = {found->diffuse, found->specular, found->tint, found->shininess, found->mirror, 0, 0, 0};
  follow_phong(material);
  return material;
}

void change_material(Material& material, const std::string& name) {
  const Material before = material;
  material = named_material(name);
  material.flags |= before.flags & MATERIAL_HIDDEN;
  material.mask_bit = before.mask_bit;
}

}  // namespace splatray
