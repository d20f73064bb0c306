#include "engine/gpu/pools.h"

#include <string>

#include "engine/gpu/tracer.h"
#include "engine/host/error.h"
#include "tests/gpu/small_scene.h"

namespace splatray {
namespace {

constexpr PoolLimits LIMITS{.texel_elements = 1000, .storage_bytes = 8000, .allocation_bytes = 20000};

std::string refusal(const PoolBytes& bytes, PoolAccess wanted) {
  try {
    (void)choose_access(bytes, LIMITS, wanted);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::out_of_memory);
    return error.what();
  }
  return "";
}

TEST(PoolAccess, PrefersTexelBuffersWithinTheirLimit) {
  const PoolBytes bytes{.node_pool = 4000, .begin_end = 4000, .data_pool = 16000};
  EXPECT_EQ(choose_access(bytes, LIMITS, PoolAccess::automatic), PoolAccess::texel);
}

TEST(PoolAccess, FallsBackToStorageBuffers) {
  const PoolBytes bytes{.node_pool = 4004, .begin_end = 4000, .data_pool = 8000};
  EXPECT_EQ(choose_access(bytes, LIMITS, PoolAccess::automatic), PoolAccess::storage);
}

TEST(PoolAccess, FourReferencesInATexelFitWhereOneDoesNot) {
  PoolBytes bytes{.reference_pool = 12000, .references = REFERENCES_ONE};
  EXPECT_NE(refusal(bytes, PoolAccess::texel), "");
  bytes.references = REFERENCES_FOUR;
  EXPECT_EQ(choose_access(bytes, LIMITS, PoolAccess::texel), PoolAccess::texel);
}

TEST(PoolAccess, CanBeForced) {
  EXPECT_EQ(choose_access({.data_pool = 16}, LIMITS, PoolAccess::storage), PoolAccess::storage);
  EXPECT_NE(refusal({.node_pool = 4004}, PoolAccess::texel), "");
  EXPECT_NE(refusal({.node_pool = 8004}, PoolAccess::storage), "");
}

TEST(PoolAccess, RefusalNamesPoolSizeAndLimit) {
  const std::string sentence = refusal({.node_pool = 4, .data_pool = 30 << 20}, PoolAccess::automatic);
  EXPECT_NE(sentence.find("data pool"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("30.0 MiB"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("largest allocation is 0.0 MiB"), std::string::npos) << sentence;
}

/// What `automatic` makes of a scene of so many splats, with so many references, where LIMITS hold.
std::uint32_t automatic_references(std::size_t splats, std::size_t references,
                                   PoolAccess access = PoolAccess::automatic) {
  return choose_references({splats, references, 1, 1, false, false}, LIMITS, access, DataPool::automatic);
}

TEST(DataPool, HasCopiesWhereTheyFit) {
  EXPECT_EQ(automatic_references(400, 1000), REFERENCES_NONE);
  EXPECT_EQ(automatic_references(200, 1000), REFERENCES_ONE) << "80 bytes a splat";
}

TEST(DataPool, HasReferencesWhereOneBufferDoesNotHoldCopies) {
  EXPECT_EQ(automatic_references(400, 500, PoolAccess::storage), REFERENCES_NONE);
  EXPECT_EQ(automatic_references(400, 501, PoolAccess::storage), REFERENCES_ONE)
      << "8016 bytes of storage buffer";
  EXPECT_EQ(automatic_references(1000, 1001), REFERENCES_FOUR) << "1001 texels";
}

TEST(DataPool, CanBeForced) {
  const PoolCounts counts{200, 1000, 1, 1, false, false};
  EXPECT_EQ(choose_references(counts, LIMITS, PoolAccess::automatic, DataPool::copies), REFERENCES_NONE);
  EXPECT_EQ(choose_references(counts, LIMITS, PoolAccess::automatic, DataPool::wide_references),
            REFERENCES_FOUR);
}

using PoolUpload = DeviceTest;

TEST_F(PoolUpload, BothAccessesGiveTheSamePicture) {
  const Scene scene = disc_scene(3);
  Tracer texel(context, PoolAccess::texel), storage(context, PoolAccess::storage);
  texel.upload(scene);
  storage.upload(scene);
  EXPECT_TRUE(texel.pool_bytes().texel_buffers);
  EXPECT_FALSE(storage.pool_bytes().texel_buffers);
  EXPECT_TRUE(texel.render(disc_view(50, 40), plain_settings()).rgba ==
              storage.render(disc_view(50, 40), plain_settings()).rgba);
}

TEST_F(PoolUpload, AllDataPoolsGiveTheSamePicture) {
  Scene scene = disc_scene(3);
  scene.reference_pool = {2, 0, 1};
  scene.color_pool = {pack_color({1.0F, 0.0F, 0.0F}), pack_color({0.0F, 1.0F, 0.0F}),
                      pack_color({0.0F, 0.0F, 1.0F})};
  const auto picture = [&](DataPool data, PoolAccess access, std::uint64_t reference_bytes) {
    Tracer tracer(context, access, Arithmetic::automatic, data);
    tracer.upload(scene);
    EXPECT_EQ(tracer.pool_bytes().reference_pool, reference_bytes);
    EXPECT_EQ(tracer.pool_bytes().data_pool, 48U);
    EXPECT_EQ(tracer.pool_bytes().color_pool, 12U);
    return tracer.render(disc_view(50, 40), plain_settings()).rgba;
  };
  for (const PoolAccess access : {PoolAccess::texel, PoolAccess::storage}) {
    const auto copies = picture(DataPool::copies, access, 0);
    EXPECT_TRUE(copies == picture(DataPool::references, access, 12));
    EXPECT_TRUE(copies == picture(DataPool::wide_references, access, 12));
  }
}

TEST_F(PoolUpload, ReportsBytesByPool) {
  Tracer tracer(context);
  tracer.upload(disc_scene(3));
  EXPECT_EQ(tracer.pool_bytes().node_pool, 4U);
  EXPECT_EQ(tracer.pool_bytes().begin_end, 8U);
  EXPECT_EQ(tracer.pool_bytes().slab_pool, 4U);
  EXPECT_EQ(tracer.pool_bytes().data_pool, 48U);
  EXPECT_EQ(tracer.pool_bytes().top_table, 4U);
  EXPECT_EQ(tracer.pool_bytes().color_pool, 0U);
}

TEST_F(PoolUpload, PoolBeyondTheDevicesLimitIsRefused) {
  const std::uint64_t limit = context.properties.limits.maxStorageBufferRange;
  if (limit > std::uint64_t{256} << 20U)
    GTEST_SKIP() << "the device's storage buffers are too large to exceed here";
  Scene scene = disc_scene();
  scene.node_pool.resize(limit / sizeof(std::uint32_t) + 1);
  Tracer tracer(context, PoolAccess::storage);
  EXPECT_THROW(tracer.upload(scene), Error);
  EXPECT_EQ(tracer.pools_uploaded(), 0U);
}

}  // namespace
}  // namespace splatray
