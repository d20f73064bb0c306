#include "engine/scene/surface.h"

#include <algorithm>
#include <cmath>

namespace splatray {
namespace {

constexpr float PLASTIC_IOR = 1.5F;

/// The index of refraction whose surface mirrors this share of light that meets it face on.
float mirroring_ior(float share) {
  const float root = std::sqrt(std::min(share, 0.98F));
  return (1.0F + root) / (1.0F - root);
}

}  // namespace

Surface surface_of(const Material& material) {
  Surface surface{};
  surface.base = material.diffuse;
  surface.specular_color = vec3(1.0F);
  surface.roughness = 1.0F;
  surface.ior = PLASTIC_IOR;
  if ((material.flags & MATERIAL_DIELECTRIC) != 0) {
    surface.base = material.tint * material.tint;  // of both sides
    surface.transmission = surface.specular = 1.0F;
    surface.roughness = 0.0F;
  } else if (material.mirror >= 0.5F) {
    surface.base = material.tint * material.mirror;
    surface.metallic = 1.0F;
    surface.roughness = 0.0F;
  } else if (material.mirror > 0.0F) {
    surface.specular = 1.0F;
    surface.roughness = 0.0F;
    surface.ior = mirroring_ior(material.mirror);
  } else if (material.specular > 0.0F) {
    surface.specular = 1.0F;
    surface.roughness = std::pow(2.0F / (material.shininess + 2.0F), 0.25F);
  }
  return surface;
}

std::vector<Surface> surfaces_of(const Scene& scene) {
  if (!scene.surfaces.empty()) return scene.surfaces;
  std::vector<Surface> surfaces;
  surfaces.reserve(scene.materials.size());
  for (const Material& material : scene.materials) surfaces.push_back(surface_of(material));
  return surfaces;
}

}  // namespace splatray
