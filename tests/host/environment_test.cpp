#include "engine/scene/environment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace splatray {
namespace {

using std::numbers::pi;

/// Radiance / albedo of a diffuse surface of normal n, by the polynomials environment.h names.
glm::dvec3 evaluate(const std::array<glm::vec3, 9>& c, const glm::dvec3& n) {
  const double p[9] = {
      1, n.y, n.z, n.x, n.x * n.y, n.y * n.z, 3 * n.z * n.z - 1, n.x * n.z, n.x * n.x - n.y * n.y};
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < 9; ++i) sum += glm::dvec3(c[i]) * p[i];
  return sum;
}

Environment painted(std::uint32_t width, glm::vec3 (*radiance)(const glm::vec3& dir)) {
  Environment environment{width, width / 2, {}, glm::vec3(0.0F)};
  for (std::uint32_t row = 0; row < environment.height; ++row)
    for (std::uint32_t column = 0; column < width; ++column)
      environment.texels.push_back(
          radiance(environment_direction((column + 0.5) / width, (row + 0.5) / environment.height)));
  return environment;
}

const glm::dvec3 NORMALS[] = {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}, glm::normalize(glm::dvec3(1, -2, 3))};

TEST(EnvironmentDirection, NamedDirections) {
  const auto expect_near = [](const glm::vec3& found, const glm::vec3& expected) {
    EXPECT_LT(glm::length(found - expected), 1e-6F);
  };
  expect_near(environment_direction(0.5, 0.5), {0, 0, -1});
  expect_near(environment_direction(0.75, 0.5), {1, 0, 0});
  expect_near(environment_direction(0.25, 0.5), {-1, 0, 0});
  expect_near(environment_direction(0.3, 0.0), {0, 1, 0});
  expect_near(environment_direction(0.3, 1.0), {0, -1, 0});
}

TEST(EnvironmentDirection, RoundTrip) {
  for (double row = 0.05; row < 1.0; row += 0.1)
    for (double column = 0.05; column < 1.0; column += 0.1) {
      const glm::dvec3 dir(environment_direction(column, row));
      EXPECT_NEAR(std::acos(dir.y) / pi, row, 1e-6);
      EXPECT_NEAR(std::atan2(dir.x, -dir.z) / (2.0 * pi) + 0.5, column, 1e-6);
    }
}

TEST(IrradianceCoefficients, ConstantStaysConstant) {
  const Environment uniform{0, 0, {}, glm::vec3(0.25F, 0.5F, 1.0F)};
  const Environment texels = painted(128, [](const glm::vec3&) { return glm::vec3(0.25F, 0.5F, 1.0F); });
  for (const glm::dvec3& n : NORMALS) {
    EXPECT_LT(glm::length(evaluate(irradiance_coefficients(uniform), n) - glm::dvec3(uniform.constant)),
              1e-7);
    EXPECT_LT(glm::length(evaluate(irradiance_coefficients(texels), n) - glm::dvec3(uniform.constant)), 1e-3);
  }
}

/// Radiance a + b (d.k) gives the irradiance pi (a + 2/3 b (n.k)); a (d.k)^2 gives pi a (1/4 (n.k)^2 + 1/4).
TEST(IrradianceCoefficients, LinearAndQuadraticAreExact) {
  const auto linear = irradiance_coefficients(
      painted(256, [](const glm::vec3& d) { return glm::vec3(1.0F + d.x, 1.0F + d.y, 1.0F + d.z); }));
  const auto quadratic = irradiance_coefficients(
      painted(256, [](const glm::vec3& d) { return glm::vec3(d.x * d.x, d.y * d.y, d.z * d.z); }));
  for (const glm::dvec3& n : NORMALS) {
    EXPECT_LT(glm::length(evaluate(linear, n) - (1.0 + 2.0 / 3.0 * n)), 1e-3);
    EXPECT_LT(glm::length(evaluate(quadratic, n) - 0.25 * (n * n + 1.0)), 1e-3);
  }
}

TEST(StudioEnvironment, BrightAboveDarkBelowLampsInRange) {
  const Environment studio = studio_environment();
  ASSERT_EQ(studio.texels.size(), 128U * 64U);
  float most = 0.0F;
  for (const glm::vec3& texel : studio.texels) {
    EXPECT_GE(texel.r, 0.1F);
    most = std::max(most, texel.r);
  }
  EXPECT_GT(most, 3.5F);
  EXPECT_LT(most, 6.0F);
  EXPECT_GT(studio.texels[64].g, 1.8F * studio.texels[63 * 128 + 64].g);
}

}  // namespace
}  // namespace splatray
