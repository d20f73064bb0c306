#include "tests/bench/cases/scale_cases.h"

#include "engine/scene/phong.h"

namespace splatray::testing {
namespace {

constexpr std::uint64_t MILLION = 1'000'000;

Case sphere_case(const std::string& size, std::uint64_t points, bool quick) {
  Case one;
  one.name = "scale sphere " + size;
  one.scene = "scale sphere";
  one.source = "sphere";
  one.shape = Shape::sphere;
  one.fill = 1.0;
  if (quick) one.width = one.height = 128;
  if (quick) one.rays /= 16;
  Settings settings;
  settings.samples = 1;
  settings.shadows = false;
  one.runs = {{{points, true, {}}, settings, ""}};
  return one;
}

}  // namespace

std::vector<Case> scale_spheres(bool quick) {
  std::vector<Case> list{sphere_case("10k", 10'000, quick), sphere_case("100k", 100'000, quick)};
  if (quick) return list;
  list.push_back(scale_sphere(false));
  list.push_back(sphere_case("10M", 10 * MILLION, false));
  list.push_back(sphere_case("30M", 30 * MILLION, false));
  return list;
}

std::vector<Case> scale_scenes(bool quick) {
  std::vector<Case> list;
  for (const Case& one : cases(quick))
    if (one.name.starts_with("Table I ")) list.push_back(one);
  return list;
}

Material scale_material() {
  Material material{};
  material.phong.diffuse = vec3(0.7F);
  material.phong.tint = vec3(1.0F);
  material.phong.shininess = 30.0F;
  material.ior = 1.0F;
  material.flags = MATERIAL_TWO_SIDED;
  follow_phong(material);
  return material;
}

Case scale_sphere(bool quick) {
  return quick ? sphere_case("100k", 100'000, true) : sphere_case("1M", MILLION, false);
}

}  // namespace splatray::testing
