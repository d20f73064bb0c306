#include "engine/device/vulkan/pipeline.h"

#include <cassert>

#include "engine/device/vulkan/program_code.h"
#include "engine/device/vulkan/texture.h"

namespace splatray {
namespace {

VkDescriptorType descriptor_type(std::uint32_t binding) {
  return binding == BIND_ENVIRONMENT ? VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER
                                     : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

std::uint32_t descriptor_count(std::uint32_t binding, const Paging& paging) {
  return is_pool(binding) ? paging.pages[binding - BIND_POOLS] : 1;
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

VulkanBindings::VulkanBindings(const VulkanDevice& vulkan, const Paging& paging)
    : vulkan_(vulkan), paging_(paging) {
  create_layout();
  create_set();
}

void VulkanBindings::create_layout() {
  std::array<VkDescriptorSetLayoutBinding, BINDINGS> bindings{};
  for (std::uint32_t i = 0; i < BINDINGS; ++i)
    bindings[i] = {i, descriptor_type(i), descriptor_count(i, paging_), VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
  VkDescriptorSetLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  info.bindingCount = BINDINGS;
  info.pBindings = bindings.data();
  VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
  check(vkCreateDescriptorSetLayout(vulkan_.device, &info, nullptr, &set_layout),
        "making a descriptor set layout");
  set_layout_ = {vulkan_.device, set_layout};

  VkPipelineLayoutCreateInfo layout_info{};
  layout_info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  layout_info.setLayoutCount = 1;
  layout_info.pSetLayouts = &set_layout;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  check(vkCreatePipelineLayout(vulkan_.device, &layout_info, nullptr, &layout), "making a pipeline layout");
  pipeline_layout_ =
      std::make_shared<const Handle<VkPipelineLayout, vkDestroyPipelineLayout>>(vulkan_.device, layout);
}

void VulkanBindings::create_set() {
  std::array<VkDescriptorPoolSize, BINDINGS> sizes{};
  for (std::uint32_t i = 0; i < BINDINGS; ++i) sizes[i] = {descriptor_type(i), descriptor_count(i, paging_)};
  VkDescriptorPoolCreateInfo pool_info{};
  pool_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  pool_info.maxSets = 1;
  pool_info.poolSizeCount = BINDINGS;
  pool_info.pPoolSizes = sizes.data();
  VkDescriptorPool pool = VK_NULL_HANDLE;
  check(vkCreateDescriptorPool(vulkan_.device, &pool_info, nullptr, &pool), "making a descriptor pool");
  pool_ = {vulkan_.device, pool};

  const VkDescriptorSetLayout set_layout = set_layout_.get();
  VkDescriptorSetAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  info.descriptorPool = pool;
  info.descriptorSetCount = 1;
  info.pSetLayouts = &set_layout;
  check(vkAllocateDescriptorSets(vulkan_.device, &info, &set_), "making a descriptor set");
}

void VulkanBindings::bind(std::uint32_t binding, const Buffer& buffer, std::uint32_t page) {
  const auto& bound = static_cast<const VulkanBuffer&>(buffer);
  const VkDescriptorBufferInfo buffer_info{bound.get(), 0, VK_WHOLE_SIZE};
  VkWriteDescriptorSet write{};
  write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
  write.dstSet = set_;
  write.dstBinding = binding;
  write.dstArrayElement = page;
  write.descriptorCount = 1;
  write.descriptorType = descriptor_type(binding);
  write.pBufferInfo = &buffer_info;
  vkUpdateDescriptorSets(vulkan_.device, 1, &write, 0, nullptr);
}

void VulkanBindings::bind(const DeviceTexture& texture) {
  const auto& environment = static_cast<const EnvironmentTexture&>(texture);
  const VkDescriptorImageInfo image_info{environment.sampler(), environment.view(),
                                         VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
  VkWriteDescriptorSet write{};
  write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
  write.dstSet = set_;
  write.dstBinding = BIND_ENVIRONMENT;
  write.descriptorCount = 1;
  write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
  write.pImageInfo = &image_info;
  vkUpdateDescriptorSets(vulkan_.device, 1, &write, 0, nullptr);
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
