/// Compute pipelines of the engine's programs and the descriptor sets they read.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>

#include "engine/device/queue.h"
#include "engine/device/vulkan/buffer.h"
#include "engine/device/vulkan/pipeline_store.h"

namespace splatray {

/// The descriptor set (set 0, bindings BIND_*) shared by all programs of one paging, and its pipeline layout.
class VulkanBindings final : public Bindings {
 public:
  /// The device must outlive it, and be idle whenever something is bound.
  VulkanBindings(const VulkanDevice& vulkan, const Paging& paging);

  using Bindings::bind;
  void bind(std::uint32_t binding, const Buffer& buffer, std::uint32_t page) override;
  void bind(const DeviceTexture& texture) override;

  [[nodiscard]] VkDescriptorSet set() const { return set_; }
  [[nodiscard]] VkPipelineLayout layout() const { return pipeline_layout_.get(); }

 private:
  void create_layout();
  void create_set();

  const VulkanDevice& vulkan_;
  const Paging paging_;
  Handle<VkDescriptorSetLayout, vkDestroyDescriptorSetLayout> set_layout_;
  Handle<VkPipelineLayout, vkDestroyPipelineLayout> pipeline_layout_;
  Handle<VkDescriptorPool, vkDestroyDescriptorPool> pool_;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
};

/// What a pipeline is made of, and so its name in the cache.
struct PipelineKey {
  Program program = Program::trace;
  SpecConstants constants{};

  auto operator<=>(const PipelineKey&) const = default;
};

/// The key's pipeline of a module's words (program_code.h).
[[nodiscard]] Handle<VkPipeline, vkDestroyPipeline> make_pipeline(
    const VulkanDevice& vulkan, const PipelineKey& key, std::span<const std::uint32_t> code,
    VkPipelineLayout layout, VkPipelineCache cache, VkPipelineCreateFlags flags = 0);

/// Builds each pipeline once. The device must outlive it.
class PipelineCache {
 public:
  /// `folder`: where pipelines are kept between runs (pipeline_store.h); empty = nowhere.
  PipelineCache(const VulkanDevice& vulkan, const std::filesystem::path& folder)
      : vulkan_(vulkan), store_(vulkan, folder) {}

  /// The pipeline of the key, with that layout; built when it is the first such.
  [[nodiscard]] VkPipeline get(const PipelineKey& key, VkPipelineLayout layout);
  /// Pipelines built since construction.
  [[nodiscard]] std::uint32_t built() const { return static_cast<std::uint32_t>(pipelines_.size()); }

 private:
  const VulkanDevice& vulkan_;
  PipelineStore store_;
  std::map<PipelineKey, Handle<VkPipeline, vkDestroyPipeline>> pipelines_;
};

}  // namespace splatray
