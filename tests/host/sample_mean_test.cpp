#include "engine/image/sample_mean.h"

#include <gtest/gtest.h>

#include <random>

namespace splatray {
namespace {

/// Means of a pixel's blocks, of very different sizes.
std::vector<vec4> random_blocks(std::size_t count) {
  std::mt19937 random(7);
  std::lognormal_distribution<float> values(0.0F, 4.0F);
  std::vector<vec4> blocks(count);
  for (vec4& block : blocks)
    for (int c = 0; c < 4; ++c) block[c] = values(random);
  return blocks;
}

/// The mean of blocks [begin, end), the last one of `last` samples.
vec4 mean_of(const std::vector<vec4>& blocks, std::size_t begin, std::size_t end, std::uint32_t last) {
  SampleMean before;
  for (std::size_t i = begin; i + 1 < end; ++i) before.add({blocks[i]}, BLOCK_SAMPLES);
  vec4 all = blocks[end - 1];
  before.join({&all, 1}, 0, last);
  return all;
}

TEST(SampleMean, RangesHaveRoom) {
  EXPECT_EQ(whole_range(1), 64U);
  EXPECT_EQ(whole_range(64), 64U);
  EXPECT_EQ(whole_range(65), 128U);
  EXPECT_EQ(whole_range(129), 256U);
  EXPECT_EQ(whole_range(65536), 65536U);
}

TEST(SampleMean, IsTheMean) {
  const std::vector<vec4> blocks = random_blocks(11);
  glm::dvec4 sum(0.0);
  for (std::size_t i = 0; i < 10; ++i) sum += 64.0 * glm::dvec4(blocks[i]);
  sum += 5.0 * glm::dvec4(blocks[10]);
  const vec4 mean = mean_of(blocks, 0, 11, 5);
  for (int c = 0; c < 4; ++c) EXPECT_NEAR(mean[c] / (sum[c] / 645.0), 1.0, 3e-7);
}

TEST(SampleMean, HasTheSameBitsHoweverItsRangesAreCut) {
  const std::vector<vec4> blocks = random_blocks(13);
  const vec4 all = mean_of(blocks, 0, 13, 33);
  for (const std::size_t length : {1U, 2U, 4U, 8U}) {
    SampleMean before;
    std::size_t begin = 0;
    for (; begin + length < 13; begin += length)
      before.add({mean_of(blocks, begin, begin + length, BLOCK_SAMPLES)},
                 static_cast<std::uint32_t>(length) * BLOCK_SAMPLES);
    EXPECT_EQ(before.samples(), begin * BLOCK_SAMPLES);
    vec4 joined = mean_of(blocks, begin, 13, 33);
    before.join({&joined, 1}, 0, static_cast<std::uint32_t>(12 - begin) * BLOCK_SAMPLES + 33);
    EXPECT_EQ(joined, all) << length;
  }
  EXPECT_NE(mean_of(blocks, 0, 13, 34), all);
}

}  // namespace
}  // namespace splatray
