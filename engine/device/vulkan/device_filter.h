/// Takes the noise out of pictures on a Vulkan device, without bringing them to the host.
#pragma once
#include <array>

#include "engine/device/vulkan/command_queue.h"
#include "engine/device/vulkan/descriptor_set.h"
#include "shaders/display/denoise_layout.h"

namespace splatray {

/// A picture, of each pixel.
struct NoisyPicture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  const VulkanBuffer* means = nullptr;   ///< vec4: the mean of the samples that are not in `before`
  const VulkanBuffer* before = nullptr;  ///< vec4: that of the first samples; not null
  float weight = 1.0F;                   ///< of `means` in the picture
};

/// denoised() of engine/image/denoise.h as a program (denoise.comp.glsl). For one thread, that of the queue which traces.
class DeviceFilter {
 public:
  /// The device must outlive it.
  explicit DeviceFilter(const VulkanDevice& vulkan);

  /// Keeps a picture as Image::part of what is filtered next. Throws Error (out_of_memory) where there is no room to filter it.
  void keep(const NoisyPicture& part);
  /// Begins to filter. `part_share`: as Image has it of what was kept. `base`: base colours, a vec4 of each pixel; `aov`: AovPixels. The
  /// result, a vec4 of each pixel, is there for what is handed to the device's queue afterwards, until the next call. Throws Error as
  /// check() does.
  [[nodiscard]] const VulkanBuffer& run(const NoisyPicture& picture, float part_share, const Buffer& base,
                                        const Buffer& aov);
  /// Waits until the device has read what it was given.
  void wait();

 private:
  using Program = Handle<VkPipeline, vkDestroyPipeline>;

  void take(const NoisyPicture& picture);
  void record_bound(VkCommandBuffer commands) const;
  void record(DenoiseParams params, VkCommandBuffer commands) const;
  void record_step(std::uint32_t step, std::uint32_t threads, const DenoiseParams& params,
                   VkCommandBuffer commands) const;

  const VulkanDevice& vulkan_;
  DescriptorSet set_;
  std::array<Program, DENOISE_STEPS> programs_;  ///< by step
  VulkanBuffer params_, part_, planes_, words_, result_;
  bool is_begun_ = false;  ///< work was begun and not ended
  CommandQueue queue_;     ///< behind what its work uses
};

}  // namespace splatray
