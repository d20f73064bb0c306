/// The environment's texture: bilinear, repeating in columns, clamped in rows, no mip levels.
#pragma once
#include "engine/scene/environment.h"
#include "engine/vulkan/buffer.h"

namespace splatray {

/// Move-only sampled image of 4 floats a texel (of 16 bits where the device does not filter 32).
class EnvironmentTexture {
 public:
  EnvironmentTexture() = default;
  /// Uploads the texels and waits; one black texel when there are none. Throws Error (out_of_memory) when the
  /// device's images are not large enough.
  EnvironmentTexture(const Context& context, CommandQueue& queue, const Environment& environment);

  [[nodiscard]] VkImageView view() const { return view_.get(); }
  [[nodiscard]] VkSampler sampler() const { return sampler_.get(); }
  /// Bytes of the texels.
  [[nodiscard]] VkDeviceSize size() const { return size_; }

 private:
  void create_image(const Context& context, VkFormat format, VkExtent3D extent);
  void create_view_and_sampler(const Context& context, VkFormat format);

  Memory memory_;
  Handle<VkImage, vkDestroyImage> image_;
  Handle<VkImageView, vkDestroyImageView> view_;
  Handle<VkSampler, vkDestroySampler> sampler_;
  VkDeviceSize size_ = 0;
};

}  // namespace splatray
