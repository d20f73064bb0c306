#include <algorithm>

#include "app/library/api/guard.h"
#include "app/library/api/scene_impl.h"
#include "app/library/materials.h"
#include "engine/base/number_text.h"

namespace splatray::api {

Material named_material(const std::string& name) {
  const std::vector<std::string> names = material_names();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    std::string all;
    for (const std::string& known : names) all += (all.empty() ? "" : ", ") + known;
    refuse("material '" + name + "'", "one of " + all);
  }
  return described(splatray::named_material(name));
}

ObjectChange object_change(const std::string& object, const Material& material) {
  ObjectChange change{object};
  const auto set = [&change](const char* key, const auto& value) {
    if constexpr (std::is_same_v<decltype(value), const bool&>)
      change.set(key, value ? "on" : "off");
    else
      change.set(key, number_text(value));
  };
  const auto set_color = [&change](const char* key, const Float3& color) {
    change.set(key, number_text(vector(color), '/'));
  };
  set_color("diffuse", material.diffuse);
  set("specular", material.specular);
  set("shininess", material.shininess);
  set_color("tint", material.tint);
  set("mirror", material.mirror);
  set("ior", material.ior);
  set("glass", material.glass);
  set("two-sided", material.two_sided && !material.glass);
  set("hidden", material.hidden);
  if (material.metallic) set("metallic", *material.metallic);
  if (material.roughness) set("roughness", *material.roughness);
  if (material.coat) set("coat", *material.coat);
  if (material.coat_roughness) set("coat-roughness", *material.coat_roughness);
  if (material.emission) set_color("emission", *material.emission);
  return change;
}

Material described(const splatray::Material& material) {
  const auto has = [&material](std::uint32_t flag) { return (material.flags & flag) != 0; };
  Material described;
  described.diffuse = array(material.phong.diffuse);
  described.specular = material.phong.specular;
  described.shininess = material.phong.shininess;
  described.tint = array(material.phong.tint);
  described.mirror = material.phong.mirror;
  described.ior = material.ior;
  described.glass = has(MATERIAL_DIELECTRIC);
  described.two_sided = has(MATERIAL_TWO_SIDED);
  described.hidden = has(MATERIAL_HIDDEN);
  return described;
}

}  // namespace splatray::api
