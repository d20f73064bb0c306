#include <algorithm>

#include "app/library/api/guard.h"
#include "app/library/api/scene_impl.h"
#include "app/library/materials.h"

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
  ObjectChange change;
  change.object = object;
  change.diffuse = vector(material.diffuse);
  change.specular = material.specular;
  change.shininess = material.shininess;
  change.tint = vector(material.tint);
  change.mirror = material.mirror;
  change.ior = material.ior;
  change.glass = material.glass;
  change.two_sided = material.two_sided && !material.glass;
  change.hidden = material.hidden;
  change.metallic = material.metallic;
  change.roughness = material.roughness;
  change.coat = material.coat;
  change.coat_roughness = material.coat_roughness;
  if (material.emission) change.emission = vector(*material.emission);
  return read_object_change(object_text(change));  // which refuses what is out of range
}

Material described(const splatray::Material& material) {
  const auto has = [&material](std::uint32_t flag) { return (material.flags & flag) != 0; };
  Material described;
  described.diffuse = array(material.diffuse);
  described.specular = material.specular;
  described.shininess = material.shininess;
  described.tint = array(material.tint);
  described.mirror = material.mirror;
  described.ior = material.ior;
  described.glass = has(MATERIAL_DIELECTRIC);
  described.two_sided = has(MATERIAL_TWO_SIDED);
  described.hidden = has(MATERIAL_HIDDEN);
  return described;
}

}  // namespace splatray::api
