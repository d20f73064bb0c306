#include "engine/gpu/features.h"

#include <algorithm>

#include "engine/scene/look_style.h"
#include "engine/scene/material_fields.h"

namespace splatray {
namespace {

constexpr std::uint32_t SHADING = FEATURE_MIRRORS | FEATURE_LIGHTS | FEATURE_SHADOWS | FEATURE_ENVIRONMENT;

/// Whether the material reflects direct light other than as a mirror, as LOOK_PAPER shows it.
bool scatters(const Material& material) {
  const Phong& phong = material.phong;
  if ((material.flags & MATERIAL_DIELECTRIC) != 0) return phong.specular > 0.0F;
  const bool colored = phong.diffuse.x > 0.0F || phong.diffuse.y > 0.0F || phong.diffuse.z > 0.0F;
  return phong.mirror < 1.0F && (colored || phong.specular > 0.0F);
}

/// FEATURE_* of a material's lobes and emission.
std::uint32_t lobes_of(const Material& material, std::uint32_t textures) {
  const bool varies = (textures & FEATURE_TEXTURE_LAYER) != 0;
  const bool glass = (material.flags & MATERIAL_DIELECTRIC) != 0;
  const bool all_metal = material.metallic >= 1.0F && !varies,
             all_clear = glass && material.transmission >= 1.0F && !varies;
  std::uint32_t features = 0;
  const auto add = [&](bool needed, std::uint32_t feature) { features |= needed ? feature : 0; };
  add(!all_metal && !all_clear, FEATURE_DIFFUSE);
  add(!all_metal && material.specular > 0.0F, FEATURE_SPECULAR);
  for (const MaterialField& field : material_fields())
    add(glm::any(glm::greaterThan(field.of(material), vec3(0.0F))), field.feature);
  return features;
}

}  // namespace

MaterialContent material_content(std::span<const Material> materials, std::uint32_t textures) {
  MaterialContent content;
  content.open = true;
  bool all_two_sided = true, all_one_sided = true;
  for (const Material& material : materials) {
    all_two_sided = all_two_sided && material.flags == MATERIAL_TWO_SIDED;
    all_one_sided = all_one_sided && material.flags == 0;
    content.open = content.open && material.flags != 0 && (material.flags & MATERIAL_HIDDEN) == 0;
    content.mirrors = content.mirrors || material.phong.mirror > 0.0F;
    const bool glass = (material.flags & MATERIAL_DIELECTRIC) != 0;
    content.glass = content.glass || glass;
    content.panes = content.panes || (glass && material.ior == 1.0F);
    content.scatters = content.scatters || scatters(material);
    content.lobes |= lobes_of(material, textures);
  }
  content.faces = all_two_sided ? FACES_BOTH : (all_one_sided ? FACES_FRONT : FACES_MIXED);
  return content;
}

namespace {

/// FEATURE_* of a look other than LOOK_PAPER.
std::uint32_t light_features(const SceneContent& content, const Settings& settings) {
  const LookStyle style = look_style(settings.look);
  const bool all = style.materials, lights = content.lights && style.lights, sky = content.sky && style.paths;
  std::uint32_t features = all ? content.materials.lobes : FEATURE_DIFFUSE;
  const auto add = [&](bool needed, std::uint32_t feature) { features |= needed ? feature : 0; };
  add(all && content.materials.glass, FEATURE_GLASS);
  add(lights, FEATURE_LIGHTS);
  add(lights && content.sized_lights, FEATURE_SIZES);
  add(sky, FEATURE_SKY);
  add((lights || sky) && settings.shadows, FEATURE_SHADOWS);
  add(all && settings.straight_shadows, FEATURE_STRAIGHT);
  add(all && content.materials.panes && (lights || sky) && settings.shadows, FEATURE_PANES);
  add(settings.lens_radius_world > 0.0, FEATURE_LENS);
  return features;
}

std::uint32_t phong_features(const SceneContent& content, const Settings& settings) {
  const bool lit = content.lights && content.materials.scatters;
  std::uint32_t features = 0;
  const auto add = [&](bool needed, std::uint32_t feature) { features |= needed ? feature : 0; };
  add(content.materials.mirrors, FEATURE_MIRRORS);
  add(content.materials.glass, FEATURE_GLASS);
  add(lit, FEATURE_LIGHTS);
  add(lit && settings.shadows, FEATURE_SHADOWS);
  return features;
}

}  // namespace

SpecConstants picture_features(const SceneContent& content, const Settings& settings) {
  const bool flat_blend = settings.blend != BLEND_WINDOW && settings.blend != BLEND_NEAREST;
  SpecConstants constants{};
  const auto add = [&](bool needed, std::uint32_t feature) {
    if (needed) constants[SPEC_FEATURES] |= feature;
  };
  constants[SPEC_FEATURES] =
      settings.look == LOOK_PAPER ? phong_features(content, settings) : light_features(content, settings);
  const std::uint32_t unseen =
      (look_style(settings.look).colors ? 0 : FEATURE_COLORS) | (flat_blend ? FEATURE_FIELDS : 0);
  constants[SPEC_FEATURES] |= content.pools & ~unseen;
  add(content.ellipses, FEATURE_ELLIPSES);
  add(content.leans && !flat_blend, FEATURE_LEANS);
  const bool textured = settings.look != LOOK_PAPER && look_style(settings.look).materials;
  add(textured || (content.textures & FEATURE_OPACITY) != 0, content.textures);
  add(content.references, FEATURE_REFERENCES);
  add(content.environment_texture, FEATURE_ENVIRONMENT);
  add(settings.counters, FEATURE_COUNTERS);
  add(!settings.region.empty(), FEATURE_REGION);
  add(content.fused, FEATURE_FUSED);
  constants[SPEC_BLEND] = settings.blend;
  constants[SPEC_KERNEL] = settings.kernel;
  constants[SPEC_SIDE] = settings.side;
  // Where nothing is looked through, what is behind glass is not to be seen: glass shows both of its sides.
  const bool opaque = look_style(settings.look).opaque;
  const std::uint32_t opaque_faces = content.materials.open ? FACES_BOTH : FACES_OPAQUE;
  constants[SPEC_FACES] = opaque && content.materials.glass ? opaque_faces : content.materials.faces;
  // What is opaque is two-sided in a region (shaders/trace/accept.glsl).
  if (!settings.region.empty() && constants[SPEC_FACES] == FACES_FRONT) constants[SPEC_FACES] = FACES_BOTH;
  if (settings.cutaway && constants[SPEC_FACES] == FACES_BOTH) constants[SPEC_FACES] = FACES_CUT;
  constants[SPEC_ORDER] = settings.order;
  constants[SPEC_LOOK] = settings.look;
  constants[SPEC_TOP_LEVELS] = content.top_levels;
  for (std::uint32_t i = 0; i < POOLS; ++i) constants[SPEC_PAGES + i] = std::max(content.pages[i], 1U) - 1;
  constants[SPEC_PAGE_SHIFT] = content.page_shift;
  return constants;
}

SpecConstants query_features(const SceneContent& content, const Settings& settings) {
  Settings phong = settings;
  phong.look = LOOK_PAPER;
  SpecConstants constants = picture_features(content, phong);
  constants[SPEC_FEATURES] &= ~SHADING;
  // Rays from an eye meet what faces it by its front.
  if (constants[SPEC_FACES] == FACES_CUT)
    constants[SPEC_FACES] = settings.side == SIDE_SIDE ? FACES_FRONT : FACES_BOTH;
  constants[SPEC_ORDER] = 0;
  return constants;
}

}  // namespace splatray
