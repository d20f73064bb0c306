/// Changes to single objects' materials.
#include "app/library/request/object_change.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "app/library/materials.h"
#include "engine/base/error.h"
#include "engine/scene/surface.h"

namespace splatray {
namespace {

const std::vector<std::string> NAMES = {"dragon", "a:b", "twin", "twin", "", "7"};

ObjectLooks matte() {
  const Material material = named_material("matte");
  return {std::vector<Material>(NAMES.size(), material),
          std::vector<Surface>(NAMES.size(), surface_of(material))};
}

std::string refusal(const std::string& text) {
  try {
    ObjectLooks looks = matte();
    apply_object_changes({read_object_change(text)}, NAMES, looks);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    return error.what();
  }
  return "";
}

TEST(ObjectChange, ChangesWhatIsSetAndNothingElse) {
  ObjectLooks looks = matte();
  const std::vector<Material>& materials = looks.materials;
  apply_object_changes(
      {read_object_change("dragon:preset=gold,hidden=on"), read_object_change("a:b:mirror=0.25"),
       read_object_change("2:diffuse=1/0/0.5,two-sided=off")},
      NAMES, looks);
  EXPECT_EQ(materials[0].tint, named_material("gold").tint);
  EXPECT_EQ(materials[0].flags, MATERIAL_TWO_SIDED | MATERIAL_HIDDEN);
  EXPECT_EQ(materials[1].mirror, 0.25F);
  EXPECT_EQ(materials[1].diffuse, named_material("matte").diffuse);
  EXPECT_EQ(materials[2].diffuse, glm::vec3(1.0F, 0.0F, 0.5F));
  EXPECT_EQ(materials[2].flags, 0U);
  EXPECT_EQ(materials[3].diffuse, named_material("matte").diffuse);
}

TEST(ObjectChange, ObjectsKeepTheirBit) {
  ObjectLooks looks = matte();
  const std::vector<Material>& materials = looks.materials;
  looks.materials[4].mask_bit = 3;
  apply_object_changes({read_object_change("4:preset=glass"), read_object_change("4:ior=1.3")}, NAMES, looks);
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

TEST(ObjectChange, SurfacesFollowMaterials) {
  ObjectLooks looks = matte();
  looks.surfaces[1].emission = vec3(2.0F);
  apply_object_changes(
      {read_object_change("dragon:preset=gold,roughness=0.3"), read_object_change("1:two-sided=off"),
       read_object_change("2:emission=5/4/0,coat=1,coat-roughness=0.2,metallic=0.5")},
      NAMES, looks);
  EXPECT_EQ(looks.surfaces[0].metallic, 1.0F);
  EXPECT_EQ(looks.surfaces[0].roughness, 0.3F);
  EXPECT_EQ(looks.surfaces[1].emission, vec3(2.0F));
  EXPECT_EQ(looks.surfaces[2].emission, vec3(5.0F, 4.0F, 0.0F));
  EXPECT_EQ(looks.surfaces[2].coat_roughness, 0.2F);
  EXPECT_NE(refusal("dragon:roughness=2"), "");
  EXPECT_NE(refusal("dragon:emission=-1/0/0"), "");
}

TEST(ObjectChange, TheOrderOfKeysDoesNotMatter) {
  const std::vector<std::string> texts = {"0:roughness=0.1,metallic=1", "0:diffuse=0.5/0.5/0.5",
                                          "dragon:specular=0.5", "0:preset=glossy", "0:two-sided=off"};
  std::vector<std::size_t> order = {0, 1, 2, 3, 4};
  std::optional<ObjectLooks> first;
  do {
    std::vector<ObjectChange> options;
    for (const std::size_t i : order) options.push_back(read_object_change(texts[i]));
    ObjectLooks looks = matte();
    apply_object_changes(options, NAMES, looks);
    EXPECT_EQ(looks.surfaces[0].roughness, 0.1F);
    EXPECT_EQ(looks.surfaces[0].metallic, 1.0F);
    EXPECT_EQ(looks.surfaces[0].base, vec3(0.5F));
    if (!first) first = looks;
    EXPECT_TRUE(object_changes_between(*first, looks, NAMES).empty());
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(ObjectChange, ASurfaceOfItsOwnStaysWhenItsMaterialChanges) {
  ObjectLooks looks = matte();
  looks.surfaces[0].metallic = 0.7F;
  looks.surfaces[0].emission = vec3(2.0F);
  apply_object_changes({read_object_change("0:diffuse=0.1/0.2/0.3")}, NAMES, looks);
  EXPECT_EQ(looks.surfaces[0].metallic, 0.7F);
  EXPECT_EQ(looks.surfaces[0].emission, vec3(2.0F));
  EXPECT_EQ(looks.surfaces[0].base, vec3(0.1F, 0.2F, 0.3F));
  apply_object_changes({read_object_change("0:preset=gold")}, NAMES, looks);
  EXPECT_EQ(looks.surfaces[0].metallic, 1.0F);
  EXPECT_EQ(looks.surfaces[0].emission, vec3(0.0F)) << "a preset replaces all";
}

TEST(ObjectChange, DifferencesAreFoundAndAppliedAgain) {
  const ObjectLooks loaded = matte();
  ObjectLooks shown = loaded;
  shown.materials[0] = named_material("glass");
  shown.surfaces[0] = surface_of(shown.materials[0]);
  shown.surfaces[0].roughness = 0.25F;
  shown.materials[1].flags |= MATERIAL_HIDDEN;
  shown.materials[3].diffuse.y = 0.1F;
  shown.surfaces[3] = surface_of(shown.materials[3]);
  shown.materials[4].shininess = 7.7F;
  shown.surfaces[5].emission = vec3(3.0F, 0.0F, 0.0F);
  const auto changes = object_changes_between(loaded, shown, NAMES);
  ASSERT_EQ(changes.size(), 5U);
  EXPECT_EQ(changes[1].object, "a:b");
  EXPECT_EQ(changes[2].object, "3");
  ObjectLooks again = loaded;
  std::vector<ObjectChange> read;
  for (const ObjectChange& change : changes) read.push_back(read_object_change(object_text(change)));
  apply_object_changes(read, NAMES, again);
  EXPECT_TRUE(object_changes_between(shown, again, NAMES).empty());
}

}  // namespace
}  // namespace splatray
