/// The environment's texture: bilinear, repeating in columns, clamped in rows, no mip levels.
#pragma once
#include "engine/device/vulkan/buffer.h"
#include "engine/device/vulkan/command_queue.h"
#include "engine/scene/environment.h"

namespace splatray {

/// A sampled image of 4 floats a texel (of 16 bits where the device does not filter 32).
class EnvironmentTexture final : public DeviceTexture {
 public:
  /// Uploads the texels and waits.
  EnvironmentTexture(const VulkanDevice& vulkan, CommandQueue& queue, const Environment& environment);

  [[nodiscard]] VkImageView view() const { return view_.get(); }
  [[nodiscard]] VkSampler sampler() const { return sampler_.get(); }
  [[nodiscard]] std::uint64_t size() const override { return size_; }

 private:
  void create_image(const VulkanDevice& vulkan, VkFormat format, VkExtent3D extent);
  void create_view_and_sampler(const VulkanDevice& vulkan, VkFormat format);

  Memory memory_;
  Handle<VkImage, vkDestroyImage> image_;
  Handle<VkImageView, vkDestroyImageView> view_;
  Handle<VkSampler, vkDestroySampler> sampler_;
  std::uint64_t size_ = 0;
};

}  // namespace splatray
