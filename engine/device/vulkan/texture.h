/// The environment's texture: bilinear, repeating in columns, clamped in rows, no mip levels.
#pragma once
#include "engine/device/vulkan/buffer.h"
#include "engine/scene/environment.h"

namespace splatray {

/// Move-only sampled image of 4 floats a texel (of 16 bits where the device does not filter 32).
class EnvironmentTexture {
 public:
  EnvironmentTexture() = default;
  /// Uploads the texels and waits; one black texel when there are none. Throws Error (out_of_memory) when the
  /// device's images are not large enough.
  EnvironmentTexture(const Context& context, CommandQueue& queue, const Environment& environment);

  [[nodiscard]] std::uint32_t width() const { return width_; }    ///< texels
  [[nodiscard]] std::uint32_t height() const { return height_; }  ///< texels
  /// The texels of a context that is the host, vec4.
  [[nodiscard]] const Buffer& texels() const { return texels_; }
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
  Buffer texels_;
  std::uint32_t width_ = 0, height_ = 0;
  VkDeviceSize size_ = 0;
};

}  // namespace splatray
