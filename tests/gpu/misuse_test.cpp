// Calls that make no sense, work that is too much for a driver, and what is kept between runs.
#include <filesystem>
#include <fstream>

#include "engine/base/error.h"
#include "engine/device/vulkan/command_queue.h"
#include "engine/device/vulkan/pipeline_store.h"
#include "engine/scene/splat.h"
#include "tests/gpu/shown_tracer.h"
#include "tests/gpu/small_scene.h"
#include "tests/temp_folder.h"

namespace splatray {
namespace {

using Misuse = DeviceTest;

TEST_F(Misuse, CallsBeforeUploadAreErrors) {
  ShownTracer tracer(device);
  const View view = disc_view(9, 9);
  EXPECT_THROW((void)tracer.render(view, plain_settings()), Error);
  EXPECT_THROW((void)tracer.trace_aov(view, plain_settings()), Error);
  EXPECT_THROW((void)tracer.intersect(std::vector<RayQuery>(1), plain_settings()), Error);
  EXPECT_THROW(tracer.begin(view, plain_settings()), Error);
  EXPECT_THROW((void)tracer.advance(1.0), Error);
  EXPECT_THROW((void)tracer.picture(), Error);
}

TEST_F(Misuse, AnotherNumberOfMaterialsIsAnError) {
  ShownTracer tracer(device);
  Scene scene = disc_scene(2);
  tracer.upload(scene);
  EXPECT_NO_THROW((void)tracer.render(disc_view(9, 9), plain_settings()));
  tracer.set_materials({scene.materials.front()});
  EXPECT_THROW((void)tracer.render(disc_view(9, 9), plain_settings()), Error);
  tracer.set_materials(scene.materials);
  Settings none = plain_settings();
  none.samples = 0;
  EXPECT_THROW((void)tracer.render(disc_view(9, 9), none), Error);
}

TEST_F(Misuse, AnImageBegunEndsWithItsScene) {
  ShownTracer tracer(device);
  tracer.upload(disc_scene());
  tracer.begin(disc_view(9, 9), plain_settings());
  tracer.upload(disc_scene(2));
  EXPECT_THROW((void)tracer.advance(1.0), Error);
  tracer.begin(disc_view(9, 9), plain_settings());
  while (!tracer.advance(1.0)) {
  }
  EXPECT_TRUE(tracer.picture().rgba == tracer.render(disc_view(9, 9), plain_settings()).rgba);
}

TEST_F(Misuse, ARecordingThatThrowsLeavesTheQueueUsable) {
  CommandQueue queue(device);
  EXPECT_THROW((void)queue.run([](VkCommandBuffer) { throw Error(ExitCode::failed, "no"); }), Error);
  EXPECT_NO_THROW((void)queue.run([](VkCommandBuffer) {}));
}

/// A leaf that lists the disc, and before it another that no ray meets, `others` times.
Scene long_list(std::uint32_t others) {
  Scene scene = disc_scene(2);
  Splat aside = unpack_splat(scene.data_pool[1]);
  aside.center = {1e5, 1e5, 1e5};
  aside.radius_squared = 4.0;
  scene.data_pool.edit()[1] = pack_splat(aside);
  scene.reference_pool.edit().assign(others, 1);
  scene.reference_pool.edit().push_back(0);
  scene.begin_end = {0, others + 1};
  return scene;
}

TEST_F(Misuse, WorkThatADriverCutsShortIsDoneInSmallerPartsOrRefused) {
  if (!device.is_cpu()) GTEST_SKIP() << "only llvmpipe is known to cut loops short";
  Settings settings = plain_settings();
  settings.samples = 16;
  settings.shadows = true;
  const View view = disc_view(8, 8);
  ShownTracer tracer(device);
  tracer.upload(long_list(0));
  const auto expected = tracer.render(view, settings).rgba;
  Settings one = settings;
  one.samples = 1;
  const auto expected_of_one = tracer.render(view, one).rgba;
  tracer.upload(long_list(10'000));  // 16 samples and their shadow rays: 480 000 iterations
  EXPECT_TRUE(tracer.render(view, settings).rgba == expected);
  tracer.upload(
      long_list(200'000));  // one ray: 200 000 at least, which Mesa 22.3 cuts short and 25.0 does not
  const auto expect_whole_or_refused = [](const auto& make, const auto& whole) {
    try {
      EXPECT_TRUE(make().rgba == whole);
    } catch (const Error&) {
    }
  };
  expect_whole_or_refused([&] { return tracer.render(view, settings); }, expected);
  tracer.begin(view, one);
  (void)tracer.advance(10.0);
  expect_whole_or_refused([&] { return tracer.picture(); }, expected_of_one);
}

class PipelineStoreTest : public DeviceTest {
 protected:
  void render() {
    ShownTracer tracer(device, {.pipeline_folder = folder.path() / "cache"});
    tracer.upload(disc_scene());
    (void)tracer.render(disc_view(9, 9), plain_settings());
  }

  [[nodiscard]] std::string bytes() const {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  TempFolder folder;
  const std::filesystem::path file = pipeline_file(folder.path() / "cache", device.properties);
};

TEST_F(PipelineStoreTest, IsKeptAndReadAgain) {
  render();
  ASSERT_TRUE(std::filesystem::exists(file));
  const auto written = std::filesystem::last_write_time(file);
  const auto size = std::filesystem::file_size(file);
  EXPECT_GE(size, sizeof(VkPipelineCacheHeaderVersionOne));
  render();
  EXPECT_EQ(std::filesystem::last_write_time(file), written) << "nothing new, nothing written";
}

TEST_F(PipelineStoreTest, DamageOfAnyByteIsFoundAndMended) {
  render();
  const std::string whole = bytes();
  ASSERT_GT(whole.size(), sizeof(VkPipelineCacheHeaderVersionOne));
  const std::size_t header = whole.find('\n') + 1;
  // In the checksum, the driver's header and, where a driver keeps more than that, what follows it; cut off and added.
  std::vector<std::string> damaged = {whole.substr(0, whole.size() - 1), whole + 'x',
                                      whole.substr(0, header)};
  for (std::size_t at = header; at < whole.size(); at += 1 + whole.size() / 50) {
    damaged.push_back(whole);
    damaged.back()[at] ^= 1;
  }
  for (const std::string& bad : damaged) {
    std::ofstream(file, std::ios::binary) << bad;
    EXPECT_EQ(PipelineStore(device, file.parent_path()).bytes_read(), 0U);
    EXPECT_GT(PipelineStore(device, file.parent_path()).bytes_read(), 0U) << "mended by that store's end";
  }
  std::ofstream(file, std::ios::binary) << whole;
  EXPECT_EQ(PipelineStore(device, file.parent_path()).bytes_read(), whole.size() - header - 8);
}

TEST_F(PipelineStoreTest, NeitherFollowsLinksNorReplacesWhatOthersWrote) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(folder.path() / "victim") << "mine";
  std::filesystem::create_symlink(folder.path() / "victim", file);
  render();
  EXPECT_TRUE(std::filesystem::is_symlink(file));
  EXPECT_EQ(std::filesystem::file_size(folder.path() / "victim"), 4U);
  std::filesystem::remove(file);
  std::ofstream(file) << "mine";
  render();
  EXPECT_EQ(bytes(), "mine");
}

TEST_F(PipelineStoreTest, FoldersThatCannotBeWrittenDoNoHarm) {
  std::ofstream(folder.path() / "cache") << "a file where the folder belongs";
  EXPECT_NO_THROW(render());
}

}  // namespace
}  // namespace splatray
