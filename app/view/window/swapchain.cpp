#include "app/view/window/swapchain.h"

#include <algorithm>

#include "engine/base/error.h"

namespace splatray {
namespace {

/// What the surface says its size is, else `size` within its limits.
VkExtent2D choose_extent(const VkSurfaceCapabilitiesKHR& surface, glm::uvec2 size) {
  if (surface.currentExtent.width != UINT32_MAX) return surface.currentExtent;
  return {std::clamp(size.x, surface.minImageExtent.width, surface.maxImageExtent.width),
          std::clamp(size.y, surface.minImageExtent.height, surface.maxImageExtent.height)};
}

std::uint32_t choose_image_count(const VkSurfaceCapabilitiesKHR& surface) {
  const std::uint32_t wanted = std::max(surface.minImageCount, 3U);
  return surface.maxImageCount > 0 ? std::min(wanted, surface.maxImageCount) : wanted;
}

VkCompositeAlphaFlagBitsKHR choose_alpha(const VkSurfaceCapabilitiesKHR& surface) {
  return (surface.supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR) != 0
             ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
             : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
}

Handle<VkImageView, vkDestroyImageView> make_view(const VulkanDevice& vulkan, VkImage image,
                                                  VkFormat format) {
  VkImageViewCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
  info.image = image;
  info.viewType = VK_IMAGE_VIEW_TYPE_2D;
  info.format = format;
  info.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  VkImageView view = VK_NULL_HANDLE;
  check(vkCreateImageView(vulkan.device, &info, nullptr, &view), "making a view of the window's picture");
  return {vulkan.device, view};
}

}  // namespace

VkSurfaceFormatKHR choose_surface_format(const VulkanDevice& vulkan, VkSurfaceKHR surface) {
  std::uint32_t count = 0;
  check(vkGetPhysicalDeviceSurfaceFormatsKHR(vulkan.physical_device, surface, &count, nullptr),
        "listing the window's formats");
  std::vector<VkSurfaceFormatKHR> formats(count);
  check(vkGetPhysicalDeviceSurfaceFormatsKHR(vulkan.physical_device, surface, &count, formats.data()),
        "listing the window's formats");
  for (const VkFormat wanted : {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM})
    for (const VkSurfaceFormatKHR& format : formats)
      if (format.format == wanted && format.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR) return format;
  throw Error(ExitCode::no_device,
              "the display takes no sRGB pictures of 8 bits a channel, which the window needs; "
              "splatray-render writes pictures without one");
}

Handle<VkRenderPass, vkDestroyRenderPass> make_overlay_pass(const VulkanDevice& vulkan, VkFormat format) {
  VkAttachmentDescription attachment{};
  attachment.format = format;
  attachment.samples = VK_SAMPLE_COUNT_1_BIT;
  attachment.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
  attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  attachment.initialLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
  attachment.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
  const VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  VkSubpassDescription subpass{};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = 1;
  subpass.pColorAttachments = &color;
  VkSubpassDependency after_copy{};
  after_copy.srcSubpass = VK_SUBPASS_EXTERNAL;
  after_copy.srcStageMask = VK_PIPELINE_STAGE_TRANSFER_BIT;
  after_copy.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  after_copy.dstStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
  after_copy.dstAccessMask = VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
  VkRenderPassCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
  info.attachmentCount = 1;
  info.pAttachments = &attachment;
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  info.dependencyCount = 1;
  info.pDependencies = &after_copy;
  VkRenderPass pass = VK_NULL_HANDLE;
  check(vkCreateRenderPass(vulkan.device, &info, nullptr, &pass), "making the window's render pass");
  return {vulkan.device, pass};
}

Swapchain::Swapchain(const VulkanDevice& vulkan, VkSurfaceKHR surface, VkSurfaceFormatKHR format,
                     VkRenderPass pass, glm::uvec2 size, VkSwapchainKHR old) {
  VkSurfaceCapabilitiesKHR capabilities{};
  check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(vulkan.physical_device, surface, &capabilities),
        "asking what the window can show");
  extent = choose_extent(capabilities, size);
  if (extent.width == 0 || extent.height == 0) return;
  VkSwapchainCreateInfoKHR info{};
  info.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR;
  info.surface = surface;
  info.minImageCount = choose_image_count(capabilities);
  info.imageFormat = format.format;
  info.imageColorSpace = format.colorSpace;
  info.imageExtent = extent;
  info.imageArrayLayers = 1;
  info.imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
  info.preTransform = capabilities.currentTransform;
  info.compositeAlpha = choose_alpha(capabilities);
  info.presentMode = VK_PRESENT_MODE_FIFO_KHR;
  info.clipped = VK_TRUE;
  info.oldSwapchain = old;
  VkSwapchainKHR swapchain = VK_NULL_HANDLE;
  check(vkCreateSwapchainKHR(vulkan.device, &info, nullptr, &swapchain), "making the window's swapchain");
  handle = {vulkan.device, swapchain};
  make_pictures(vulkan, format.format, pass);
}

void Swapchain::make_pictures(const VulkanDevice& vulkan, VkFormat format, VkRenderPass pass) {
  std::uint32_t count = 0;
  check(vkGetSwapchainImagesKHR(vulkan.device, handle.get(), &count, nullptr),
        "listing the window's pictures");
  std::vector<VkImage> images(count);
  check(vkGetSwapchainImagesKHR(vulkan.device, handle.get(), &count, images.data()),
        "listing the window's pictures");
  for (VkImage image : images) {
    Picture picture{image, make_view(vulkan, image, format), {}, make_semaphore(vulkan)};
    const VkImageView view = picture.view.get();
    VkFramebufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    info.renderPass = pass;
    info.attachmentCount = 1;
    info.pAttachments = &view;
    info.width = extent.width;
    info.height = extent.height;
    info.layers = 1;
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    check(vkCreateFramebuffer(vulkan.device, &info, nullptr, &framebuffer),
          "making the window's framebuffer");
    picture.framebuffer = {vulkan.device, framebuffer};
    pictures.push_back(std::move(picture));
  }
}

Handle<VkSemaphore, vkDestroySemaphore> make_semaphore(const VulkanDevice& vulkan) {
  VkSemaphoreCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
  VkSemaphore semaphore = VK_NULL_HANDLE;
  check(vkCreateSemaphore(vulkan.device, &info, nullptr, &semaphore), "making a semaphore");
  return {vulkan.device, semaphore};
}

}  // namespace splatray
