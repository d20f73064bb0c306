/// What a scene of each leaf size would hold, against the scene itself.
#include "preprocess/tree/leaf_size.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/scene/splat.h"
#include "preprocess/base/morton.h"
#include "preprocess/build.h"
#include "tests/preprocess/shapes.h"

namespace splatray {
namespace {

void expect_estimated(InputObject object, double references_share, double leaves_share) {
  for (const std::uint32_t leaf_size : {16U, 24U}) {
    BuildParams params;
    params.leaf_size = leaf_size;
    BuildStats stats;
    const Scene scene = build_scene(test::input_of(object), params, 0, stats);
    SplatList splats;
    const auto key = [](const uvec4& words) { return morton_key(glm::uvec3(unpack_splat(words).center)); };
    splats.words.assign(scene.data_pool.begin(), scene.data_pool.end());
    std::sort(splats.words.begin(), splats.words.end(),
              [&](const uvec4& a, const uvec4& b) { return key(a) < key(b); });
    for (const uvec4& words : splats.words) splats.key.push_back(key(words));
    const PoolCounts found = pool_counts(scene), estimated = estimate_counts(splats, leaf_size);
    EXPECT_EQ(estimated.splats, found.splats);
    const auto expect_near = [](std::size_t a, std::size_t b, double share) {
      EXPECT_NEAR(static_cast<double>(a), static_cast<double>(b), share * static_cast<double>(b));
    };
    expect_near(estimated.references, found.references, references_share);
    expect_near(estimated.filled_leaves, found.filled_leaves, leaves_share);
    expect_near(estimated.node_words, found.node_words, leaves_share);
  }
}

TEST(LeafSize, CountsOfSmallScenesAreExact) {
  expect_estimated(test::even_sphere(20000), 0.0, 0.0);
  expect_estimated(test::random_sphere(20000, 1), 0.0, 0.0);
}

TEST(LeafSize, CountsOfLargeScenesAreNear) { expect_estimated(test::random_sphere(100000, 1), 0.01, 0.2); }

}  // namespace
}  // namespace splatray
