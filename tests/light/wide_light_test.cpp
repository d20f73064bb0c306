// The host shades many vertices at once by vectors (engine/cpu/wide/wide_light.h): all processors must get the same bits, and what the
// shaders' text gets for one vertex after the other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <random>
#include <vector>

#include "data/shapes.h"
#include "engine/scene/sky/sky_table.h"
#include "engine/table/albedo_table.h"
#include "tests/light/lit.h"
#include "tests/light/vertex_twin.h"

namespace splatray::testing {
namespace {

/// AVX-512, AVX2, SSE, and any processor.
constexpr std::uint32_t VECTOR_BITS[] = {512, 256, 128, 32};

/// A dispatch under a sky with a sun, over surfaces of several roughnesses, matte ones among them.
class Dispatch {
 public:
  explicit Dispatch(bool layered) {
    Environment sky{64, 32, {}, vec3(0.0F)};
    for (std::uint32_t i = 0; i < 64 * 32; ++i)
      sky.texels.push_back(i == 500 ? vec3(900.0F, 800.0F, 700.0F)
                                    : vec3(0.2F + 0.01F * float(i % 64), 0.5F, 1.0F));
    for (const vec3& texel : sky.texels) texels_.emplace_back(texel, 1.0F);
    const SkyTable table = sky_table(sky);
    tables_.resize(ALBEDO_TABLE.size());
    std::memcpy(tables_.data(), ALBEDO_TABLE.data(), ALBEDO_TABLE.size_bytes());
    tables_.insert(tables_.end(), table.words.begin(), table.words.end());
    for (const float roughness : {0.02F, 0.3F, 0.47F, 1.0F}) {
      Material& material = materials_.emplace_back(grey(0.7F));
      material.base = vec3(0.8F, 0.5F, 0.3F);
      material.roughness = roughness;
      material.specular = roughness;
      material.specular_color = vec3(1.0F, 0.9F, 0.8F);
      material.layer_ior = 1.5F;
    }
    work.constants[SPEC_FEATURES] =
        FEATURE_SKY | FEATURE_ENVIRONMENT | FEATURE_DIFFUSE | (layered ? FEATURE_SPECULAR : 0);
    work.constants[SPEC_LOOK] = LOOK_LIT;
    FrameParams& frame = work.frame;
    frame.environment = vec3(1.5F, 1.0F, 0.5F);
    frame.environment_up = glm::normalize(vec3(0.2F, 1.0F, -0.1F));
    frame.environment_right = glm::normalize(glm::cross(frame.environment_up, vec3(0.3F, 0.1F, 1.0F)));
    frame.sky_width = table.width, frame.sky_height = table.height;
    frame.seed = 7;
    const auto bind = [&](std::uint32_t binding, auto& values) {
      work.bound[binding] = reinterpret_cast<std::byte*>(values.data());
    };
    bind(BIND_ENVIRONMENT, texels_), bind(BIND_LIGHT_TABLES, tables_), bind(BIND_MATERIALS, materials_);
    work.last_material = static_cast<std::uint32_t>(materials_.size() - 1);
    work.environment_width = sky.width, work.environment_height = sky.height;
    light = wide_light_of(work);
  }

  [[nodiscard]] WideVertices vertices(std::uint32_t count) const {
    std::mt19937 random(count);
    std::normal_distribution<float> normal;
    std::uniform_real_distribution<float> part;
    const auto any_dir = [&] { return glm::normalize(vec3(normal(random), normal(random), normal(random))); };
    WideVertices vertices{};
    vertices.count = count;
    for (std::uint32_t i = 0; i < count; ++i) {
      const vec3 up = any_dir(), other = any_dir();
      const vec3 dir = glm::dot(up, other) > 0.0F ? -other : other;
      vertices.pixel[i] = random() % 1000000, vertices.sample[i] = random() % 64,
      vertices.bounce[i] = random() % 9;
      vertices.object[i] = random() % 4;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        vertices.normal[axis][i] = up[int(axis)], vertices.dir[axis][i] = dir[int(axis)];
        vertices.base[axis][i] = materials_[0].base[int(axis)] * part(random);
      }
    }
    return vertices;
  }

