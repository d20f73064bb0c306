/// Compute pipelines of the engine's programs and the descriptor sets they read.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <future>
#include <map>
#include <memory>
#include <span>
#include <utility>

#include "engine/device/queue.h"
#include "engine/device/vulkan/buffer.h"
#include "engine/device/vulkan/command_queue.h"
#include "engine/device/vulkan/descriptor_set.h"
#include "engine/device/vulkan/pipeline_store.h"

namespace splatray {

/// The descriptor set (set 0, bindings BIND_*) shared by all programs of one paging, and its pipeline layout.
class VulkanBindings final : public Bindings {
 public:
  /// Device and queue, whose work it is of, must outlive it.
  VulkanBindings(const VulkanDevice& vulkan, CommandQueue& queue, const Paging& paging);

  using Bindings::bind;
  void bind(std::uint32_t binding, const Buffer& buffer, std::uint32_t page) override;
  void bind(const DeviceTexture& texture) override;

  [[nodiscard]] VkDescriptorSet set() const { return set_.get(); }
  [[nodiscard]] const SharedLayout& layout() const { return set_.layout(); }

 private:
  [[nodiscard]] bool takes(std::uint32_t binding, std::uint32_t page, std::uint64_t id);

  CommandQueue& queue_;
  DescriptorSet set_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint64_t> bound_;  ///< ids by binding and page
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

/// Builds each pipeline once, several at a time where they are prepared. For one thread. The device must outlive it.
class PipelineCache {
 public:
  /// `folder`: where pipelines are kept between runs (pipeline_store.h); empty = nowhere.
  PipelineCache(const VulkanDevice& vulkan, const std::filesystem::path& folder)
      : vulkan_(vulkan), store_(vulkan, folder) {}

  /// The pipeline of the key, with that layout; built when it is the first such. Throws Error as check() does.
  [[nodiscard]] VkPipeline get(const PipelineKey& key, const SharedLayout& layout);
  /// Begins to build it on a thread of its own.
  void prepare(const PipelineKey& key, const SharedLayout& layout);
  /// Pipelines built, or begun, since construction.
  [[nodiscard]] std::uint32_t built() const {
    return static_cast<std::uint32_t>(pipelines_.size() + begun_.size());
  }

 private:
  using Pipeline = Handle<VkPipeline, vkDestroyPipeline>;

  [[nodiscard]] Pipeline build(const PipelineKey& key, const SharedLayout& layout) const;

  const VulkanDevice& vulkan_;
  PipelineStore store_;
  std::map<PipelineKey, Pipeline> pipelines_;
  std::map<PipelineKey, std::future<Pipeline>> begun_;  ///< on other threads, of which each is waited for
};

}  // namespace splatray
