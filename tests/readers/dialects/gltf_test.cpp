/// glTF as people have it: captures, names with "+", alpha without a texture, other versions and compressions.
#include "engine/scene/texture_factors.h"
#include "tests/readers/read_error.h"

namespace splatray {
namespace {

class GltfDialects : public ::testing::Test {
 protected:
  /// A scene of four points, or of two triangles, with `attributes` beside POSITION; colours are VEC4 of floats, `colors`.
  std::filesystem::path write(const std::string& name, const std::string& attributes,
                              const std::string& material, const std::vector<float>& colors,
                              bool triangles = false, const std::string& more = "",
                              const std::string& uri = "a.bin") {
    std::string bytes;
    for (const float v : {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 1.0F, 1.0F, 0.0F, 0.0F, 1.0F, 0.0F})
      bytes += bytes_of(v);
    for (std::size_t i = 0; i < 16; ++i) bytes += bytes_of(i < colors.size() ? colors[i] : 1.0F);
    for (const unsigned index : {0U, 1U, 2U, 0U, 2U, 3U}) bytes += bytes_of(index);
    folder_.write(uri == "a%2Bb%20c.bin" ? "a+b c.bin" : uri, bytes);
    const std::string primitive = R"({"attributes":{"POSITION":0)" + attributes + R"(},"material":0,)" +
                                  (triangles ? R"("indices":2)" : R"("mode":0)") + "}";
    return folder_.write(
        name,
        R"({"asset":{"version":"2.0"})" + more +
            R"(,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[)" + primitive +
            R"(]}],"materials":[)" + material +
            R"(],"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)" +
            R"({"bufferView":1,"componentType":5126,"count":4,"type":"VEC4"},)" +
            R"({"bufferView":2,"componentType":5125,"count":6,"type":"SCALAR"},)" +
            R"({"bufferView":1,"componentType":5126,"count":4,"type":"SCALAR"}],)" +
            R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":64},)" +
            R"({"buffer":0,"byteOffset":112,"byteLength":24}],"buffers":[{"uri":")" + uri +
            R"(","byteLength":136}]})");
  }
  static std::string alpha(const std::string& mode, const std::string& factor) {
    return R"({"alphaMode":")" + mode + R"(","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,)" + factor +
           "]}}";
  }
  TempFolder folder_;
};

const std::string COLORS = R"(,"COLOR_0":1)";
/// White, of alpha 1, 0.25, 0.75 and 0.
const std::vector<float> FADING = {1, 1, 1, 1, 1, 1, 1, 0.25F, 1, 1, 1, 0.75F, 1, 1, 1, 0};

TEST_F(GltfDialects, CapturesOfGaussiansAreRefused) {
  const auto gltf = write("a.gltf", R"(,"KHR_gaussian_splatting:ROTATION":1)", "{}", {});
  const auto used = write("b.gltf", "", "{}", {}, false, R"(,"extensionsUsed":["KHR_gaussian_splatting"])");
  for (const auto& file : {gltf, used})
    EXPECT_NE(read_error(file).find("found a capture of 3D Gaussians"), std::string::npos);
}

TEST_F(GltfDialects, AttributesOfApplicationsAreKeptAtPointsOrNamed) {
  const std::string added = R"(,"_INTENSITY":3,"_HEAT":3,"_FLOW":0)";
  const std::vector<float> values = {0.25F, 0.5F, 0.75F, 1000.0F};
  const Input points =
      read_input({write("a.gltf", added + R"(},"indices":2,"extras":{"of":1)", "{}", values)}, {});
  for (const char* name : {"intensity", "HEAT"}) {
    const Column* column = find_column(points.objects.at(0).points.columns, name);
    ASSERT_NE(column, nullptr) << name;
    ASSERT_EQ(column->size(), 6U) << "one for each index";
    EXPECT_EQ(column->number(4), 0.75) << name;
    EXPECT_EQ(column->number(5), 1000.0) << name;
  }
  EXPECT_TRUE(has_note(points, "skipped attributes '_FLOW'"));
  EXPECT_TRUE(has_note(read_input({write("b.gltf", added, "{}", values, true)}, keeping_meshes()),
                       "skipped attributes '_FLOW', '_HEAT', '_INTENSITY'"));
}

TEST_F(GltfDialects, OnlyPercentSignsAreDecodedInNames) {
  for (const std::string uri : {"a+b.bin", "a%2Bb%20c.bin", "++.bin"})
    EXPECT_EQ(read_input({write("a.gltf", "", "{}", {}, false, "", uri)}, {}).objects.at(0).points.size(), 4U)
        << uri;
}

