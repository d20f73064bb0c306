// Numbers that come from known answers: intervals, quantiles, probes and bounces.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/bench/cases/probes.h"
#include "tests/bench/cases/statistics.h"
#include "tests/bench/truth/bounces.h"

namespace splatray::testing {
namespace {

const RootTransform ROOT{glm::dvec3(-1.25), 2.5 / (1U << LATTICE_BITS)};
constexpr double RADIUS_WORLD = 0.01;
constexpr double DEG = std::numbers::pi / 180.0;

TEST(WilsonShare, IsAsPublished) {
  // Newcombe 1998, "Two-sided confidence intervals for the single proportion", Table I, method 3.
  const struct {
    std::uint64_t successes, trials;
    double low, high;
  } published[] = {
      {81, 263, 0.2553, 0.3662}, {15, 148, 0.0624, 0.1605}, {0, 20, 0.0, 0.1611}, {1, 29, 0.0061, 0.1718}};
  for (const auto& row : published) {
    const Share share = wilson_share(row.successes, row.trials);
    EXPECT_NEAR(share.low, row.low, 5e-5) << row.successes << '/' << row.trials;
    EXPECT_NEAR(share.high, row.high, 5e-5) << row.successes << '/' << row.trials;
  }
  EXPECT_LT(wilson_share(0, 10'000'000).high, 0.4e-6);
}

TEST(Statistics, QuantilesAndAngles) {
  EXPECT_EQ(quantile({5.0, 1.0, 4.0, 2.0, 3.0}, 0.5), 3.0);
  EXPECT_EQ(quantile({5.0, 1.0, 4.0, 2.0, 3.0}, 1.0), 5.0);
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
  EXPECT_DOUBLE_EQ(mean({1.0, 2.0, 6.0}), 3.0);
  EXPECT_DOUBLE_EQ(root_mean_square({3.0, -4.0, 5.0, 0.0}), std::sqrt(12.5));
  EXPECT_NEAR(angle_deg({1.0, 0.0, 0.0}, {std::cos(1e-9), std::sin(1e-9), 0.0}), 1e-9 / DEG, 1e-16);
}

RayHit hit_of(const glm::dvec3& normal, double t_world) {
  RayHit hit{};
  hit.normal = vec3(normal);
  hit.t = static_cast<float>(t_world / ROOT.unit_world);
  return hit;
}

RayHit miss() {
  RayHit hit = hit_of({0.0, 0.0, 0.0}, INFINITY);
  hit.object = NO_OBJECT;
  return hit;
}

/// Exact answers, float32 only in their storage.
Intersect exact(Shape shape) {
  return [shape](std::span<const RayQuery> rays) {
    std::vector<RayHit> hits;
    for (const RayQuery& ray : rays) {
      const glm::dvec3 dir = glm::normalize(glm::dvec3(ray.dir));
      const auto truth = first_hit(shape, ROOT.to_world(glm::dvec3(ray.origin)), dir);
      hits.push_back(truth ? hit_of(truth->normal, truth->t) : miss());
    }
    return hits;
  };
}

class ProbesOf : public ::testing::TestWithParam<Shape> {
 protected:
  Probes probes_{GetParam(), ROOT, 5000, 1};

