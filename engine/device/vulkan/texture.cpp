#include "engine/device/vulkan/texture.h"

#include <algorithm>
#include <cstring>
#include <glm/gtc/packing.hpp>

#include "engine/device/vulkan/command_queue.h"

namespace splatray {
namespace {

bool filters_32_bit(const VulkanDevice& vulkan) {
  constexpr VkFormatFeatureFlags NEEDED = VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT |
                                          VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT |
                                          VK_FORMAT_FEATURE_TRANSFER_DST_BIT;
  VkFormatProperties properties{};
  vkGetPhysicalDeviceFormatProperties(vulkan.physical_device, VK_FORMAT_R32G32B32A32_SFLOAT, &properties);
  return (properties.optimalTilingFeatures & NEEDED) == NEEDED;
}

/// Writes texels as 4 floats of 32 or 16 bits; the latter clamped to the largest finite one.
void write_texels(std::span<const glm::vec3> texels, bool as_32_bit, std::byte* out) {
  constexpr float LARGEST_HALF = 65504.0F;
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const glm::vec4 texel(texels[i], 1.0F);
    if (as_32_bit) {
      std::memcpy(out + i * sizeof(texel), &texel, sizeof(texel));
    } else {
      const std::uint64_t half = glm::packHalf4x16(glm::min(texel, glm::vec4(LARGEST_HALF)));
      std::memcpy(out + i * sizeof(half), &half, sizeof(half));
    }
  }
}

/// Fills the image band by band of rows and leaves it ready for sampling.
void upload_texels(CommandQueue& queue, VkImage image, const Environment& environment, bool as_32_bit) {
  const VkDeviceSize row_bytes = environment.width * VkDeviceSize{as_32_bit ? 16U : 8U};
  const VulkanBuffer& staging = queue.staging(row_bytes * environment.height);
  const auto band_rows = static_cast<std::uint32_t>(staging.size() / row_bytes);
  queue.run([&](VkCommandBuffer commands) {
    record_layout(commands, image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
  });
  for (std::uint32_t row = 0; row < environment.height; row += band_rows) {
    const std::uint32_t rows = std::min(band_rows, environment.height - row);
    const std::span<const glm::vec3> texels(environment.texels);
    write_texels(texels.subspan(std::size_t{row} * environment.width, std::size_t{rows} * environment.width),
                 as_32_bit, staging.mapped());
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.imageOffset = {0, static_cast<std::int32_t>(row), 0};
    region.imageExtent = {environment.width, rows, 1};
    queue.run([&](VkCommandBuffer commands) {
      vkCmdCopyBufferToImage(commands, staging.get(), image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
                             &region);
    });
  }
  queue.run([&](VkCommandBuffer commands) {
    record_layout(commands, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                  VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  });
}

}  // namespace

EnvironmentTexture::EnvironmentTexture(const VulkanDevice& vulkan, CommandQueue& queue,
                                       const Environment& environment) {
  const bool as_32_bit = filters_32_bit(vulkan);
  const VkFormat format = as_32_bit ? VK_FORMAT_R32G32B32A32_SFLOAT : VK_FORMAT_R16G16B16A16_SFLOAT;
  create_image(vulkan, format, {environment.width, environment.height, 1});
  create_view_and_sampler(vulkan, format);
  upload_texels(queue, image_.get(), environment, as_32_bit);
  size_ = std::uint64_t{environment.width} * environment.height * (as_32_bit ? 16U : 8U);
}

void EnvironmentTexture::create_image(const VulkanDevice& vulkan, VkFormat format, VkExtent3D extent) {
  VkImageCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = format;
  info.extent = extent;
  info.mipLevels = 1;
  info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  VkImage image = VK_NULL_HANDLE;
  check(vkCreateImage(vulkan.device, &info, nullptr, &image), "making the environment's image");
  image_ = {vulkan.device, image};

  VkMemoryRequirements needs{};
  vkGetImageMemoryRequirements(vulkan.device, image, &needs);
  memory_ = allocate_memory(vulkan, needs, Residence::device);
  check(vkBindImageMemory(vulkan.device, image, memory_.handle.get(), 0), "binding the environment's memory");
}

void EnvironmentTexture::create_view_and_sampler(const VulkanDevice& vulkan, VkFormat format) {
  VkImageViewCreateInfo view_info{};
  view_info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
  view_info.image = image_.get();
  view_info.viewType = VK_IMAGE_VIEW_TYPE_2D;
  view_info.format = format;
  view_info.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  VkImageView view = VK_NULL_HANDLE;
  check(vkCreateImageView(vulkan.device, &view_info, nullptr, &view), "making the environment's view");
  view_ = {vulkan.device, view};

  VkSamplerCreateInfo sampler_info{};
  sampler_info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
  sampler_info.magFilter = VK_FILTER_LINEAR;
  sampler_info.minFilter = VK_FILTER_LINEAR;
  sampler_info.addressModeU = VK_SAMPLER_ADDRESS_MODE_REPEAT;
  sampler_info.addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  sampler_info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  VkSampler sampler = VK_NULL_HANDLE;
  check(vkCreateSampler(vulkan.device, &sampler_info, nullptr, &sampler), "making the environment's sampler");
  sampler_ = {vulkan.device, sampler};
}

}  // namespace splatray
