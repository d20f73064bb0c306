#include "engine/gpu/pools.h"

#include <array>
#include <string>

#include "engine/base/error.h"
#include "engine/scene/splat.h"
#include "tests/all_tests.h"
#include "tests/gpu/shown_tracer.h"
#include "tests/gpu/small_scene.h"

namespace splatray {
namespace {

// 256 elements in a page.
constexpr DeviceLimits LIMITS{.storage_bytes = 8000, .allocation_bytes = 20000, .storage_buffers = 17};

/// Sizes of some pools by binding, the others empty.
PoolBytes pool_bytes(std::initializer_list<std::pair<std::uint32_t, std::uint64_t>> sizes) {
  PoolBytes bytes;
  for (const auto& [binding, size] : sizes) bytes.at(binding) = size;
  return bytes;
}

std::string refusal(const PoolBytes& bytes) {
  try {
    (void)choose_paging(bytes, LIMITS);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::out_of_memory);
    return error.what();
  }
  return "";
}

using Pages = std::array<std::uint32_t, POOLS>;

TEST(Paging, TakesOneBufferWhereThatHoldsAll) {
  const PoolBytes bytes =
      pool_bytes({{BIND_NODE_POOL, 8000}, {BIND_BEGIN_END, 4000}, {BIND_DATA_POOL, 8000}});
  const Paging paging = choose_paging(bytes, LIMITS);
  EXPECT_EQ(paging.pages, (Pages{1, 1, 1, 1, 1, 1, 1, 1, 1, 1}));
  EXPECT_FALSE(paging.paged());
  EXPECT_EQ(paging.page_shift, 0U) << "the same pipeline for all";
}

TEST(Paging, PagesWhatOneBufferDoesNotHold) {
  const Paging paging = choose_paging(
      pool_bytes({{BIND_NODE_POOL, 4004}, {BIND_DATA_POOL, 16 * 1537}, {BIND_COLOR_POOL, 4 * 1000}}), LIMITS);
  EXPECT_EQ(paging.pages, (Pages{1, 1, 1, 1, 7, 1, 1, 1, 1, 1}));
  EXPECT_TRUE(paging.paged());
  EXPECT_EQ(paging.page_shift, 8U);
}

TEST(Paging, RefusalNamesPoolSizeAndLimit) {
  const std::string sentence = refusal(pool_bytes({{BIND_NODE_POOL, 4}, {BIND_DATA_POOL, 30 << 20}}));
  EXPECT_NE(sentence.find("data pool"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("30.0 MiB"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("8 of its largest buffers"), std::string::npos) << sentence;
}

TEST(Paging, EndsAtTheMostPagesOfAPool) {
  EXPECT_EQ(choose_paging(pool_bytes({{BIND_DATA_POOL, 16 * 2048}}), LIMITS).pages[4], PAGES_MOST);
  EXPECT_NE(refusal(pool_bytes({{BIND_DATA_POOL, 16 * 2049}})), "");
}

TEST(Paging, EndsAtTheMostBuffersOfAProgram) {
  PoolBytes bytes = pool_bytes({{BIND_DATA_POOL, 16 * 1537}});
  EXPECT_EQ(choose_paging(bytes, LIMITS).pages, (Pages{1, 1, 1, 1, 7, 1, 1, 1, 1, 1}));
  bytes.at(BIND_FIELD_POOL) = 8004;
  const std::string sentence = refusal(bytes);
  EXPECT_NE(sentence.find("23 buffers"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("room for 17"), std::string::npos) << sentence;
}

/// Whether `automatic` takes references for a scene of `splats` splats with `references` references, where LIMITS hold.
bool automatic_references(std::size_t splats, std::size_t references) {
  return choose_references({splats, references, 1, 1}, LIMITS, DataPool::automatic);
}

TEST(DataPool, HasCopiesWhereTheyFit) {
  EXPECT_FALSE(automatic_references(200, 500));
  EXPECT_TRUE(automatic_references(100, 500)) << "80 bytes a splat";
}

TEST(DataPool, HasReferencesWhereOneBufferDoesNotHoldCopies) {
  EXPECT_FALSE(automatic_references(400, 500));
  EXPECT_TRUE(automatic_references(400, 501)) << "8016 bytes";
}

TEST(DataPool, CanBeForced) {
  const PoolCounts counts{200, 1000, 1, 1};
  EXPECT_FALSE(choose_references(counts, LIMITS, DataPool::copies));
  EXPECT_TRUE(choose_references({400, 500, 1, 1}, LIMITS, DataPool::references));
}

using PoolUpload = DeviceTest;

TEST_F(PoolUpload, AllDataPoolsGiveTheSamePicture) {
  SPLATRAY_NIGHTLY();
  Scene scene = disc_scene(3);
  scene.reference_pool = {2, 0, 1};
  scene.color_pool = {pack_color({1.0F, 0.0F, 0.0F}), pack_color({0.0F, 1.0F, 0.0F}),
                      pack_color({0.0F, 0.0F, 1.0F})};
  const auto picture = [&](const TracerOptions& options, std::uint32_t pages) {
    ShownTracer tracer(device, options);
    tracer.upload(scene);
    EXPECT_EQ(tracer.pool_bytes().at(BIND_REFERENCE_POOL), options.pools.data == DataPool::copies ? 0U : 12U);
    EXPECT_EQ(tracer.pool_bytes().at(BIND_DATA_POOL), 48U);
    EXPECT_EQ(tracer.pool_bytes().at(BIND_COLOR_POOL), 12U);
    EXPECT_EQ(tracer.pool_bytes().pages, pages);
    return tracer.render(disc_view(50, 40), plain_settings()).rgba;
  };
  const auto with = [](DataPool data, std::uint64_t page_elements = UINT64_MAX) {
    return TracerOptions{.pools = {.data = data, .page_elements = page_elements}};
  };
  const auto copies = picture(with(DataPool::copies), 1);
  EXPECT_TRUE(copies == picture(with(DataPool::references), 1));
  EXPECT_TRUE(copies == picture(with(DataPool::copies, 1), 3)) << "a page for each splat";
  EXPECT_TRUE(copies == picture(with(DataPool::references, 1), 3));
  EXPECT_TRUE(copies == picture(with(DataPool::references, 2), 2));
}

TEST_F(PoolUpload, ReportsBytesByPool) {
  ShownTracer tracer(device);
  tracer.upload(disc_scene(3));
  EXPECT_EQ(tracer.pool_bytes().at(BIND_NODE_POOL), 4U);
  EXPECT_EQ(tracer.pool_bytes().at(BIND_BEGIN_END), 8U);
  EXPECT_EQ(tracer.pool_bytes().at(BIND_SLAB_POOL), 4U);
  EXPECT_EQ(tracer.pool_bytes().at(BIND_DATA_POOL), 48U);
  EXPECT_EQ(tracer.pool_bytes().at(BIND_TOP_TABLE), 4U);
  EXPECT_EQ(tracer.pool_bytes().at(BIND_COLOR_POOL), 0U);
}

TEST_F(PoolUpload, ReportsBytesOfTheFrame) {
  ShownTracer tracer(device);
  tracer.upload(disc_scene());
  const std::uint64_t before = tracer.pool_bytes().frame;
  static_cast<void>(tracer.render(disc_view(50, 40), plain_settings()));
  const std::uint64_t picture = tracer.pool_bytes().frame;
  EXPECT_GE(picture - before, 50U * 40U * sizeof(vec4));
  EXPECT_LT(picture - before, 2U * 50U * 40U * sizeof(vec4));
}

TEST_F(PoolUpload, WhatDoesNotFitIsRefused) {
  Scene scene = disc_scene();
  scene.node_pool.edit().resize(2 * PAGES_MOST);
  ShownTracer tracer(device, {.pools = {.page_elements = 1}});
  EXPECT_THROW(tracer.upload(scene), Error);
  EXPECT_EQ(tracer.pools_uploaded(), 0U);
}

TEST_F(PoolUpload, UploadAndFreeLeavesTheSceneWithoutItsPools) {
  for (const DataPool data : {DataPool::copies, DataPool::references}) {
    ShownTracer tracer(device, {.pools = {.data = data}});
    Scene scene = disc_scene(3);
    tracer.upload(scene);
    const auto picture = tracer.render(disc_view(50, 40), plain_settings()).rgba;
    EXPECT_EQ(scene.data_pool.size(), 3U) << "upload leaves it as it is";
    tracer.upload_and_free(scene);
    EXPECT_TRUE(picture == tracer.render(disc_view(50, 40), plain_settings()).rgba);
    const std::size_t left = scene.node_pool.size() + scene.begin_end.size() + scene.slab_pool.size() +
                             scene.reference_pool.size() + scene.data_pool.size() + scene.color_pool.size() +
                             scene.field_pool.size() + scene.clip_pool.size();
    EXPECT_EQ(left, 0U);
    EXPECT_EQ(scene.materials.size(), 3U);
    EXPECT_EQ(scene.bounds_max_world, disc_scene(3).bounds_max_world);
  }
}

/// The device's own limit; the root's children, each with all discs, are behind it.
TEST_F(PoolUpload, PoolBeyondTheLargestStorageBufferIsPaged) {
  const std::uint64_t limit = device.limits().storage_bytes;
  if (limit > std::uint64_t{256} << 20U)
    GTEST_SKIP() << "the device's storage buffers are too large to exceed here";
  Scene scene = disc_scene();
  const std::uint32_t leaf = scene.node_pool[0];
  const auto children = static_cast<std::uint32_t>(limit / sizeof(std::uint32_t));
  scene.node_pool.edit().resize(children);
  scene.node_pool.edit()[0] = NODE_INNER << NODE_TAG_SHIFT | children;
  scene.node_pool.edit().resize(children + std::size_t{8}, leaf);
  ShownTracer tracer(device);
  tracer.upload(scene);
  EXPECT_GT(tracer.pool_bytes().pages, 1U);
  const auto paged = tracer.render(disc_view(50, 40), plain_settings()).rgba;
  tracer.upload(disc_scene());
  EXPECT_EQ(tracer.pool_bytes().pages, 1U);
  EXPECT_TRUE(paged == tracer.render(disc_view(50, 40), plain_settings()).rgba);
}

}  // namespace
}  // namespace splatray
