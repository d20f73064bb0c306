/// The 128-bit splat and the 32-bit colour: what is packed comes back within the steps shaders/layout.h
/// states.
#include "engine/scene/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/scene/splat.h"

namespace splatray {
namespace {

constexpr double LATTICE_MAX = (1U << LATTICE_BITS) - 1;

Splat random_splat(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::normal_distribution<double> gauss;
  Splat splat{};
  splat.center = glm::round(glm::dvec3(unit(random), unit(random), unit(random)) * LATTICE_MAX);
  splat.normal = glm::normalize(glm::dvec3(gauss(random), gauss(random), gauss(random)));
  splat.radius_squared = std::exp2(1.0 + 41.0 * unit(random));
  splat.object = static_cast<std::uint32_t>(random() & OBJECT_MASK);
  return splat;
}

TEST(Splat, RoundTripStaysWithinTheStatedSteps) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 100000; ++i) {
    const Splat splat = random_splat(random);
    const Splat decoded = unpack_splat(pack_splat(splat));
    EXPECT_EQ(decoded.center, splat.center);
    EXPECT_EQ(decoded.object, splat.object);
    EXPECT_LT(glm::length(decoded.normal - splat.normal), 5.0e-5);
    EXPECT_GE(decoded.radius_squared, splat.radius_squared);
    EXPECT_LE(decoded.radius_squared, splat.radius_squared * (1.0 + 1.0 / 511.0));
  }
}

TEST(Splat, PackingWhatWasUnpackedChangesNothing) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 20000; ++i) {
    const uvec4 words = pack_splat(random_splat(random));
    EXPECT_EQ(pack_splat(unpack_splat(words)), words);
  }
}

TEST(NormalField, RoundTripStaysWithinTheStatedSteps) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> slope(-0.5, 0.5);
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 normal = random_splat(random).normal;
    const TangentFrame frame(normal);
    EXPECT_NEAR(glm::dot(glm::cross(frame.u, frame.v), normal), 1.0, 1e-12);
    const double uu = slope(random), uv = slope(random) * 0.01, vv = slope(random);
    const glm::dmat3 matrix =
        uu * glm::outerProduct(frame.u, frame.u) + vv * glm::outerProduct(frame.v, frame.v) +
        uv * (glm::outerProduct(frame.u, frame.v) + glm::outerProduct(frame.v, frame.u));
    const glm::dmat3 decoded = unpack_field(pack_field(matrix, normal), normal);
    EXPECT_NEAR(glm::dot(frame.u, decoded * frame.u), uu, 0.001);
    EXPECT_NEAR(glm::dot(frame.u, decoded * frame.v), uv, 0.0002) << "small slopes have small steps";
    EXPECT_NEAR(glm::dot(frame.v, decoded * frame.v), vv, 0.001);
    EXPECT_EQ(pack_field(decoded, normal), pack_field(matrix, normal));
  }
}

TEST(NormalField, FlatAndSteepAreAsTheLayoutSays) {
  const glm::dvec3 normal(0.0, 0.0, -1.0);
  EXPECT_EQ(pack_field(glm::dmat3(0.0), normal), FIELD_FLAT);
  EXPECT_EQ(unpack_field(FIELD_FLAT, normal), glm::dmat3(0.0));
  EXPECT_EQ(pack_field(glm::dmat3(7.0), normal), 1023U | 512U << 10 | 1023U << 20) << "clamped to 1/2";
  EXPECT_EQ(pack_field(glm::dmat3(-7.0), normal), 1U | 512U << 10 | 1U << 20);
}

TEST(NormalField, ConstantTermsStayWithinTheirStep) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> component(-1.0, 1.0);
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 normal = random_splat(random).normal;
    const TangentFrame frame(normal);
    const glm::dvec3 lean = component(random) * frame.u + component(random) * frame.v;
    const std::uint32_t packed = pack_lean(lean + 0.3 * normal, normal);
    EXPECT_LT(glm::length(unpack_lean(packed, normal) - lean), 0.8 / LEAN_SCALE);
    EXPECT_EQ(unpack_field(packed, normal), glm::dmat3(0.0));
    EXPECT_EQ(pack_lean(unpack_lean(packed, normal), normal), packed);
  }
  const glm::dvec3 up(0.0, 0.0, 1.0);
  EXPECT_EQ(pack_lean(glm::dvec3(0.0), up), FIELD_LEANS | LEAN_SCALE << 15 | LEAN_SCALE);
  EXPECT_EQ(pack_lean({7.0, -7.0, 0.0}, up), FIELD_LEANS | 2 * LEAN_SCALE) << "clamped to 1";
  EXPECT_EQ(unpack_lean(FIELD_FLAT, up), glm::dvec3(0.0));
}

TEST(Splat, WordsAreAsTheLayoutDrawsThem) {
  const Splat splat{{1.0, 3.0 * 1024.0 + 5.0, 7.0}, {0.0, 0.0, 1.0}, 2.0, 9};
  EXPECT_EQ(pack_splat(splat), uvec4(1U << 11 | 3U, 5U << 22 | 7U, 32767U << 16 | 32767U, 9U));
  const Splat four{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 4.0, 0};
  EXPECT_EQ(pack_splat(four), uvec4(0U, 0U, 32767U << 16 | 65534U, 0x200U << 16));
}

TEST(Splat, ExtremesSurvive) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      Splat splat{glm::dvec3(LATTICE_MAX), glm::dvec3(0.0), 0x1p44, OBJECT_MASK};
      splat.normal[axis] = sign;
      const Splat decoded = unpack_splat(pack_splat(splat));
      EXPECT_EQ(decoded.normal, splat.normal);
      EXPECT_EQ(decoded.center, splat.center);
      EXPECT_EQ(decoded.radius_squared, 0x1p44);
      EXPECT_EQ(decoded.object, OBJECT_MASK);
    }
  }
}

TEST(Splat, NoRadiusIsBelowTheLeastOne) {
  const Splat splat{glm::dvec3(0.0), {0.0, 1.0, 0.0}, 0.0, 0};
  EXPECT_EQ(unpack_splat(pack_splat(splat)).radius_squared, 2.0);
}

TEST(Color, RoundTripOfEveryByte) {
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    const std::uint32_t color = byte | (255U - byte) << 8 | 77U << 16 | 255U << 24;
    EXPECT_EQ(pack_color(unpack_color(color)), color);
  }
}

TEST(Color, OutOfRangeIsClamped) {
  EXPECT_EQ(pack_color({-1.0F, 2.0F, NAN}), 0xFF00FF00U);
  EXPECT_EQ(unpack_color(0xFFFFFFFFU), glm::vec3(1.0F));
}

}  // namespace
}  // namespace splatray