  KernelWork work;
  WideLight light{};

 private:
  std::vector<vec4> texels_;
  std::vector<std::uint32_t> tables_;
  std::vector<Material> materials_;
};

WideVertices shaded(const Dispatch& dispatch, WideVertices vertices, std::uint32_t bits) {
  wide_functions(bits).sample(dispatch.light, vertices);
  wide_functions(bits).scatter(dispatch.light, vertices);
  return vertices;
}

vec3 vector_of(const VectorsOfPlaces& values, std::uint32_t i) {
  return {values[0][i], values[1][i], values[2][i]};
}

/// How far numbers are apart, over the larger one of the truth and `scale`.
double off(double found, double truth, double scale = 0.0) {
  return std::abs(found - truth) / std::max(std::abs(truth), scale + 1e-30);
}
double off(const vec3& found, const vec3& truth) {
  return off(glm::distance(found, truth), 0.0, glm::length(truth));
}

class WideLightTest : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Layers, WideLightTest, ::testing::Bool());

/// Of vertices, those of whose numbers some have other bits.
std::uint32_t different(const WideVertices& a, const WideVertices& b) {
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < a.count; ++i) {
    bool same = true;
    for (const auto member : {&WideVertices::light_random, &WideVertices::light_dir, &WideVertices::radiance,
                              &WideVertices::value, &WideVertices::next_dir, &WideVertices::weight})
      same = same && vector_of(a.*member, i) == vector_of(b.*member, i);
    for (const auto member : {&WideVertices::light_pdf, &WideVertices::value_pdf, &WideVertices::next_pdf,
                              &WideVertices::next_random})
      same = same && (a.*member)[i] == (b.*member)[i];
    count += same ? 0 : 1;
  }
  return count;
}

/// Thousands of vertices, as a fused product changes the last bit of few.
TEST_P(WideLightTest, VerticesHaveTheSameBitsOnAllProcessors) {
  const Dispatch dispatch(GetParam());
  for (std::uint32_t count = 1; count <= WIDE_PLACES; count += 5) {
    const WideVertices vertices = dispatch.vertices(count);
    const WideVertices first = shaded(dispatch, vertices, VECTOR_BITS[0]);
    for (const std::uint32_t bits : VECTOR_BITS)
      EXPECT_EQ(different(shaded(dispatch, vertices, bits), first), 0U) << bits << " bits, " << count;
  }
}

/// A vertex of a thousand lies where a choice turns on last bits.
TEST_P(WideLightTest, VerticesAreTheTexts) {
  const Dispatch dispatch(GetParam());
  std::size_t elsewhere = 0, looked_at = 0;
  for (std::uint32_t count = 200; count < 240; ++count) {
    const WideVertices found = shaded(dispatch, dispatch.vertices(count), 512);
    for (std::uint32_t i = 0; i < count; ++i) {
      const TwinVertex twin = twin_vertex(dispatch.work, found, i);
      EXPECT_EQ(vector_of(found.light_random, i), twin.light_random);
      EXPECT_EQ(found.next_random[i], twin.next_random);
      EXPECT_LT(glm::distance(vector_of(found.light_dir, i), twin.light_dir), 1e-6);
      EXPECT_LT(off(vector_of(found.radiance, i), twin.radiance), 1e-4);
      EXPECT_LT(off(found.light_pdf[i], twin.light_pdf), 1e-5);
      const bool same = glm::distance(vector_of(found.next_dir, i), twin.next_dir) < 1e-4 &&
                        off(vector_of(found.value, i), twin.value) < 1e-4 &&
                        off(found.value_pdf[i], twin.value_pdf, 1e-3) < 1e-4 &&
                        off(vector_of(found.weight, i), twin.weight) < 1e-4 &&
                        off(found.next_pdf[i], twin.next_pdf, 1e-3) < 1e-3;
      elsewhere += same ? 0 : 1;
      ++looked_at;
    }
  }
  EXPECT_LE(elsewhere, looked_at / 1000);
}

WideEscapes escaped(const Dispatch& dispatch, const WideVertices& vertices, std::uint32_t bits) {
  WideEscapes escapes{};
  escapes.count = vertices.count, escapes.dir = vertices.dir;
  wide_functions(bits).escape(dispatch.light, escapes);
  return escapes;
}

