/// The one descriptor set of some compute programs, and their pipelines' layout.
#pragma once
#include <cstdint>
#include <memory>
#include <span>

#include "engine/device/vulkan/handle.h"
#include "engine/device/vulkan/vulkan_device.h"

namespace splatray {

/// Shared with the threads that build pipelines of it.
using SharedLayout = std::shared_ptr<const Handle<VkPipelineLayout, vkDestroyPipelineLayout>>;

/// Set 0, made once. The device must outlive it, and be idle whenever something is written.
class DescriptorSet {
 public:
  /// What a binding of compute shaders holds.
  struct Binding {
    VkDescriptorType type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    std::uint32_t count = 1;  ///< descriptors
  };
  /// Binding i is the i-th of these. Throws Error as check() does.
  DescriptorSet(const VulkanDevice& vulkan, std::span<const Binding> bindings);

  [[nodiscard]] VkDescriptorSet get() const { return set_; }
  [[nodiscard]] const SharedLayout& layout() const { return pipeline_layout_; }

  /// Writes a whole buffer into a binding of storage buffers, as its descriptor `element`.
  void write(std::uint32_t binding, VkBuffer buffer, std::uint32_t element = 0) const;
  /// Writes an image into a binding of images with their samplers.
  void write(std::uint32_t binding, const VkDescriptorImageInfo& image) const;

 private:
  void make_layouts(std::span<const Binding> bindings);
  void make_set(std::span<const Binding> bindings);
  [[nodiscard]] VkWriteDescriptorSet write_to(std::uint32_t binding, VkDescriptorType type) const;

  const VulkanDevice& vulkan_;
  Handle<VkDescriptorSetLayout, vkDestroyDescriptorSetLayout> set_layout_;
  SharedLayout pipeline_layout_;
  Handle<VkDescriptorPool, vkDestroyDescriptorPool> pool_;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
};

}  // namespace splatray