TEST_F(GltfDialects, ColoursBeyondOneAreScaled) {
  const auto red = [&](float value) {
    return read_input({write("a.gltf", COLORS, "{}",
                             {value, 0, 0, value, 0, 0, 0, value, 0, 0, 0, value, 0, 0, 0, value})},
                      {})
        .objects.at(0)
        .points.color.at(0)
        .x;
  };
  EXPECT_NEAR(red(128.0F), 128.0F / 255.0F, 1e-6);
  EXPECT_NEAR(red(32768.0F), 32768.0F / 65535.0F, 1e-6);
  EXPECT_EQ(red(1.5F), 1.0F);
  EXPECT_TRUE(has_note(read_input({folder_.path() / "a.gltf"}, {}), "COLOR_0"));
}

TEST_F(GltfDialects, MasksCutByTheFactorAndTheVerticesAlpha) {
  const auto count = [&](const std::string& material, const std::string& attributes) {
    const Input input = read_input({write("a.gltf", attributes, material, FADING)}, {});
    return input.objects.empty() ? 0 : input.objects[0].points.size();
  };
  EXPECT_EQ(count(alpha("MASK", "0.6"), ""), 4U);
  EXPECT_EQ(count(alpha("MASK", "1"), COLORS), 2U);
  EXPECT_EQ(count(alpha("MASK", "0.6"), COLORS), 1U) << "0.75 of 0.6 is below one half";
  EXPECT_EQ(count(alpha("OPAQUE", "0.1"), COLORS), 4U);
  EXPECT_NE(read_error(write("b.gltf", "", alpha("MASK", "0.4"), {})).find("no points"), std::string::npos);
  const Input whole = read_input({write("c.gltf", "", alpha("MASK", "0.6"), {}, true)}, keeping_meshes());
  EXPECT_EQ(whole.objects.at(0).points.size(), 1000U);
  EXPECT_NE(
      read_error(write("d.gltf", "", alpha("MASK", "0.4"), {}, true), keeping_meshes()).find("no points"),
      std::string::npos);
}

TEST_F(GltfDialects, AlphaOfVerticesIsOpacity) {
  const auto opacities = [&](const std::string& factor, bool triangles) {
    const Input input =
        read_input({write("a.gltf", COLORS, alpha("BLEND", factor), FADING, triangles)}, keeping_meshes());
    const Column* column = find_column(input.objects.at(0).points.columns, COLUMN_OPACITY);
    std::vector<double> values;
    for (std::size_t i = 0; column != nullptr && i < column->size(); ++i) values.push_back(column->number(i));
    return values;
  };
  EXPECT_EQ(opacities("1", false), (std::vector<double>{255, 64, 191})) << "nothing is left of the fourth";
  EXPECT_EQ(opacities("0.5", false), (std::vector<double>{128, 32, 96}));
  const std::vector<double> sampled = opacities("1", true);
  ASSERT_GT(sampled.size(), 500U);
  double sum = 0.0;
  for (const double value : sampled) sum += value;
  EXPECT_NEAR(sum / static_cast<double>(sampled.size()) / 255.0, (2.0 / 3.0 + 1.75 / 3.0) / 2.0, 0.03)
      << "the mean of both triangles' corners";
}

TEST_F(GltfDialects, OtherVersionsAndCompressionsSayWhy) {
  const auto one = folder_.write(
      "a.gltf", R"({"asset":{"version":"1.0"},"scenes":{"s":{"nodes":["n"]}},"nodes":{"n":{"meshes":["m"]}},
      "meshes":{"m":{"primitives":[{"attributes":{"POSITION":"p"}}]}}})");
  EXPECT_NE(read_error(one).find("found glTF 1.0, expected 2.0"), std::string::npos);
  for (const std::string when : {"extensionsUsed", "extensionsRequired"}) {
    const auto packed = folder_.write(
        "b.gltf",
        R"({"asset":{"version":"2.0"},"extensionsUsed":["EXT_meshopt_compression"],")" + when +
            R"(":["EXT_meshopt_compression"],"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"buffers":[{"byteLength":0,
                      "extensions":{"EXT_meshopt_compression":{"fallback":true}}}]})");
    EXPECT_NE(read_error(packed).find("compressed with EXT_meshopt_compression"), std::string::npos);
  }
}

}  // namespace
}  // namespace splatray
