/// Textures of a glTF quad that is written by hand: what they make of its points.
#include <cmath>
#include <string>

#include "engine/scene/octahedral.h"
#include "tests/readers/read_error.h"

namespace splatray {
namespace {

/// A square of edge 2 in z = 0, around the origin, whose u runs along x from 0 to 1. Its one picture is a PNG of 8 x 1 texels: on
/// the left 255, 128, 0, 255, on the right 51, 0, 255, 102.
std::string quad(const std::string& material, const std::string& attributes = R"(,"TEXCOORD_0":1)") {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0)" +
         attributes + R"(},"mode":5,"material":0}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
{"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"}],
"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":32}],
"buffers":[{"byteLength":80,"uri":"data:application/octet-stream;base64,AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAACAvwAAgD8AAAAAAACAPwAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AACAPwAAgD8="}],
"images":[{"uri":"data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAgAAAABCAYAAADjAO9DAAAAFElEQVR42mP438DwHxkbM/xPQ8YAKGwQWcjjfF4AAAAASUVORK5CYII="}],
"samplers":[{"wrapS":33071}],"textures":[{"source":0,"sampler":0}],"materials":[{)" +
         material + "}]}";
}

Input read_quad(const std::string& json) {
  const TempFolder folder;
  return read_input({folder.write("quad.gltf", json)}, keeping_meshes());
}

/// The bytes of a column on the left and on the right, away from the middle; -1 where they differ.
struct Halves {
  double left = -1.0, right = -1.0;
  bool operator==(const Halves&) const = default;
};
std::ostream& operator<<(std::ostream& out, const Halves& halves) {
  return out << halves.left << " and " << halves.right;
}
Halves halves_of(const InputObject& object, const std::string& name) {
  const Column* column = find_column(object.points.columns, name);
  if (column == nullptr) return {};
  Halves halves{-2.0, -2.0};
  for (std::size_t i = 0; i < object.points.size(); ++i) {
    const double x = object.points.position[i].x, value = column->number(i);
    if (std::abs(x) < 0.2) continue;
    double& half = x < 0.0 ? halves.left : halves.right;
    half = half == -2.0 || half == value ? value : -1.0;
  }
  return halves;
}

TEST(GltfTextures, AreSampledWherePointsAre) {
  const Input input = read_quad(quad(
      R"("pbrMetallicRoughness":{"metallicFactor":0.5,"metallicRoughnessTexture":{"index":0}},
"emissiveFactor":[1,1,0.5],"emissiveTexture":{"index":0},"extensions":{
"KHR_materials_emissive_strength":{"emissiveStrength":4},
"KHR_materials_transmission":{"transmissionFactor":0.5,"transmissionTexture":{"index":0}},
"KHR_materials_specular":{"specularTexture":{"index":0},"specularColorTexture":{"index":0}},
"KHR_materials_clearcoat":{"clearcoatFactor":1,"clearcoatTexture":{"index":0},"clearcoatRoughnessFactor":0.5,
"clearcoatRoughnessTexture":{"index":0}}})"));
  const InputObject& object = input.objects[0];
  EXPECT_EQ(object.points.columns.size(), 12U);
  EXPECT_EQ(halves_of(object, "texture-metallic"), (Halves{0, 255}));
  EXPECT_EQ(halves_of(object, "texture-roughness"), (Halves{128, 0}));
  EXPECT_EQ(halves_of(object, "texture-transmission"), (Halves{255, 51}));
  EXPECT_EQ(halves_of(object, "texture-specular"), (Halves{255, 102}));
  EXPECT_EQ(halves_of(object, "texture-coat"), (Halves{255, 51}));
  EXPECT_EQ(halves_of(object, "texture-coat-roughness"), (Halves{128, 0}));
  // sRGB: 128 is 0.2159, 51 is 0.0331; stored are square roots.
  for (const std::string of : {"texture-emission-", "texture-specular-"}) {
    EXPECT_EQ(halves_of(object, of + "r"), (Halves{255, 46}));
    EXPECT_EQ(halves_of(object, of + "g"), (Halves{118, 0}));
    EXPECT_EQ(halves_of(object, of + "b"), (Halves{0, 255}));
  }
  EXPECT_EQ(object.material.emission, glm::vec3(4.0F, 4.0F, 2.0F)) << "the factor, not the texture's mean";
  EXPECT_EQ(object.material.metallic, 0.5F);
  EXPECT_EQ(object.material.roughness, 1.0F);
}

TEST(GltfTextures, CountByTheirMeanWithoutCoordinates) {
  const std::string material =
      R"("emissiveFactor":[1,1,1],"emissiveTexture":{"index":0},"pbrMetallicRoughness":{
"metallicRoughnessTexture":{"index":0,"texCoord":1}})";
  const Input input = read_quad(quad(material));
  const InputObject& object = input.objects[0];
  EXPECT_EQ(object.points.columns.size(), 3U) << "the emissive texture's alone";
  EXPECT_FLOAT_EQ(object.material.metallic, 0.5F);
  EXPECT_FLOAT_EQ(object.material.roughness, 64.0F / 255.0F);
  const Input bare = read_quad(quad(material, ""));
  EXPECT_TRUE(bare.objects[0].points.columns.empty());
  EXPECT_FLOAT_EQ(bare.objects[0].material.emission.z, 0.5F);
}

