/// Texture factors: a floor, half of which has them, looks there as one whose surface has these values.
#include "engine/device/host/host_device.h"
#include "engine/scene/octahedral.h"
#include "engine/scene/splat.h"
#include "engine/scene/texture_factors.h"
#include "tests/all_tests.h"
#include "tests/light/lit.h"

namespace splatray::testing {
namespace {

constexpr std::uint8_t FACTOR = 100;

/// Something of each lobe.
Material rich_material() {
  Material material{};
  material.base = {0.8F, 0.5F, 0.2F};
  material.metallic = 0.6F;
  material.specular_color = {0.9F, 0.6F, 0.8F};
  material.roughness = 0.6F;
  material.emission = {2.0F, 1.0F, 0.5F};
  material.specular = 0.9F;
  material.transmission = 0.8F;
  material.coat = 0.8F;
  material.coat_roughness = 0.6F;
  material.layer_ior = 2.0F;
  return material;
}

class Textures : public Plane {
 protected:
  /// The floor; where x < 0 its splats have FACTOR in this column.
  static Scene scene_with(std::uint32_t flags, Material material, std::string_view column) {
    TestObject object = floor();
    object.material.flags = flags;
    Scene scene = scene_of({object});
    material.phong = scene.materials.front().phong;
    material.ior = scene.materials.front().ior;
    material.flags = flags;
    scene.materials = {material};
    if (column.empty()) return scene;
    std::vector<std::uint8_t> bytes;
    for (const uvec4& words : scene.data_pool)
      bytes.push_back(scene.root.to_world(unpack_splat(words).center).x < 0.0 ? FACTOR : 255);
    scene.columns.push_back({std::string(column), bytes});
    return scene;
  }
  /// Mean radiance of rgb that is sent from around (x, 0, 0) to an eye at the side. A sun shines on what sends out no light
  /// itself: beside such light, which lights are looked for is chance.
  vec3 radiance(const Scene& scene, double x) {
    std::vector<SceneLight> sun = {{LIGHT_DIRECTIONAL, {0.6, 1.0, 0.2}, vec3(3.0F)}};
    if (scene.materials.front().emission != vec3(0.0F)) sun.clear();
    show(scene, constant(0.3F), sun);
    const Camera camera{dvec3(x - 0.8, 1.0, 0.0), dvec3(x, 0.0, 0.0), dvec3(0.0, 1.0, 0.0), 10.0, 0.001};
    vec3 sum(0.0F);
    const Image image = picture(camera, lit(16), 8);
    for (const vec4& pixel : image.rgba) sum += vec3(pixel) / float(image.rgba.size());
    return sum;
  }
};

TEST_F(Textures, MultiplyTheirMaterialsValues) {
  SPLATRAY_NIGHTLY();
  for (const TextureFactor& factor : texture_factors()) {
    if (factor.column == COLUMN_OPACITY) continue;
    SCOPED_TRACE(factor.column);
    const bool glass = factor.number == &Material::transmission;
    const std::uint32_t flags = glass ? MATERIAL_DIELECTRIC : MATERIAL_TWO_SIDED;
    const float value = float(FACTOR) / 255.0F;
    Material changed = rich_material();
    multiply(factor, factor.color != nullptr ? value * value : value, changed);
    Material before = rich_material();
    if (factor.color != &Material::emission) changed.emission = before.emission = vec3(0.0F);
    const vec3 plain = radiance(scene_with(flags, before, ""), -1.0);
    const vec3 truth = radiance(scene_with(flags, changed, ""), -1.0);
    const Scene halves = scene_with(flags, before, factor.column);
    const vec3 left = radiance(halves, -1.0), right = radiance(halves, 1.0);
    EXPECT_LT(glm::distance(left, truth), 1e-3F * glm::length(truth));
    EXPECT_LT(glm::distance(right, plain), 2e-2F * glm::length(plain)) << "another part of the floor";
    EXPECT_GT(glm::distance(plain, truth), 5e-3F * glm::length(truth)) << "the factor is of no effect";
  }
}

TEST_F(Textures, EmissionIsTheMaterialsTimesTheFactor) {
  Material lamp{};
  lamp.layer_ior = 1.5F;
  lamp.emission = {2.0F, 1.0F, 0.5F};
  const Scene scene = scene_with(MATERIAL_TWO_SIDED, lamp, "texture-emission-g");
  const float value = float(FACTOR) / 255.0F;
  show(scene, constant(0.0F), {});
  const Camera camera{dvec3(-1.0, 1.0, 0.0), dvec3(-1.0, 0.0, 0.0), dvec3(0.0, 0.0, -1.0), 10.0, 0.001};
  for (const vec4& pixel : picture(camera, lit(1), 4).rgba) {
    EXPECT_FLOAT_EQ(pixel.x, 2.0F);
    EXPECT_NEAR(pixel.y, value * value, 1e-5F);
    EXPECT_FLOAT_EQ(pixel.z, 0.5F);
  }
  const SplatEmission emission(scene);
  double power = 0.0;
  const Emitters emitters = find_emitters(scene, scene.materials);
  for (const Emitter& emitter : *emitters) power += double(emitter.power);
  for (std::size_t i = 0; i < scene.data_pool.size(); ++i) {
    const bool left = scene.root.to_world(unpack_splat(scene.data_pool[i]).center).x < 0.0;
    const vec3 sent(2.0F, left ? value * value : 1.0F, 0.5F);
    EXPECT_EQ(emission.of(i, lamp.emission), sent);
  }
  const double mean = double(2.0F + 0.5F * (value * value + 1.0F) + 0.5F) / 3.0;
  const double expected = 16.0 * mean / (scene.root.unit_world * scene.root.unit_world);
  EXPECT_NEAR(power, expected, 0.1 * expected)
      << "splats that overlap share the floor, but stand out at its rim";
}

/// Sheets of one opacity one above the other, over a floor that sends out light.
class SeeThrough : public Lit {
 protected:
  static constexpr double OPACITY = 153.0 / 255.0;

