#include "engine/gpu/features.h"

#include <algorithm>

namespace splatray {
namespace {

/// The cheapest treatment of faces that is right for all materials.
std::uint32_t faces(std::span<const Material> materials) {
  const auto all_have = [&](std::uint32_t flags) {
    return std::all_of(materials.begin(), materials.end(),
                       [=](const Material& material) { return material.flags == flags; });
  };
  if (all_have(MATERIAL_TWO_SIDED)) return FACES_BOTH;
  if (all_have(0)) return FACES_FRONT;
  return FACES_MIXED;
}

bool any_mirror(std::span<const Material> materials) {
  return std::any_of(materials.begin(), materials.end(),
                     [](const Material& material) { return material.mirror > 0.0F; });
}

bool any_dielectric(std::span<const Material> materials) {
  return std::any_of(materials.begin(), materials.end(),
                     [](const Material& material) { return (material.flags & MATERIAL_DIELECTRIC) != 0; });
}

}  // namespace

SpecConstants picture_features(const SceneContent& content, const Settings& settings) {
  SpecConstants constants{};
  constants[SPEC_BLEND] = settings.blend;
  constants[SPEC_KERNEL] = settings.kernel;
  constants[SPEC_SIDE] = settings.side;
  constants[SPEC_FACES] = faces(content.materials);
  constants[SPEC_MIRRORS] = any_mirror(content.materials) ? 1 : 0;
  constants[SPEC_GLASS] = any_dielectric(content.materials) ? 1 : 0;
  constants[SPEC_COLORS] = content.colors ? 1 : 0;
  constants[SPEC_SHADOWS] = settings.shadows && content.lights ? 1 : 0;
  constants[SPEC_ENVIRONMENT] = content.environment_texture ? 1 : 0;
  constants[SPEC_ORDER] = settings.order;
  constants[SPEC_COUNTERS] = settings.counters ? 1 : 0;
  constants[SPEC_LIGHTS] = content.lights ? 1 : 0;
  const bool faithful = settings.blend == BLEND_PAPER || settings.blend == BLEND_LEAF;
  constants[SPEC_REFERENCES] = content.references ? 1 : 0;
  constants[SPEC_TOP_LEVELS] = content.top_levels;
  constants[SPEC_PAGES] = content.pages;
  constants[SPEC_PAGE_SHIFT] = content.page_shift;
  constants[SPEC_FIELDS] = content.fields && !faithful ? 1 : 0;
  return constants;
}

SpecConstants empty_features(const SpecConstants& constants) {
  SpecConstants kept{};
  for (const std::uint32_t constant : {SPEC_ENVIRONMENT, SPEC_ORDER, SPEC_COUNTERS, SPEC_AOV, SPEC_PAGES})
    kept[constant] = constants[constant];
  return kept;
}

SpecConstants query_features(const SceneContent& content, const Settings& settings) {
  SpecConstants constants = picture_features(content, settings);
  for (const std::uint32_t shading : {SPEC_MIRRORS, SPEC_SHADOWS, SPEC_ENVIRONMENT, SPEC_ORDER, SPEC_LIGHTS})
    constants[shading] = 0;
  return constants;
}

}  // namespace splatray
