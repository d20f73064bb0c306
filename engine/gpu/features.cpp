#include "engine/gpu/features.h"

#include <algorithm>

namespace splatray {
namespace {

constexpr std::uint32_t SHADING = FEATURE_MIRRORS | FEATURE_LIGHTS | FEATURE_SHADOWS | FEATURE_ENVIRONMENT;

/// Whether light of lights that falls on the material comes back, other than mirrored or refracted.
bool scatters(const Material& material) {
  if ((material.flags & MATERIAL_DIELECTRIC) != 0) return material.specular > 0.0F;
  const bool colored = material.diffuse.x > 0.0F || material.diffuse.y > 0.0F || material.diffuse.z > 0.0F;
  return material.mirror < 1.0F && (colored || material.specular > 0.0F);
}

}  // namespace

MaterialContent material_content(std::span<const Material> materials) {
  MaterialContent content;
  bool all_two_sided = true, all_one_sided = true;
  for (const Material& material : materials) {
    all_two_sided = all_two_sided && material.flags == MATERIAL_TWO_SIDED;
    all_one_sided = all_one_sided && material.flags == 0;
    content.mirrors = content.mirrors || material.mirror > 0.0F;
    content.glass = content.glass || (material.flags & MATERIAL_DIELECTRIC) != 0;
    content.scatters = content.scatters || scatters(material);
  }
  content.faces = all_two_sided ? FACES_BOTH : (all_one_sided ? FACES_FRONT : FACES_MIXED);
  return content;
}

SpecConstants picture_features(const SceneContent& content, const Settings& settings) {
  const bool flat_blend = settings.blend == BLEND_PAPER || settings.blend == BLEND_LEAF;
  const bool lit = content.lights && content.materials.scatters;
  SpecConstants constants{};
  const auto add = [&](bool needed, std::uint32_t feature) {
    if (needed) constants[SPEC_FEATURES] |= feature;
  };
  add(content.materials.mirrors, FEATURE_MIRRORS);
  add(content.materials.glass, FEATURE_GLASS);
  add(content.colors, FEATURE_COLORS);
  add(content.fields && !flat_blend, FEATURE_FIELDS);
  add(content.references, FEATURE_REFERENCES);
  add(lit, FEATURE_LIGHTS);
  add(lit && settings.shadows, FEATURE_SHADOWS);
  add(content.environment_texture, FEATURE_ENVIRONMENT);
  add(settings.counters, FEATURE_COUNTERS);
  constants[SPEC_BLEND] = settings.blend;
  constants[SPEC_KERNEL] = settings.kernel;
  constants[SPEC_SIDE] = settings.side;
  constants[SPEC_FACES] = content.materials.faces;
  constants[SPEC_ORDER] = settings.order;
  constants[SPEC_STAGE] = STAGE_ALL;
  constants[SPEC_TOP_LEVELS] = content.top_levels;
  constants[SPEC_PAGES] = content.pages;
  constants[SPEC_PAGE_SHIFT] = content.page_shift;
  return constants;
}

SpecConstants empty_features(const SpecConstants& constants) {
  SpecConstants kept{};
  kept[SPEC_FEATURES] = constants[SPEC_FEATURES] & (FEATURE_ENVIRONMENT | FEATURE_COUNTERS);
  for (const std::uint32_t constant : {SPEC_ORDER, SPEC_STAGE}) kept[constant] = constants[constant];
  return kept;
}

SpecConstants query_features(const SceneContent& content, const Settings& settings) {
  SpecConstants constants = picture_features(content, settings);
  constants[SPEC_FEATURES] &= ~SHADING;
  constants[SPEC_ORDER] = 0;
  return constants;
}

}  // namespace splatray
