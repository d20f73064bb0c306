/// Compute pipelines of the engine's programs and the descriptor sets they read.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>

#include "engine/cpu/kernel.h"
#include "engine/device/program.h"
#include "engine/device/vulkan/buffer.h"
#include "engine/device/vulkan/pipeline_store.h"
#include "engine/device/vulkan/texture.h"
#include "engine/gpu/features.h"
#include "engine/gpu/pools.h"

namespace splatray {

/// The descriptor set (set 0, bindings BIND_*) shared by all programs of one paging, and its pipeline layout. Where the context is
/// the host, the arrays that kernels read and write.
class BindingSet {
 public:
  /// The context must outlive it.
  BindingSet(const Context& context, const Paging& paging);

  /// Points one binding to a buffer, or to all pages of a pool, or the environment's binding to a texture. The device must
  /// be idle; the buffer must outlive its use. Every binding needs a buffer before a dispatch, also one that the program
  /// does not use.
  void bind(std::uint32_t binding, const Buffer& buffer, std::uint32_t page = 0);
  void bind(std::uint32_t binding, const PagedBuffer& buffer);
  void bind(const EnvironmentTexture& texture);

  /// Kernels' arrays by binding; constants and parameters are left.
  [[nodiscard]] const KernelWork& host() const { return host_; }
  [[nodiscard]] VkDescriptorSet set() const { return set_; }
  [[nodiscard]] VkPipelineLayout layout() const { return pipeline_layout_.get(); }

 private:
  void create_layout();
  void create_set();

  const Context& context_;
  const Paging paging_;
  Handle<VkDescriptorSetLayout, vkDestroyDescriptorSetLayout> set_layout_;
  Handle<VkPipelineLayout, vkDestroyPipelineLayout> pipeline_layout_;
  Handle<VkDescriptorPool, vkDestroyDescriptorPool> pool_;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  KernelWork host_;
};

/// What a pipeline is made of, and so its name in the cache.
struct PipelineKey {
  Program program = Program::trace;
  SpecConstants constants{};

  auto operator<=>(const PipelineKey&) const = default;
};

/// Builds each pipeline once. The context must outlive it.
class PipelineCache {
 public:
  /// `folder`: where pipelines are kept between runs (pipeline_store.h); empty = nowhere.
  PipelineCache(const Context& context, Kernels kernels, const std::filesystem::path& folder)
      : context_(context), kernels_(kernels), store_(context, folder) {}

  /// The pipeline of the key, with that layout; built when it is the first such.
  [[nodiscard]] VkPipeline get(const PipelineKey& key, VkPipelineLayout layout);
  /// Pipelines built since construction.
  [[nodiscard]] std::uint32_t built() const { return static_cast<std::uint32_t>(pipelines_.size()); }

 private:
  const Context& context_;
  const Kernels kernels_;
  PipelineStore store_;
  std::map<PipelineKey, Handle<VkPipeline, vkDestroyPipeline>> pipelines_;
};

}  // namespace splatray
