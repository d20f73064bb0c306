// How surfaces scatter light: energy, probabilities, symmetry.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/all_tests.h"
#include "tests/light/bsdf_twin.h"
#include "tests/light/chi_squared.h"

namespace splatray::testing {
namespace {

struct Case {
  std::string name;
  TwinSurface surface;
};

glm::vec3 direction(float cosine, float angle = 0.0F) {
  const float sine = std::sqrt(std::max(1.0F - cosine * cosine, 0.0F));
  return {sine * std::cos(angle), sine * std::sin(angle), cosine};
}

glm::vec3 f0_of(float ior) {
  const float facing = (ior - 1.0F) / (ior + 1.0F);
  return glm::vec3(facing * facing);
}

/// White surfaces of every lobe and every mixture of them, over roughness and index of refraction.
std::vector<Case> white_cases() {
  std::vector<Case> cases = {{"matte", {}}};
  for (const float roughness : {0.0F, 0.02F, 0.05F, 0.1F, 0.25F, 0.5F, 0.75F, 1.0F}) {
    const float alpha = roughness * roughness;
    const std::string rough = " of roughness " + std::to_string(roughness);
    for (const float ior : {1.0F, 1.3F, 1.5F, 2.5F}) {
      const std::string of = rough + ", ior " + std::to_string(ior);
      cases.push_back({"plastic" + of, {.f0 = f0_of(ior), .f90 = 1.0F, .alpha = alpha}});
      if (ior == 1.0F) continue;
      cases.push_back(
          {"glass from outside" + of,
           {.f0 = f0_of(ior), .f90 = 1.0F, .alpha = alpha, .transmission = 1.0F, .eta = 1.0F / ior}});
      cases.push_back({"glass from inside" + of,
                       {.f0 = f0_of(ior), .f90 = 1.0F, .alpha = alpha, .transmission = 1.0F, .eta = ior}});
    }
    cases.push_back({"metal" + rough, {.metallic = 1.0F, .alpha = alpha}});
    cases.push_back(
        {"half metal" + rough, {.metallic = 0.5F, .f0 = f0_of(1.5F), .f90 = 1.0F, .alpha = alpha}});
    cases.push_back(
        {"coated metal" + rough, {.metallic = 1.0F, .alpha = 0.25F, .coat = 1.0F, .coat_alpha = alpha}});
    cases.push_back({"half coated plastic" + rough,
                     {.f0 = f0_of(1.5F), .f90 = 1.0F, .alpha = 0.1F, .coat = 0.5F, .coat_alpha = alpha}});
    cases.push_back(
        {"half glass" + rough,
         {.f0 = f0_of(1.5F), .f90 = 1.0F, .alpha = alpha, .transmission = 0.5F, .eta = 1.0F / 1.5F}});
  }
  return cases;
}

/// The mean weight of samples, and its standard error as if they were independent.
struct Sent {
  glm::dvec3 mean{0.0};
  double error = 0.0;
};
Sent albedo(const TwinSurface& surface, const glm::vec3& to_eye, std::uint32_t samples) {
  glm::dvec3 sum(0.0);
  double squares = 0.0;
  for (std::uint32_t i = 0; i < samples; ++i) {
    const glm::dvec3 weight =
        twin_bsdf_sample(surface, to_eye, glm::vec3(twin_sobol_sample(7, i, 3, 1))).weight;
    sum += weight;
    squares += weight.x * weight.x;
  }
  const glm::dvec3 mean = sum / double(samples);
  return {mean, std::sqrt(std::max(squares / samples - mean.x * mean.x, 0.0) / samples)};
}

TEST(Bsdf, WhiteFurnace) {
  SPLATRAY_NIGHTLY();
  double least = 2.0, most = 0.0;
  for (const Case& tested : white_cases())
    for (const float cosine : {0.02F, 0.05F, 0.2F, 0.5F, 0.8F, 0.99F}) {
      Sent sent = albedo(tested.surface, direction(cosine), 1U << 15U);
      // Lobes with long tails: what seems a miss is looked at again.
      if (std::abs(sent.mean.x - 1.0) > 0.002) sent = albedo(tested.surface, direction(cosine), 1U << 19U);
      const double allowed = 0.002 + sent.error;
      least = std::min(least, sent.mean.x);
      most = std::max(most, sent.mean.x);
      EXPECT_NEAR(sent.mean.x, 1.0, allowed) << tested.name << ", cosine " << cosine;
      EXPECT_LT(sent.error, 0.03) << tested.name << ", cosine " << cosine;
    }
  RecordProperty("least", std::to_string(least));
  RecordProperty("most", std::to_string(most));
}

TEST(Bsdf, ColouredSurfacesSendBackNoMoreThanCame) {
  for (Case tested : white_cases()) {
    tested.surface.base = {0.9F, 0.5F, 0.1F};
    for (const float cosine : {0.05F, 0.5F, 0.99F}) {
      const glm::dvec3 sent = albedo(tested.surface, direction(cosine), 1U << 14U).mean;
      EXPECT_LE(std::max({sent.x, sent.y, sent.z}), 1.003) << tested.name << ", cosine " << cosine;
      EXPECT_GE(sent.x + 1e-3, sent.z) << tested.name;
    }
  }
}

TEST(Bsdf, MatteIsExactlyLambert) {
  const TwinSurface matte{.base = {0.3F, 0.6F, 0.9F}};
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const glm::vec4 random = twin_sobol_sample(1, i, 0, 1);
    const TwinSample chosen = twin_bsdf_sample(matte, direction(0.3F), glm::vec3(random));
    EXPECT_NEAR(glm::length(chosen.weight - matte.base), 0.0, 1e-6);
    EXPECT_NEAR(chosen.pdf, chosen.dir.z / 3.14159265F, 1e-6F);
  }
}

TEST(Bsdf, WeightTimesProbabilityIsValue) {
  for (const Case& tested : white_cases())
    for (std::uint32_t i = 0; i < 200; ++i) {
      const glm::vec3 to_eye = direction(0.02F + 0.97F * twin_sobol_sample(i, 0, 9, 1).x);
      const TwinSample chosen =
          twin_bsdf_sample(tested.surface, to_eye, glm::vec3(twin_sobol_sample(2, i, 0, 1)));
      if (chosen.delta || chosen.weight.x == 0.0F) continue;
      const TwinValue value = twin_bsdf_value(tested.surface, to_eye, chosen.dir);
      EXPECT_NEAR(value.pdf, chosen.pdf, 1e-4F * chosen.pdf) << tested.name;
      EXPECT_NEAR(chosen.weight.x * chosen.pdf, value.value.x, 1e-4F * value.value.x) << tested.name;
      EXPECT_EQ(chosen.transmitted, chosen.dir.z < 0.0F) << tested.name;
      EXPECT_NEAR(glm::length(chosen.dir), 1.0F, 1e-5F);
    }
}

TEST(Bsdf, NothingIsNegativeOrNotFinite) {
  for (const Case& tested : white_cases())
    for (std::uint32_t i = 0; i < 400; ++i) {
      const glm::vec4 random = twin_sobol_sample(3, i, 0, 1);
      const glm::vec3 to_eye = direction(i % 4 == 0 ? 1e-6F : random.x);
      const glm::vec3 to_light = direction(i % 5 == 0 ? 1e-6F : 2.0F * random.y - 1.0F, 6.28F * random.z);
      const TwinValue value = twin_bsdf_value(tested.surface, to_eye, to_light);
      EXPECT_TRUE(value.value.x >= 0.0F && value.value.x < 1e30F) << tested.name << ": " << value.value.x;
      EXPECT_TRUE(value.pdf >= 0.0F && value.pdf < 1e30F) << tested.name << ": " << value.pdf;
      const TwinSample chosen = twin_bsdf_sample(tested.surface, to_eye, glm::vec3(random));
      EXPECT_TRUE(chosen.weight.x >= 0.0F && chosen.weight.x < 1e30F)
          << tested.name << ": " << chosen.weight.x;
    }
}

TEST(Bsdf, LayersAndMetalsAreReciprocal) {
  for (const Case& tested : white_cases()) {
    if (tested.surface.coat > 0.0F || tested.surface.transmission > 0.0F) continue;
    TwinSurface surface = tested.surface;
    surface.base = {0.8F, 0.5F, 0.2F};
    for (std::uint32_t i = 0; i < 200; ++i) {
      const glm::vec4 random = twin_sobol_sample(5, i, 0, 1);
      const glm::vec3 a = direction(0.02F + 0.97F * random.x, 0.0F),
                      b = direction(0.02F + 0.97F * random.y, 6.28F * random.z);
      const glm::vec3 there = twin_bsdf_value(surface, a, b).value / b.z;
      const glm::vec3 back = twin_bsdf_value(surface, b, a).value / a.z;
      for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(there[channel], back[channel], 1e-5F * std::max(there[channel], 1e-3F)) << tested.name;
    }
  }
}

/// Directions of one surface: what its samples do, against what their probability says.
SampledDirections directions_of(const TwinSurface& surface, const glm::vec3& to_eye) {
  return {[=](const glm::vec3& random, glm::vec3& dir) {
            const TwinSample chosen = twin_bsdf_sample(surface, to_eye, random);
            dir = chosen.dir;
            return !chosen.delta && chosen.weight.x > 0.0F;
          },
          [=](const glm::vec3& dir) { return double(twin_bsdf_value(surface, to_eye, dir).pdf); }};
}

std::vector<Case> chi_squared_cases() {
  std::vector<Case> cases;
  for (const Case& tested : white_cases()) {
    const bool rough =
        tested.surface.alpha >= 0.05F && (tested.surface.coat == 0.0F || tested.surface.coat_alpha >= 0.05F);
    if (rough) cases.push_back(tested);
  }
  return cases;
}

TEST(Bsdf, DirectionsComeAsOftenAsTheirDensitySays) {
  SPLATRAY_NIGHTLY();
  const std::vector<Case> cases = chi_squared_cases();
  const double significance = sidak(0.01, cases.size());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const float cosine = i % 2 == 0 ? 0.15F : 0.7F;
    const double p = chi_squared_p(directions_of(cases[i].surface, direction(cosine, 0.4F)), 1);
    EXPECT_GT(p, significance) << cases[i].name << ", cosine " << cosine;
  }
}

TEST(Bsdf, ChiSquaredSeesAWrongProbability) {
  const TwinSurface metal{.metallic = 1.0F, .alpha = 0.25F};
  const TwinSurface rougher{.metallic = 1.0F, .alpha = 0.27F};
  SampledDirections wrong = directions_of(metal, direction(0.7F));
  wrong.pdf = directions_of(rougher, direction(0.7F)).pdf;
  EXPECT_LT(chi_squared_p(wrong, 1), 1e-9);
}

}  // namespace
}  // namespace splatray::testing
