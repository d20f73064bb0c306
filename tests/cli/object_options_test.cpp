/// Changes to single objects' materials.
#include "app/library/request/object_change.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "app/library/materials.h"
#include "engine/base/error.h"
#include "engine/scene/phong.h"

namespace splatray {
namespace {

const std::vector<std::string> NAMES = {"dragon", "a:b", "twin", "twin", "", "7"};

std::vector<Material> matte() { return {NAMES.size(), named_material("matte")}; }

std::string refusal(const std::string& text) {
  try {
    std::vector<Material> materials = matte();
    apply_object_changes({read_object_change(text)}, NAMES, materials);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    return error.what();
  }
  return "";
}

TEST(ObjectChange, ChangesWhatIsSetAndNothingElse) {
  std::vector<Material> materials = matte();
  apply_object_changes(
      {read_object_change("dragon:preset=gold,hidden=on"), read_object_change("a:b:mirror=0.25"),
       read_object_change("2:diffuse=1/0/0.5,two-sided=off")},
      NAMES, materials);
  EXPECT_EQ(materials[0].phong.tint, named_material("gold").phong.tint);
  EXPECT_EQ(materials[0].flags, MATERIAL_TWO_SIDED | MATERIAL_HIDDEN);
  EXPECT_EQ(materials[1].phong.mirror, 0.25F);
  EXPECT_EQ(materials[1].phong.diffuse, named_material("matte").phong.diffuse);
  EXPECT_EQ(materials[2].phong.diffuse, glm::vec3(1.0F, 0.0F, 0.5F));
  EXPECT_EQ(materials[2].flags, 0U);
  EXPECT_EQ(materials[3].phong.diffuse, named_material("matte").phong.diffuse);
}

TEST(ObjectChange, ObjectsKeepTheirBit) {
  std::vector<Material> materials = matte();
  materials[4].mask_bit = 3;
  apply_object_changes({read_object_change("4:preset=glass"), read_object_change("4:ior=1.3")}, NAMES,
                       materials);
  EXPECT_NE(materials[4].flags & MATERIAL_DIELECTRIC, 0U);
  EXPECT_EQ(materials[4].mask_bit, 3U);
}

TEST(ObjectChange, RefusalsNameWhatExists) {
  EXPECT_NE(refusal("dragoon:hidden=on").find("'dragon', 'a:b'"), std::string::npos);
  EXPECT_NE(refusal("6:hidden=on").find("below 6"), std::string::npos);
  EXPECT_NE(refusal("twin:hidden=on").find("several"), std::string::npos);
  EXPECT_NE(refusal("dragon:colour=1").find("'diffuse'"), std::string::npos);
  EXPECT_NE(refusal("dragon:preset=wood").find("'ruby'"), std::string::npos);
  for (const char* text :
       {"dragon", "dragon:", ":hidden=on", "dragon:hidden", "dragon:hidden=maybe", "dragon:mirror=2",
        "dragon:mirror=", "dragon:diffuse=1/2", "dragon:diffuse=1/2/3", "dragon:ior=0", "dragon:ior=nan",
        "dragon:shininess=0", "dragon:mirror=0.5,,hidden=on", "dragon:tint=1,0,0"})
    EXPECT_NE(refusal(text), "") << text;
}

TEST(ObjectChange, GltfsNumbersFollowPhongs) {
  std::vector<Material> materials = matte();
  materials[1].emission = vec3(2.0F);
  apply_object_changes(
      {read_object_change("dragon:preset=gold,roughness=0.3"), read_object_change("1:two-sided=off"),
       read_object_change("2:emission=5/4/0,coat=1,coat-roughness=0.2,metallic=0.5")},
      NAMES, materials);
  EXPECT_EQ(materials[0].metallic, 1.0F);
  EXPECT_EQ(materials[0].roughness, 0.3F);
  EXPECT_EQ(materials[1].emission, vec3(2.0F));
  EXPECT_EQ(materials[2].emission, vec3(5.0F, 4.0F, 0.0F));
  EXPECT_EQ(materials[2].coat_roughness, 0.2F);
  EXPECT_NE(refusal("dragon:roughness=2"), "");
  EXPECT_NE(refusal("dragon:emission=-1/0/0"), "");
}

TEST(ObjectChange, TheOrderOfKeysDoesNotMatter) {
  const std::vector<std::string> texts = {"0:roughness=0.1,metallic=1", "0:diffuse=0.5/0.5/0.5",
                                          "dragon:specular=0.5", "0:preset=glossy", "0:two-sided=off"};
  std::vector<std::size_t> order = {0, 1, 2, 3, 4};
  std::optional<std::vector<Material>> first;
  do {
    std::vector<ObjectChange> options;
    for (const std::size_t i : order) options.push_back(read_object_change(texts[i]));
    std::vector<Material> materials = matte();
    apply_object_changes(options, NAMES, materials);
    EXPECT_EQ(materials[0].roughness, 0.1F);
    EXPECT_EQ(materials[0].metallic, 1.0F);
    EXPECT_EQ(materials[0].base, vec3(0.5F));
    if (!first) first = materials;
    EXPECT_TRUE(object_changes_between(*first, materials, NAMES).empty());
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(ObjectChange, NumbersThatDidNotFollowPhongStayWhenItChanges) {
  std::vector<Material> materials = matte();
  materials[0].metallic = 0.7F;
  materials[0].emission = vec3(2.0F);
  apply_object_changes({read_object_change("0:diffuse=0.1/0.2/0.3")}, NAMES, materials);
  EXPECT_EQ(materials[0].metallic, 0.7F);
  EXPECT_EQ(materials[0].emission, vec3(2.0F));
  EXPECT_EQ(materials[0].base, vec3(0.1F, 0.2F, 0.3F));
  apply_object_changes({read_object_change("0:preset=gold")}, NAMES, materials);
  EXPECT_EQ(materials[0].metallic, 1.0F);
  EXPECT_EQ(materials[0].emission, vec3(0.0F)) << "a preset replaces all";
}

TEST(ObjectChange, DifferencesAreFoundAndAppliedAgain) {
  const std::vector<Material> loaded = matte();
  std::vector<Material> shown = loaded;
  shown[0] = named_material("glass");
  shown[0].roughness = 0.25F;
  shown[1].flags |= MATERIAL_HIDDEN;
  shown[3].phong.diffuse.y = 0.1F;
  follow_phong(shown[3]);
  shown[4].phong.shininess = 7.7F;
  shown[5].emission = vec3(3.0F, 0.0F, 0.0F);
  const auto changes = object_changes_between(loaded, shown, NAMES);
  ASSERT_EQ(changes.size(), 5U);
  EXPECT_EQ(changes[1].object, "a:b");
  EXPECT_EQ(changes[2].object, "3");
  std::vector<Material> again = loaded;
  std::vector<ObjectChange> read;
  for (const ObjectChange& change : changes) read.push_back(read_object_change(object_text(change)));
  apply_object_changes(read, NAMES, again);
  EXPECT_TRUE(object_changes_between(shown, again, NAMES).empty());
}

}  // namespace
}  // namespace splatray
