#include "engine/device/vulkan/pipeline.h"

#include <cassert>

#include "engine/device/vulkan/program_code.h"
#include "engine/device/vulkan/texture.h"

namespace splatray {
namespace {

/// The bindings BIND_*, of pools a buffer a page.
std::array<DescriptorSet::Binding, BINDINGS> bindings_of(const Paging& paging) {
  std::array<DescriptorSet::Binding, BINDINGS> bindings{};
  for (std::uint32_t i = 0; i < BINDINGS; ++i)
    if (is_pool(i)) bindings[i].count = paging.pages[i - BIND_POOLS];
  bindings[BIND_ENVIRONMENT].type = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
  return bindings;
}

Handle<VkShaderModule, vkDestroyShaderModule> make_module(const VulkanDevice& vulkan,
                                                          std::span<const std::uint32_t> code) {
  VkShaderModuleCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  info.codeSize = code.size_bytes();
  info.pCode = code.data();
  VkShaderModule module = VK_NULL_HANDLE;
  check(vkCreateShaderModule(vulkan.device, &info, nullptr, &module), "loading a shader");
  return {vulkan.device, module};
}

}  // namespace

VulkanBindings::VulkanBindings(const VulkanDevice& vulkan, CommandQueue& queue, const Paging& paging)
    : queue_(queue), set_(vulkan, bindings_of(paging)) {}

/// Whether the binding was another's, once no work reads it.
bool VulkanBindings::takes(std::uint32_t binding, std::uint32_t page, std::uint64_t id) {
  std::uint64_t& bound = bound_[{binding, page}];
  if (bound == id) return false;
  queue_.finish();
  bound = id;
  return true;
}

void VulkanBindings::bind(std::uint32_t binding, const Buffer& buffer, std::uint32_t page) {
  if (takes(binding, page, buffer.id()))
    set_.write(binding, static_cast<const VulkanBuffer&>(buffer).get(), page);
}

void VulkanBindings::bind(const DeviceTexture& texture) {
  if (!takes(BIND_ENVIRONMENT, 0, texture.id())) return;
  const auto& environment = static_cast<const EnvironmentTexture&>(texture);
  set_.write(BIND_ENVIRONMENT, VkDescriptorImageInfo{environment.sampler(), environment.view(),
                                                     VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL});
}

Handle<VkPipeline, vkDestroyPipeline> make_pipeline(const VulkanDevice& vulkan, const PipelineKey& key,
                                                    std::span<const std::uint32_t> code,
                                                    VkPipelineLayout layout, VkPipelineCache cache,
                                                    VkPipelineCreateFlags flags) {
  std::array<VkSpecializationMapEntry, SPEC_COUNT> entries{};
  for (std::uint32_t i = 0; i < SPEC_COUNT; ++i)
    entries[i] = {i, i * static_cast<std::uint32_t>(sizeof(std::uint32_t)), sizeof(std::uint32_t)};
  const VkSpecializationInfo specialization{SPEC_COUNT, entries.data(), sizeof(key.constants),
                                            key.constants.data()};
  const auto module = make_module(vulkan, code);
  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.flags = flags;
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = module.get();
  info.stage.pName = "main";
  info.stage.pSpecializationInfo = &specialization;
  info.layout = layout;
  VkPipeline pipeline = VK_NULL_HANDLE;
  check(vkCreateComputePipelines(vulkan.device, cache, 1, &info, nullptr, &pipeline), "building a pipeline");
  return {vulkan.device, pipeline};
}

PipelineCache::Pipeline PipelineCache::build(const PipelineKey& key, const SharedLayout& layout) const {
  return make_pipeline(vulkan_, key, program_code(key.program), layout->get(), store_.get());
}

void PipelineCache::prepare(const PipelineKey& key, const SharedLayout& layout) {
  if (pipelines_.contains(key) || begun_.contains(key)) return;
  begun_.emplace(key, std::async(std::launch::async, [this, key, layout] { return build(key, layout); }));
}

VkPipeline PipelineCache::get(const PipelineKey& key, const SharedLayout& layout) {
  auto found = pipelines_.find(key);
  if (found == pipelines_.end()) {
    auto begun = begun_.extract(key);
    found = pipelines_.emplace(key, begun ? begun.mapped().get() : build(key, layout)).first;
  }
  return found->second.get();
}

}  // namespace splatray