TEST(WideEscapesTest, AreTheTextsAndTheSameOnAllProcessors) {
  const Dispatch dispatch(false);
  for (std::uint32_t count = 1; count <= WIDE_PLACES; count += 5) {
    const WideVertices vertices = dispatch.vertices(count);
    const WideEscapes first = escaped(dispatch, vertices, VECTOR_BITS[0]);
    for (std::uint32_t i = 0; i < count; ++i) {
      const TwinEscape twin = twin_escape(dispatch.work, vector_of(vertices.dir, i));
      EXPECT_LT(off(vector_of(first.radiance, i), twin.radiance), 1e-4);
      EXPECT_LT(off(first.pdf[i], twin.pdf), 1e-4);
    }
    for (const std::uint32_t bits : VECTOR_BITS) {
      const WideEscapes other = escaped(dispatch, vertices, bits);
      for (std::uint32_t i = 0; i < count; ++i)
        EXPECT_TRUE(vector_of(other.radiance, i) == vector_of(first.radiance, i) &&
                    other.pdf[i] == first.pdf[i])
            << bits << " bits, ray " << i;
    }
  }
}

/// A picture of a plain floor, a metal ball and a glass one under a sky and a lamp with a size: vectors and the text take turns.
TEST(WavePictures, AreTheSameHoweverTheyAreMade) {
  const SurfacePatch patch = rectangle_surface("floor", {-2.0, 0.0, 2.0}, {4.0, 0.0, 0.0}, {0.0, 0.0, -4.0});
  Scene scene = scene_of({{patch.make({.count = 4000, .even = true}), grey(0.7F)},
                          {ball_at({-0.6, 0.5, 0.0}, 0.5, 2000), grey(0.8F)},
                          {ball_at({0.6, 0.5, 0.0}, 0.5, 2000), grey(1.0F)}});
  scene.materials[0].specular = 1.0F, scene.materials[0].roughness = 0.4F,
  scene.materials[0].layer_ior = 1.5F;
  scene.materials[1].metallic = 1.0F, scene.materials[1].roughness = 0.3F;
  scene.materials[2].flags = MATERIAL_DIELECTRIC, scene.materials[2].transmission = 1.0F,
  scene.materials[2].ior = 1.5F;
  SceneLight lamp{LIGHT_POINT, {0.0, 3.0, 1.0}, vec3(9.0F)};
  lamp.size = 0.2;
  const Camera camera{dvec3(0.0, 1.5, 4.0), dvec3(0.0, 0.3, 0.0), dvec3(0.0, 1.0, 0.0), 40.0, 0.001};
  const auto picture = [&](const Device& device, std::uint32_t bits, unsigned threads) {
    ShownTracer tracer(device, {.threads = threads, .vector_bits = bits});
    tracer.upload(scene);
    tracer.set_environment(studio_environment());
    tracer.look.lights = {lamp};
    Settings settings = lit(6);
    settings.counters = false;
    return tracer.render({camera, 45, 30}, settings).rgba;
  };
  const auto host = open_device("cpu");
  const std::vector<vec4> first = picture(*host, 512, 1);
  for (const std::uint32_t bits : VECTOR_BITS) EXPECT_EQ(picture(*host, bits, 2), first) << bits;
  const std::vector<vec4> text = picture(VulkanDevice(), 512, 1);
  std::size_t otherwise = 0;  // a path's decision turned on last bits
  double sum = 0.0, change = 0.0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const vec3 apart = glm::abs(vec3(text[i]) - vec3(first[i]));
    if (std::max({apart.x, apart.y, apart.z}) > 1.0F / 255.0F) {
      ++otherwise;
      continue;
    }
    sum += double(text[i].x), change += double(first[i].x) - double(text[i].x);
  }
  EXPECT_LT(otherwise, text.size() / 100);
  EXPECT_GT(sum, 0.1 * double(text.size()));
  EXPECT_LT(std::abs(change), 1e-4 * sum);
}

}  // namespace
}  // namespace splatray::testing