TEST(GltfTextures, AlphaThatBlendsIsOpacity) {
  const auto read = [](const std::string& more) {
    return read_quad(
        quad(R"("alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorTexture":{"index":0})" + more + "}"));
  };
  EXPECT_EQ(halves_of(read("").objects[0], "texture-opacity"), (Halves{255, 102}));
  const Input half = read(R"(,"baseColorFactor":[1,1,1,0.4])");
  EXPECT_EQ(halves_of(half.objects[0], "texture-opacity"), (Halves{102, 41}));
  EXPECT_TRUE(half.notes.empty());
  const Input solid = read_quad(quad(R"("alphaMode":"BLEND")"));
  EXPECT_TRUE(solid.objects[0].points.columns.empty()) << "opaque all over";
}

/// The same quad with a COLOR_0 of bytes whose alpha is 255, but 128 at the vertices of x = 1.
std::string fading_quad(const std::string& alpha_mode) {
  std::string json = quad(alpha_mode + R"(,"pbrMetallicRoughness":{"baseColorTexture":{"index":0}})",
                          R"(,"TEXCOORD_0":1,"COLOR_0":2)");
  json.insert(json.find(R"("type":"VEC2"})") + 14,
              R"(,{"bufferView":2,"componentType":5121,"normalized":true,"count":4,"type":"VEC4"})");
  json.insert(json.find(R"("byteLength":32})") + 16, R"(,{"buffer":1,"byteLength":16})");
  json.insert(json.find(R"("buffers":[)") + 11,
              R"({"byteLength":16,"uri":"data:application/octet-stream;base64,/////////4D/////////gA=="},)");
  std::string::size_type at = 0;  // the new buffer is the first one
  for (const char* number : {"1", "1", "0"}) {
    at = json.find(R"("buffer":)", at) + 9;
    json.replace(at, 1, number);
  }
  return json;
}

/// The column's value at the point nearest to this x, y 0.
double value_at(const InputObject& object, const std::string& name, double x) {
  const Column* column = find_column(object.points.columns, name);
  std::size_t nearest = 0;
  const auto distance = [&](std::size_t i) {
    return glm::distance(object.points.position[i], glm::dvec3(x, 0, 0));
  };
  for (std::size_t i = 0; i < object.points.size(); ++i)
    if (distance(i) < distance(nearest)) nearest = i;
  return column == nullptr ? -1.0 : column->number(nearest);
}

TEST(GltfTextures, AlphaOfVerticesMultipliesThatOfTheTexture) {
  const Input blend = read_quad(fading_quad(R"("alphaMode":"BLEND")"));
  const double half = 128.0 / 255.0;
  EXPECT_NEAR(value_at(blend.objects.at(0), "texture-opacity", -0.5), 255.0 * (0.75 + 0.25 * half), 4.0);
  EXPECT_NEAR(value_at(blend.objects.at(0), "texture-opacity", 0.5), 102.0 * (0.25 + 0.75 * half), 4.0);
  // 0.4 of the right half is above the cutoff where the vertices' alpha is above 0.75: nothing is there from the middle on.
  const auto right_end = [](const std::string& cutoff) {
    double most = -1.0;
    const Input mask = read_quad(fading_quad(R"("alphaMode":"MASK","alphaCutoff":)" + cutoff));
    for (const glm::dvec3& place : mask.objects.at(0).points.position) most = std::max(most, place.x);
    return most;
  };
  EXPECT_NEAR(right_end("0.25"), 2.0 * (1.0 - 0.625) / (1.0 - half) - 1.0, 0.05)
      << "where 0.4 times it is 0.25";
  EXPECT_GT(right_end("0.1"), 0.95);
}

TEST(GltfTextures, NormalMapsTiltWhereTheirPictureSays) {
  const Input input = read_quad(quad(R"("normalTexture":{"index":0,"scale":0.5})"));
  const InputObject& object = input.objects[0];
  // On the left 255, 128, 0: x 1, y 0, z none. On the right 51, 0, 255: x -0.6, y -1, z 1. v leads along y, the map's y against it.
  const auto normal = [](double x, double y, double z) {
    return glm::dvec2(octahedral_nearest(glm::normalize(glm::dvec3(x, y, z)), 2047) + 2047);
  };
  const double zero = 2.0 * 128.0 / 255.0 - 1.0;
  const glm::dvec2 left = normal(0.5, -0.5 * zero, 0.0), right = normal(-0.3, 0.5, 1.0);
  EXPECT_EQ(halves_of(object, "texture-normal-u"), (Halves{left.x, right.x}));
  EXPECT_EQ(halves_of(object, "texture-normal-v"), (Halves{left.y, right.y}));
}

TEST(GltfTextures, ThatAreNotModelledAreNotedOnce) {
  const Input input = read_quad(quad(
      R"("normalTexture":{"index":0},"occlusionTexture":{"index":0},"extensions":{"KHR_materials_clearcoat":{
"clearcoatFactor":1,"clearcoatNormalTexture":{"index":0}}}},{"normalTexture":{"index":0})"));
  ASSERT_EQ(input.notes.size(), 1U);
  EXPECT_TRUE(has_note(input, "ignored textures 'clearcoatNormalTexture', which are not modelled"));
  EXPECT_TRUE(read_quad(quad(R"("doubleSided":true)")).notes.empty());
}

TEST(GltfTextures, ThatAreNotThereCostNothing) {
  const Input input = read_quad(quad(R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0}})"));
  EXPECT_TRUE(input.objects[0].points.columns.empty());
  EXPECT_FALSE(input.objects[0].points.color.empty());
}

}  // namespace
}  // namespace splatray
