#include "engine/device/vulkan/buffer.h"

#include <numeric>

#include "engine/device/vulkan/command_queue.h"
#include "tests/gpu/shown_tracer.h"
#include "tests/gpu/small_scene.h"

namespace splatray {
namespace {

/// As on a device whose own memory the host cannot read: everything goes through staging.
void hide_host_memory(Context& context) {
  for (VkMemoryType& type : context.memory.memoryTypes)
    type.propertyFlags &= ~VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
}

class BufferTest : public DeviceTest {
 protected:
  void expect_round_trip(std::size_t count) {
    CommandQueue queue(context);
    std::vector<std::uint32_t> sent(count), received(count);
    std::iota(sent.begin(), sent.end(), 7U);
    Buffer buffer(context, count * sizeof(sent[0]), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    buffer.upload(queue, std::as_bytes(std::span(sent)));
    buffer.download(queue, std::as_writable_bytes(std::span(received)));
    EXPECT_TRUE(sent == received);
  }
};

TEST_F(BufferTest, KeepsWhatWasUploaded) { expect_round_trip(1000); }

TEST_F(BufferTest, StagingKeepsWhatWasUploadedAcrossItsPieces) {
  hide_host_memory(context);
  expect_round_trip(3);
  expect_round_trip((std::size_t{64} << 20U) / sizeof(std::uint32_t) + 5);
}

TEST_F(BufferTest, EmptyBufferIsStillABuffer) {
  const Buffer buffer(context, 0, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  EXPECT_NE(buffer.get(), VkBuffer{VK_NULL_HANDLE});
}

TEST_F(BufferTest, StagedPictureIsTheSame) {
  const Scene scene = disc_scene();
  ShownTracer direct(context);
  direct.upload(scene);
  const Image expected = direct.render(disc_view(40, 30), plain_settings());
  hide_host_memory(context);
  ShownTracer staged(context);
  staged.upload(scene);
  EXPECT_TRUE(staged.render(disc_view(40, 30), plain_settings()).rgba == expected.rgba);
}

}  // namespace
}  // namespace splatray
