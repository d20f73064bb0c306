#include "engine/device/vulkan/buffer.h"

#include <numeric>

#include "engine/device/vulkan/command_queue.h"
#include "tests/gpu/shown_tracer.h"
#include "tests/gpu/small_scene.h"

namespace splatray {
namespace {

/// As on a device whose own memory the host cannot read: everything goes through staging.
void hide_host_memory(VulkanDevice& device) {
  for (VkMemoryType& type : device.memory.memoryTypes)
    type.propertyFlags &= ~VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
}

class BufferTest : public DeviceTest {
 protected:
  void expect_round_trip(std::size_t count) {
    CommandQueue queue(device);
    std::vector<std::uint32_t> sent(count), received(count);
    std::iota(sent.begin(), sent.end(), 7U);
    VulkanBuffer buffer(device, count * sizeof(sent[0]), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    queue.upload(buffer, std::as_bytes(std::span(sent)));
    queue.download(buffer, std::as_writable_bytes(std::span(received)));
    EXPECT_TRUE(sent == received);
  }
};

TEST_F(BufferTest, KeepsWhatWasUploaded) { expect_round_trip(1000); }

TEST_F(BufferTest, StagingKeepsWhatWasUploadedAcrossItsPieces) {
  hide_host_memory(device);
  expect_round_trip(3);
  for (const std::size_t megabytes : {32U, 40U, 64U, 96U, 130U})
    expect_round_trip((std::size_t{megabytes} << 20U) / sizeof(std::uint32_t) + 5);
}

TEST_F(BufferTest, EmptyBufferIsStillABuffer) {
  const VulkanBuffer buffer(device, 0, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  EXPECT_NE(buffer.get(), VkBuffer{VK_NULL_HANDLE});
}

TEST_F(BufferTest, StagedPictureIsTheSame) {
  const Scene scene = disc_scene();
  ShownTracer direct(device);
  direct.upload(scene);
  const Image expected = direct.render(disc_view(40, 30), plain_settings());
  hide_host_memory(device);
  ShownTracer staged(device);
  staged.upload(scene);
  EXPECT_TRUE(staged.render(disc_view(40, 30), plain_settings()).rgba == expected.rgba);
}

}  // namespace
}  // namespace splatray
