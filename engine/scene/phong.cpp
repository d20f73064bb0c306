#include "engine/scene/phong.h"

#include <algorithm>
#include <cmath>

#include "engine/scene/material_fields.h"

namespace splatray {
namespace {

constexpr float PLASTIC_IOR = 1.5F;

/// The index of refraction whose surface mirrors this share of light that meets it face on.
float mirroring_ior(float share) {
  const float root = std::sqrt(std::min(share, 0.98F));
  return (1.0F + root) / (1.0F - root);
}

Material followed(Material material) {
  follow_phong(material);
  return material;
}

}  // namespace

void follow_phong(Material& material) {
  const Phong& phong = material.phong;
  Material next{};
  next.base = phong.diffuse;
  next.specular_color = vec3(1.0F);
  next.roughness = 1.0F;
  next.layer_ior = PLASTIC_IOR;
  if ((material.flags & MATERIAL_DIELECTRIC) != 0) {
    next.base = phong.tint * phong.tint;  // of both sides
    next.transmission = next.specular = 1.0F;
    next.roughness = 0.0F;
  } else if (phong.mirror >= 0.5F) {
    next.base = phong.tint * phong.mirror;
    next.metallic = 1.0F;
    next.roughness = 0.0F;
  } else if (phong.mirror > 0.0F) {
    next.specular = 1.0F;
    next.roughness = 0.0F;
    next.layer_ior = mirroring_ior(phong.mirror);
  } else if (phong.specular > 0.0F) {
    next.specular = 1.0F;
    next.roughness = std::pow(2.0F / (phong.shininess + 2.0F), 0.25F);
  }
  next.ior = material.ior;
  next.flags = material.flags;
  next.mask_bit = material.mask_bit;
  next.phong = phong;
  material = next;
}

void follow_change(const Material& before, Material& material) {
  const Material from = followed(before);
  Material next = followed(material);
  const auto fields = material_fields();
  if (std::all_of(fields.begin(), fields.end(),
                  [&](const MaterialField& field) { return field.of(from) == field.of(next); }))
    return;
  for (const MaterialField& field : fields)
    if (field.key != nullptr && field.of(material) != field.of(from)) field.set(next, field.of(material));
  material = next;
}

}  // namespace splatray