  /// Three sheets over the floor; objects of their own may lie closer than their splats are wide.
  static std::vector<double> heights(bool joined) {
    return joined ? std::vector{0.0, 0.5, 1.0, 1.5} : std::vector{0.0, 0.5, 0.51, 1.0};
  }
  /// Sheets 4 x 4 at these heights, each an object of its own unless `joined`; the lowest is opaque.
  static Scene sheets(const std::vector<double>& heights, bool joined) {
    std::vector<TestObject> objects;
    for (const double height : heights) {
      const SurfacePatch patch =
          rectangle_surface("sheet", {-2.0, height, 2.0}, {4.0, 0.0, 0.0}, {0.0, 0.0, -4.0});
      OrientedPoints points = patch.make({.count = 4000, .even = true});
      if (joined && objects.size() == 2)
        append(objects.back().points, std::move(points));
      else
        objects.push_back({std::move(points), grey(0.0F)});
    }
    Scene scene = scene_of(objects);
    for (Material& material : scene.materials) material.specular = 0.0F;
    std::vector<std::uint8_t> bytes;
    for (const uvec4& words : scene.data_pool)
      bytes.push_back(unpack_splat(words).object == 0 ? 255 : std::uint8_t(255.0 * OPACITY));
    scene.columns.push_back({std::string(COLUMN_OPACITY), bytes});
    return scene;
  }
};

TEST_F(SeeThrough, PathsPassEachSheetAsOftenAsItsOpacitySays) {
  SPLATRAY_NIGHTLY();
  for (const bool joined : {false, true}) {
    Scene scene = sheets(heights(joined), joined);
    scene.materials[0].emission = vec3(1.0F);
    show(scene, constant(0.0F), {});
    for (const dvec3 eye : {dvec3(0.0, 3.0, 0.0), dvec3(1.5, 3.0, 0.0)}) {
      const Camera camera{eye, dvec3(0.0), dvec3(0.0, 0.0, -1.0), 10.0, 0.001};
      const Mean seen = mean_of(picture(camera, lit(1024), 8));
      EXPECT_NEAR(seen.value, std::pow(1.0 - OPACITY, 3), 4.0 * seen.error + 1e-3) << joined;
      EXPECT_LT(seen.error, 2e-3);
    }
  }
}

/// Splats far wider than the ring's tube bend so that each may be met again from the next. Light is neither lost nor added:
/// white in white.
TEST_F(SeeThrough, PathsLeaveSheetsThatTheyMeetAgain) {
  Scene scene = scene_of({{torus({.count = 60, .even = false}, 0.35, 0.005, 0.0, 2.0 * pi), grey(1.0F)}});
  for (Material& material : scene.materials) material.specular = 0.0F;
  scene.columns.push_back(
      {std::string(COLUMN_OPACITY), std::vector<std::uint8_t>(scene.data_pool.size(), 13)});
  show(scene, constant(1.0F), {});
  const Camera camera{dvec3(0.4, 0.5, 1.0), dvec3(0.0), dvec3(0.0, 1.0, 0.0), 40.0, 0.001};
  for (const vec4& pixel : picture(camera, lit(16), 128).rgba) EXPECT_NEAR(pixel.x, 1.0F, 1e-3F);
  // A driver that cuts a thread's loops short would do so to others' paths in each picture.
  tracer_.look.lights = {{LIGHT_DIRECTIONAL, {0.3, 1.0, 0.5}, vec3(3.0F)}};
  EXPECT_EQ(picture(camera, lit(16), 128).rgba, picture(camera, lit(16), 128).rgba);
}

TEST_F(SeeThrough, LightOfLightsIsWeakenedByEachSheet) {
  for (const bool joined : {false, true}) {
    Scene scene = sheets(heights(joined), joined);
    scene.materials[0].base = vec3(1.0F);
    show(scene, constant(0.0F), {{LIGHT_DIRECTIONAL, {0.5, 1.0, 0.0}, vec3(float(pi))}});
    const double cosine = 1.0 / std::sqrt(1.25);
    // From below all sheets, so that nothing but the shadow rays meets them.
    const Camera camera{dvec3(0.2, 0.4, 0.0), dvec3(0.0), dvec3(0.0, 0.0, -1.0), 10.0, 0.001};
    const Mean seen = mean_of(picture(camera, lit(16), 8));
    EXPECT_NEAR(seen.value, cosine * std::pow(1.0 - OPACITY, 3), 1e-3) << joined;
    // The host looks for sheets by a tree of its own.
    const HostDevice host;
    ShownTracer on_host(host);
    on_host.upload(scene);
    on_host.look = tracer_.look;
    EXPECT_NEAR(mean_of(on_host.render({camera, 8, 8}, lit(16))).value, seen.value, 1e-4) << joined;
  }
}

TEST_F(SeeThrough, IsCutOutByThePapersLookAndByQueries) {
  Scene scene = sheets({0.0, 0.5}, false);
  const auto seen_object = [&](std::uint8_t opacity) {
    std::vector<std::uint8_t> bytes(scene.data_pool.size(), 255);
    for (std::size_t i = 0; i < bytes.size(); ++i)
      if (unpack_splat(scene.data_pool[i]).object == 1) bytes[i] = opacity;
    scene.columns = {{std::string(COLUMN_OPACITY), bytes}};
    show(scene, constant(0.0F), {});
    Settings settings;
    settings.look = LOOK_PAPER;
    settings.aov = true;
    const Camera camera{dvec3(0.0, 3.0, 0.0), dvec3(0.0), dvec3(0.0, 0.0, -1.0), 10.0, 0.001};
    return picture(camera, settings, 1).aov[0].object;
  };
  EXPECT_EQ(seen_object(127), 0U);
  EXPECT_EQ(seen_object(128), 1U);
}

/// A floor whose normal map tilts all of it by the same: a Lambertian surface is lit by the cosine to the map's normal, from
/// where it faces the light as from where the plane alone does not.
TEST_F(Textures, NormalMapsTurnTheNormalAndNotThePlane) {
  const dvec3 tilted = glm::normalize(dvec3(0.5, 1.0, 0.3));
  const glm::ivec2 code = octahedral_nearest(tilted, NORMAL_MAP_SCALE) + NORMAL_MAP_SCALE;
  Scene scene = scene_with(MATERIAL_TWO_SIDED, {}, "");
  scene.materials[0].base = vec3(1.0F);
  scene.materials[0].layer_ior = 1.5F;
  const std::size_t splats = scene.data_pool.size();
  scene.columns = {{std::string(COLUMN_NORMAL_U), std::vector<std::uint16_t>(splats, std::uint16_t(code.x))},
                   {std::string(COLUMN_NORMAL_V), std::vector<std::uint16_t>(splats, std::uint16_t(code.y))}};
  const Camera camera{dvec3(0.0, 1.0, 0.0), dvec3(0.0), dvec3(0.0, 0.0, -1.0), 10.0, 0.001};
  const auto seen = [&](const dvec3& to_sun) {
    show(scene, constant(0.0F), {{LIGHT_DIRECTIONAL, to_sun, vec3(float(pi))}});
    return mean_of(picture(camera, lit(16), 4)).value;
  };
  for (const dvec3 to_sun : {dvec3(0.0, 1.0, 0.0), dvec3(0.5, 1.0, 0.3), dvec3(1.0, 0.1, 0.0)})
    EXPECT_NEAR(seen(to_sun), glm::dot(glm::normalize(to_sun), tilted), 2e-3);
  EXPECT_EQ(seen({1.0, -0.1, 0.3}), 0.0) << "above the map's plane, below the surface";
  EXPECT_EQ(seen({-1.0, 0.1, 0.0}), 0.0) << "above the surface, below the map's plane";
}

/// All data pools, with and without pages, give the same picture.
TEST_F(Textures, AreTheSplatsOwnWhereverTheyLie) {
  SPLATRAY_NIGHTLY();
  const VulkanDevice device;  // the host has its pools in one piece
  Scene scene = scene_with(MATERIAL_TWO_SIDED, rich_material(), "texture-roughness");
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < scene.data_pool.size(); ++i)
    bytes.push_back(static_cast<std::uint8_t>(i * 37 % 256));
  scene.columns.push_back({"texture-emission-r", bytes});
  std::vector<std::vector<vec4>> pictures;
  for (const DataPool data : {DataPool::copies, DataPool::references})
    for (const std::uint64_t page : {std::uint64_t{UINT64_MAX}, std::uint64_t{4096}}) {
      ShownTracer tracer(device, {.pools = {.data = data, .page_elements = page}});
      tracer.upload(scene);
      EXPECT_GT(tracer.pool_bytes().at(BIND_TEXTURE_POOL), 0U);
      const Camera camera{dvec3(0.0, 3.0, 0.0), dvec3(0.0), dvec3(0.0, 0.0, -1.0), 40.0, 0.001};
      pictures.push_back(tracer.render({camera, 16, 16}, lit(2)).rgba);
    }
  for (const auto& picture : pictures) EXPECT_TRUE(picture == pictures.front());
}

}  // namespace
}  // namespace splatray::testing