  /// The errors of exact answers that `change` has changed; it gets their number too.
  template <class Change>
  [[nodiscard]] ProbeErrors errors_after(const Change& change) const {
    return probes_.measure(
        [&](std::span<const RayQuery> rays) {
          std::vector<RayHit> hits = exact(GetParam())(rays);
          for (std::size_t i = 0; i < hits.size(); ++i) change(i, hits[i]);
          return hits;
        },
        RADIUS_WORLD);
  }
};

TEST_P(ProbesOf, ExactAnswersFindNoErrors) {
  const ProbeErrors errors = errors_after([](std::size_t, RayHit&) {});
  EXPECT_EQ(errors.rays, 5000U);
  EXPECT_EQ(errors.holes.value, 0.0);
  EXPECT_LT(errors.normal_rms_deg, 1e-5);
  EXPECT_LT(std::abs(errors.depth_bias_r), 1e-5);
  EXPECT_LT(errors.view_inconsistency_p99_deg, 1e-4);
  // The shape itself turns over 0.01 radii: by 0.01 r / (least radius of curvature cosine 0.2).
  const double curvature = GetParam() == Shape::sphere ? 1.0 / SPHERE_RADIUS : 1.0 / TORUS_TUBE_RADIUS;
  EXPECT_LT(errors.jump_p999_deg, 1.05 * 0.01 * RADIUS_WORLD * curvature / 0.2 / DEG);
  EXPECT_GT(errors.jump_p999_deg, 0.5 * 0.01 * RADIUS_WORLD * curvature / 0.2 / DEG);
}

TEST_P(ProbesOf, DepthsHolesAndTiltsComeBackAsTheyWerePutIn) {
  const float deeper = static_cast<float>(0.25 * RADIUS_WORLD / ROOT.unit_world);
  EXPECT_NEAR(errors_after([&](std::size_t, RayHit& hit) { hit.t += deeper; }).depth_bias_r, 0.25, 1e-4);

  const ProbeErrors holey = errors_after([](std::size_t i, RayHit& hit) {
    if (i % 100 == 0) hit = miss();
    if (i % 100 == 1) hit.t += static_cast<float>(10.0 * RADIUS_WORLD / ROOT.unit_world);
  });
  EXPECT_DOUBLE_EQ(holey.holes.value, 0.02);

  std::mt19937_64 random(1);
  const ProbeErrors tilted = errors_after([&](std::size_t, RayHit& hit) {
    const glm::dvec3 normal(hit.normal);
    hit.normal = std::cos(DEG) * normal + std::sin(DEG) * random_across(normal, random);
  });
  EXPECT_NEAR(tilted.normal_rms_deg, 1.0, 1e-4);
  EXPECT_NEAR(tilted.jump_p999_deg, 2.0, 0.1);  // the shape itself turns too, by up to 0.1
  EXPECT_NEAR(tilted.view_inconsistency_p99_deg, 2.0, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Shapes, ProbesOf, ::testing::Values(Shape::sphere, Shape::torus));

/// Answers inside the sphere of radius 1; every `wrong_every`-th ray, 0 = none, hits its own sheet at once.
Intersect inside_sphere(std::size_t wrong_every) {
  return [wrong_every, count = std::size_t{0}](std::span<const RayQuery> rays) mutable {
    std::vector<RayHit> hits;
    for (const RayQuery& ray : rays) {
      const glm::dvec3 origin = ROOT.to_world(glm::dvec3(ray.origin)), dir(ray.dir);
      const double along = -glm::dot(origin, dir);
      const double half = std::sqrt(std::max(1.0 - glm::dot(origin, origin) + along * along, 0.0));
      RayHit hit = hit_of(-glm::normalize(origin + (along + half) * dir), along + half);
      if (wrong_every > 0 && count++ % wrong_every == 0) hit.t = 0.0F;
      hits.push_back(hit);
    }
    return hits;
  };
}

TEST(BallBounces, CountWhatIsWrong) {
  const Bounces right = ball_bounces(inside_sphere(0), ROOT, RADIUS_WORLD, 500);
  EXPECT_EQ(right.wrong, 0U);
  EXPECT_EQ(right.counted, 500U * MOST_BOUNCES);
  const Bounces wrong = ball_bounces(inside_sphere(10), ROOT, RADIUS_WORLD, 500);
  EXPECT_NEAR(static_cast<double>(wrong.wrong) / static_cast<double>(wrong.counted), 0.1, 0.01);
}

/// Answers between two half-planes that meet in the z axis, `gap` away from it.
Intersect between_mirrors(double wedge_deg, double gap) {
  return [wedge_deg, gap](std::span<const RayQuery> rays) {
    std::vector<RayHit> hits;
    for (const RayQuery& ray : rays) {
      const glm::dvec3 origin = ROOT.to_world(glm::dvec3(ray.origin)), dir(ray.dir);
      RayHit best = miss();
      for (const double angle : {0.5 * wedge_deg * DEG, -0.5 * wedge_deg * DEG}) {
        const glm::dvec3 along(std::cos(angle), std::sin(angle), 0.0);
        const glm::dvec3 normal =
            (angle > 0.0 ? 1.0 : -1.0) * glm::dvec3(std::sin(angle), -std::cos(angle), 0.0);
        const bool own = ray.from_object == 0 && glm::dot(glm::dvec3(ray.from_normal), normal) > 0.999;
        const double t = -glm::dot(origin, normal) / glm::dot(dir, normal);
        const double s = glm::dot(origin + t * dir, along), z = (origin + t * dir).z;
        const bool front = glm::dot(dir, normal) < 0.0 && t > 0.0;
        if (own || !front || s < gap || s > 1.0 || std::abs(z) > 0.5) continue;
        if (const RayHit hit = hit_of(normal, t); hit.t < best.t) best = hit;
      }
      hits.push_back(best);
    }
    return hits;
  };
}

TEST(WedgeBounces, CountWhatIsWrong) {
  for (const double degrees : {90.0, 30.0}) {
    const Bounces right = wedge_bounces(between_mirrors(degrees, 0.0), ROOT, degrees, RADIUS_WORLD, 5000);
    EXPECT_EQ(right.wrong, 0U) << degrees;
    EXPECT_EQ(right.counted, 5000U);
    const Bounces gap = wedge_bounces(between_mirrors(degrees, 0.02), ROOT, degrees, RADIUS_WORLD, 5000);
    EXPECT_GT(gap.wrong, 50U) << degrees;
  }
}

}  // namespace
}  // namespace splatray::testing
