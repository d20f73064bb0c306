/// When a device's leaves have copies of their splats.
#include "engine/scene/pool/copies.h"

#include <gtest/gtest.h>

namespace splatray {
namespace {

// Of 1000 splats: a top table of 8^3 entries is 2 bytes for each.
TEST(Copies, TakeAtMost64BytesASplat) {
  EXPECT_TRUE(copies_fit({1000, 3000, 1, 1, 0})) << "48 bytes of copies and 2 of all else";
  EXPECT_TRUE(copies_fit({1000, 3000, 1, 1, FEATURE_COLORS})) << "60 and 2";
  EXPECT_FALSE(copies_fit({1000, 4000, 1, 1, 0})) << "64 and 2";
  EXPECT_FALSE(copies_fit({1000, 3000, 1, 1, FEATURE_COLORS | FEATURE_FIELDS})) << "72 and 2";
  EXPECT_FALSE(copies_fit({1000, 3000, 1001, 1, FEATURE_COLORS})) << "60 and 6";
  EXPECT_FALSE(copies_fit({1000, 3000, 1, 501, FEATURE_COLORS})) << "60 and 6";
}

TEST(Copies, FitToTheLastByte) {
  // 64 000 bytes: 3096 copies of 20 bytes, and 4 (1 + 3 + 512) = 2064 of all else, leave 16.
  EXPECT_TRUE(copies_fit({1000, 3096, 1, 1, FEATURE_COLORS}));
  EXPECT_FALSE(copies_fit({1000, 3097, 1, 1, FEATURE_COLORS}));
  // 72 000 bytes where there are clip lines: 2914 copies of 24 bytes.
  EXPECT_TRUE(copies_fit({1000, 2914, 1, 1, FEATURE_COLORS | FEATURE_CLIPS}));
  EXPECT_FALSE(copies_fit({1000, 2915, 1, 1, FEATURE_COLORS | FEATURE_CLIPS}));
  // 98 000 bytes with two texture words beside them: 2998 copies of 32 bytes.
  EXPECT_TRUE(copies_fit({1000, 2998, 1, 1, FEATURE_COLORS | FEATURE_CLIPS, 2}));
  EXPECT_FALSE(copies_fit({1000, 2999, 1, 1, FEATURE_COLORS | FEATURE_CLIPS, 2}));
}

TEST(Copies, AreCountedFromTheScene) {
  Scene scene;
  scene.data_pool.edit().resize(5);
  scene.reference_pool.edit().resize(9);
  scene.node_pool.edit().resize(17);
  scene.begin_end = {0, 4, 9};
  scene.field_pool.edit().resize(5);
  scene.clip_pool.edit().resize(5);
  const PoolCounts found = pool_counts(scene);
  EXPECT_EQ(found.splats, 5U);
  EXPECT_EQ(found.references, 9U);
  EXPECT_EQ(found.node_words, 17U);
  EXPECT_EQ(found.filled_leaves, 2U);
  EXPECT_EQ(found.pools, FEATURE_FIELDS | FEATURE_CLIPS);
}

}  // namespace
}  // namespace splatray
