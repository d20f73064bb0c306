#include "engine/gpu/features.h"

#include <gtest/gtest.h>

#include <vector>

namespace splatray {
namespace {

Material with_flags(std::uint32_t flags) {
  Material material{};
  material.flags = flags;
  return material;
}

std::uint32_t faces_of(const std::vector<Material>& materials) {
  return picture_features({.materials = materials}, {})[SPEC_FACES];
}

TEST(Features, FacesFollowTheMaterials) {
  const Material one_sided = with_flags(0), two_sided = with_flags(MATERIAL_TWO_SIDED),
                 glass = with_flags(MATERIAL_DIELECTRIC), hidden = with_flags(MATERIAL_HIDDEN);
  EXPECT_EQ(faces_of({one_sided, one_sided}), FACES_FRONT);
  EXPECT_EQ(faces_of({two_sided, two_sided}), FACES_BOTH);
  EXPECT_EQ(faces_of({one_sided, two_sided}), FACES_MIXED);
  EXPECT_EQ(faces_of({one_sided, glass}), FACES_MIXED);
  EXPECT_EQ(faces_of({one_sided, hidden}), FACES_MIXED);
  EXPECT_EQ(faces_of({two_sided, with_flags(MATERIAL_TWO_SIDED | MATERIAL_HIDDEN)}), FACES_MIXED);
}

TEST(Features, OnlyWhatTheSceneHasIsOn) {
  std::vector<Material> materials = {with_flags(0)};
  const SpecConstants plain = picture_features({.materials = materials}, {});
  for (const std::uint32_t constant : {SPEC_MIRRORS, SPEC_GLASS, SPEC_COLORS, SPEC_SHADOWS, SPEC_ENVIRONMENT,
                                       SPEC_LIGHTS, SPEC_COUNTERS, SPEC_AOV, SPEC_FIELDS})
    EXPECT_EQ(plain[constant], 0U) << constant;

  materials.push_back(with_flags(MATERIAL_DIELECTRIC));
  materials[0].mirror = 0.5F;
  const SpecConstants full = picture_features(
      {.materials = materials, .colors = true, .fields = true, .lights = true, .environment_texture = true},
      {});
  for (const std::uint32_t constant :
       {SPEC_MIRRORS, SPEC_GLASS, SPEC_COLORS, SPEC_SHADOWS, SPEC_ENVIRONMENT, SPEC_LIGHTS, SPEC_FIELDS})
    EXPECT_EQ(full[constant], 1U) << constant;
}

TEST(Features, SettingsChooseTheMethod) {
  Settings settings;
  settings.blend = BLEND_PAPER;
  settings.kernel = KERNEL_GAUSSIAN;
  settings.side = SIDE_DELTA;
  settings.order = ORDER_LINEAR;
  settings.counters = true;
  settings.shadows = false;
  const SpecConstants constants = picture_features({.lights = true}, settings);
  EXPECT_EQ(constants[SPEC_BLEND], BLEND_PAPER);
  EXPECT_EQ(constants[SPEC_KERNEL], KERNEL_GAUSSIAN);
  EXPECT_EQ(constants[SPEC_SIDE], SIDE_DELTA);
  EXPECT_EQ(constants[SPEC_ORDER], ORDER_LINEAR);
  EXPECT_EQ(constants[SPEC_COUNTERS], 1U);
  EXPECT_EQ(constants[SPEC_SHADOWS], 0U);
}

TEST(Features, QueriesDoNotDependOnShading) {
  Settings other;
  other.shadows = false;
  other.order = ORDER_LINEAR;
  EXPECT_EQ(query_features({.lights = true, .environment_texture = true}, {}), query_features({}, other));
}

}  // namespace
}  // namespace splatray
