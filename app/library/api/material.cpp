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

splatray::Material changed(splatray::Material material, const Material& to) {
  material.diffuse = vector(to.diffuse);
  material.specular = to.specular;
  material.shininess = to.shininess;
  material.tint = vector(to.tint);
  material.mirror = to.mirror;
  material.ior = to.ior;
  const auto set = [&material](std::uint32_t flag, bool on) {
    material.flags = on ? material.flags | flag : material.flags & ~flag;
  };
  set(MATERIAL_DIELECTRIC, to.glass);
  set(MATERIAL_TWO_SIDED, to.two_sided && !to.glass);
  set(MATERIAL_HIDDEN, to.hidden);
  return material;
}

Material described(const splatray::Material& material) {
  const auto has = [&material](std::uint32_t flag) { return (material.flags & flag) != 0; };
  return {array(material.diffuse),  material.specular,       material.shininess,
          array(material.tint),     material.mirror,         material.ior,
          has(MATERIAL_DIELECTRIC), has(MATERIAL_TWO_SIDED), has(MATERIAL_HIDDEN)};
}

}  // namespace splatray::api
