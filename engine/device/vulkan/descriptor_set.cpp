#include "engine/device/vulkan/descriptor_set.h"

#include <vector>

namespace splatray {

DescriptorSet::DescriptorSet(const VulkanDevice& vulkan, std::span<const Binding> bindings)
    : vulkan_(vulkan) {
  make_layouts(bindings);
  make_set(bindings);
}

void DescriptorSet::make_layouts(std::span<const Binding> bindings) {
  std::vector<VkDescriptorSetLayoutBinding> all;
  for (const Binding& binding : bindings)
    all.push_back({static_cast<std::uint32_t>(all.size()), binding.type, binding.count,
                   VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
  VkDescriptorSetLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  info.bindingCount = static_cast<std::uint32_t>(all.size());
  info.pBindings = all.data();
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

void DescriptorSet::make_set(std::span<const Binding> bindings) {
  std::vector<VkDescriptorPoolSize> sizes;
  for (const Binding& binding : bindings) sizes.push_back({binding.type, binding.count});
  VkDescriptorPoolCreateInfo pool_info{};
  pool_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  pool_info.maxSets = 1;
  pool_info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
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

VkWriteDescriptorSet DescriptorSet::write_to(std::uint32_t binding, VkDescriptorType type) const {
  VkWriteDescriptorSet write{};
  write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
  write.dstSet = set_;
  write.dstBinding = binding;
  write.descriptorCount = 1;
  write.descriptorType = type;
  return write;
}

void DescriptorSet::write(std::uint32_t binding, VkBuffer buffer, std::uint32_t element) const {
  const VkDescriptorBufferInfo buffer_info{buffer, 0, VK_WHOLE_SIZE};
  VkWriteDescriptorSet write = write_to(binding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
  write.dstArrayElement = element;
  write.pBufferInfo = &buffer_info;
  vkUpdateDescriptorSets(vulkan_.device, 1, &write, 0, nullptr);
}

void DescriptorSet::write(std::uint32_t binding, const VkDescriptorImageInfo& image) const {
  VkWriteDescriptorSet write = write_to(binding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
  write.pImageInfo = &image;
  vkUpdateDescriptorSets(vulkan_.device, 1, &write, 0, nullptr);
}

}  // namespace splatray
