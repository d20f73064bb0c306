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

std::uint32_t faces_of(const std::vector<Material>& materials) { return material_content(materials).faces; }

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
  materials[0].phong.diffuse = glm::vec3(0.5F);
  const SceneContent nothing{.materials = material_content(materials)};
  EXPECT_EQ(picture_features(nothing, {})[SPEC_FEATURES], 0U);

  materials.push_back(with_flags(MATERIAL_DIELECTRIC));
  materials[0].phong.mirror = 0.5F;
  const SceneContent everything{.materials = material_content(materials),
                                .pools = FEATURE_COLORS | FEATURE_FIELDS | FEATURE_CLIPS,
                                .ellipses = true,
                                .leans = true,
                                .references = true,
                                .lights = true,
                                .environment_texture = true};
  EXPECT_EQ(picture_features(everything, {})[SPEC_FEATURES],
            FEATURE_MIRRORS | FEATURE_GLASS | FEATURE_COLORS | FEATURE_FIELDS | FEATURE_CLIPS |
                FEATURE_ELLIPSES | FEATURE_LEANS | FEATURE_REFERENCES | FEATURE_LIGHTS | FEATURE_SHADOWS |
                FEATURE_ENVIRONMENT);
}

TEST(Features, LightsThatNoMaterialScattersAreOff) {
  Material gold = with_flags(MATERIAL_TWO_SIDED), glass = with_flags(MATERIAL_DIELECTRIC);
  gold.phong.mirror = 1.0F;
  gold.phong.diffuse = glass.phong.diffuse = glm::vec3(0.5F);
  const auto lit = [](const std::vector<Material>& materials) {
    const SceneContent content{.materials = material_content(materials), .lights = true};
    return (picture_features(content, {})[SPEC_FEATURES] & FEATURE_LIGHTS) != 0;
  };
  EXPECT_FALSE(lit({gold, glass}));
  glass.phong.specular = 0.05F;
  EXPECT_TRUE(lit({gold, glass}));
  gold.phong.mirror = 0.9F;
  EXPECT_TRUE(lit({gold}));
}

TEST(Features, SettingsChooseTheMethod) {
  Settings settings;
  settings.blend = BLEND_PAPER;
  settings.kernel = KERNEL_GAUSSIAN;
  settings.side = SIDE_DELTA;
  settings.order = ORDER_LINEAR;
  settings.counters = true;
  settings.shadows = false;
  const SpecConstants constants =
      picture_features({.materials = {.scatters = true}, .lights = true}, settings);
  EXPECT_EQ(constants[SPEC_BLEND], BLEND_PAPER);
  EXPECT_EQ(constants[SPEC_KERNEL], KERNEL_GAUSSIAN);
  EXPECT_EQ(constants[SPEC_SIDE], SIDE_DELTA);
  EXPECT_EQ(constants[SPEC_ORDER], ORDER_LINEAR);
  EXPECT_EQ(constants[SPEC_FEATURES], FEATURE_COUNTERS | FEATURE_LIGHTS);
}

TEST(Features, QueriesDoNotDependOnShading) {
  Settings other;
  other.shadows = false;
  other.order = ORDER_LINEAR;
  EXPECT_EQ(
      query_features(
          {.materials = {.mirrors = true, .scatters = true}, .lights = true, .environment_texture = true},
          {}),
      query_features({}, other));
}

}  // namespace
}  // namespace splatray
