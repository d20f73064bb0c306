#include "app/view/window/presenter.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace splatray {
namespace {

constexpr VkImageSubresourceLayers COLOR_LAYER{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};

Handle<VkFence, vkDestroyFence> make_signalled_fence(const VulkanDevice& vulkan) {
  VkFenceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  info.flags = VK_FENCE_CREATE_SIGNALED_BIT;
  VkFence fence = VK_NULL_HANDLE;
  check(vkCreateFence(vulkan.device, &info, nullptr, &fence), "making the window's fence");
  return {vulkan.device, fence};
}

VkCommandBuffer make_commands(const VulkanDevice& vulkan) {
  VkCommandBufferAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  info.commandPool = vulkan.command_pool;
  info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  info.commandBufferCount = 1;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  check(vkAllocateCommandBuffers(vulkan.device, &info, &commands), "making the window's command buffer");
  return commands;
}

Handle<VkImage, vkDestroyImage> make_image(const VulkanDevice& vulkan, VkExtent2D size) {
  VkImageCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = VK_FORMAT_R8G8B8A8_UNORM;
  info.extent = {size.width, size.height, 1};
  info.mipLevels = 1;
  info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  VkImage image = VK_NULL_HANDLE;
  check(vkCreateImage(vulkan.device, &info, nullptr, &image), "making the shown picture");
  return {vulkan.device, image};
}

/// Orders clears and copies of the same image.
void record_transfer_order(VkCommandBuffer commands, VkImage image) {
  record_layout(commands, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
}

VkOffset3D corner(VkExtent2D size) {
  return {static_cast<std::int32_t>(size.width), static_cast<std::int32_t>(size.height), 1};
}

}  // namespace

Presenter::Presenter(Window& window) : window_(window), vulkan_("", false, window.needs()), queue_(vulkan_) {
  surface_.emplace(vulkan_.instance, window.make_surface(vulkan_.instance));
  format_ = choose_surface_format(vulkan_, surface_->get());
  pass_ = make_overlay_pass(vulkan_, format_.format);
  acquired_ = make_semaphore(vulkan_);
  drawn_ = make_signalled_fence(vulkan_);
  commands_ = make_commands(vulkan_);
  gui_.emplace(window, vulkan_, queue_, pass_.get());
}

Presenter::~Presenter() { vkDeviceWaitIdle(vulkan_.device); }

void Presenter::set_picture(std::span<const std::uint8_t> rgba, std::uint32_t width, std::uint32_t height) {
  wait_until_drawn();
  if (width != size_.width || height != size_.height) {
    size_ = {width, height};
    picture_ = make_image(vulkan_, size_);
    VkMemoryRequirements needs{};
    vkGetImageMemoryRequirements(vulkan_.device, picture_.get(), &needs);
    memory_ = allocate_memory(vulkan_, needs, Residence::device);
    check(vkBindImageMemory(vulkan_.device, picture_.get(), memory_.handle.get(), 0),
          "binding the shown picture's memory");
    if (pixels_.size() < rgba.size()) pixels_ = VulkanBuffer(vulkan_, rgba.size(), 0, Residence::host);
  }
  std::memcpy(pixels_.mapped(), rgba.data(), rgba.size());
  copied_ = false;
}

void Presenter::draw(std::uint32_t picture_width) {
  const glm::uvec2 size = window_.framebuffer_size();
  if (size.x == 0 || size.y == 0) return;
  if (size != swapchain_size_) renew_swapchain();
  wait_until_drawn();
  const std::optional<std::uint32_t> index = acquire();
  if (!index) return;
  record(swapchain_.pictures[*index], picture_width);
  submit_and_present(*index);
}

/// A picture to draw, unless the window changes right now: then the swapchain is renewed for the next time.
std::optional<std::uint32_t> Presenter::acquire() {
  if (swapchain_.pictures.empty()) {
    renew_swapchain();
    if (swapchain_.pictures.empty()) return {};
  }
  std::uint32_t index = 0;
  const VkResult result = vkAcquireNextImageKHR(vulkan_.device, swapchain_.handle.get(), UINT64_MAX,
                                                acquired_.get(), VK_NULL_HANDLE, &index);
  if (result == VK_ERROR_SURFACE_LOST_KHR) {
    swapchain_ = {};
    surface_.reset();
    surface_.emplace(vulkan_.instance, window_.make_surface(vulkan_.instance));
  }
  if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_ERROR_SURFACE_LOST_KHR) {
    renew_swapchain();
    window_.wake();
    return {};
  }
  if (result != VK_SUBOPTIMAL_KHR) check(result, "taking a picture of the window");
  return index;
}

void Presenter::record(const Swapchain::Picture& target, std::uint32_t picture_width) {
  VkCommandBufferBeginInfo begin{};
  begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkBeginCommandBuffer(commands_, &begin), "recording the window");
  record_picture(target.image, picture_width);
  VkRenderPassBeginInfo pass{};
  pass.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
  pass.renderPass = pass_.get();
  pass.framebuffer = target.framebuffer.get();
  pass.renderArea.extent = swapchain_.extent;
  vkCmdBeginRenderPass(commands_, &pass, VK_SUBPASS_CONTENTS_INLINE);
  gui_->record(commands_);
  vkCmdEndRenderPass(commands_);
  check(vkEndCommandBuffer(commands_), "recording the window");
}

void Presenter::record_picture(VkImage target, std::uint32_t picture_width) {
  constexpr VkImageLayout SOURCE = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                          TARGET = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
  record_layout(commands_, target, VK_IMAGE_LAYOUT_UNDEFINED, TARGET);
  const VkExtent2D area{std::min(picture_width, swapchain_.extent.width), swapchain_.extent.height};
  const bool covered = size_.width > 0 && area.width == swapchain_.extent.width;
  if (!covered) {
    const VkClearColorValue dark{{0.1F, 0.1F, 0.11F, 1.0F}};
    const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    vkCmdClearColorImage(commands_, target, TARGET, &dark, 1, &all);
    record_transfer_order(commands_, target);
  }
  if (size_.width == 0 || area.width == 0) return;
  if (!copied_) {
    record_layout(commands_, picture_.get(), VK_IMAGE_LAYOUT_UNDEFINED, TARGET);
    const VkBufferImageCopy copy{0, 0, 0, COLOR_LAYER, {}, {size_.width, size_.height, 1}};
    vkCmdCopyBufferToImage(commands_, pixels_.get(), picture_.get(), TARGET, 1, &copy);
    record_layout(commands_, picture_.get(), TARGET, SOURCE);
    copied_ = true;
  }
  const bool same = size_.width == area.width && size_.height == area.height;
  const VkImageBlit blit{COLOR_LAYER, {{}, corner(size_)}, COLOR_LAYER, {{}, corner(area)}};
  vkCmdBlitImage(commands_, picture_.get(), SOURCE, target, TARGET, 1, &blit,
                 same ? VK_FILTER_NEAREST : VK_FILTER_LINEAR);
}

void Presenter::submit_and_present(std::uint32_t index) {
  const VkSemaphore acquired = acquired_.get(), drawn = swapchain_.pictures[index].drawn.get();
  const VkPipelineStageFlags writes = VK_PIPELINE_STAGE_TRANSFER_BIT;
  VkSubmitInfo submit{};
  submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  submit.waitSemaphoreCount = 1;
  submit.pWaitSemaphores = &acquired;
  submit.pWaitDstStageMask = &writes;
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands_;
  submit.signalSemaphoreCount = 1;
  submit.pSignalSemaphores = &drawn;
  const VkFence fence = drawn_.get();
  check(vkResetFences(vulkan_.device, 1, &fence), "resetting the window's fence");
  check(vkQueueSubmit(vulkan_.queue, 1, &submit, fence), "drawing the window");

  const VkSwapchainKHR swapchain = swapchain_.handle.get();
  VkPresentInfoKHR present{};
  present.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR;
  present.waitSemaphoreCount = 1;
  present.pWaitSemaphores = &drawn;
  present.swapchainCount = 1;
  present.pSwapchains = &swapchain;
  present.pImageIndices = &index;
  const VkResult result = vkQueuePresentKHR(vulkan_.queue, &present);
  if (result == VK_SUBOPTIMAL_KHR || result == VK_ERROR_OUT_OF_DATE_KHR ||
      result == VK_ERROR_SURFACE_LOST_KHR) {
    swapchain_size_ = {};  // renewed by the next draw
    return window_.wake();
  }
  check(result, "showing the window's picture");
}

void Presenter::renew_swapchain() {
  check(vkDeviceWaitIdle(vulkan_.device), "waiting for the window");
  swapchain_size_ = window_.framebuffer_size();
  swapchain_ =
      Swapchain(vulkan_, surface_->get(), format_, pass_.get(), swapchain_size_, swapchain_.handle.get());
}

void Presenter::wait_until_drawn() {
  const VkFence fence = drawn_.get();
  check(vkWaitForFences(vulkan_.device, 1, &fence, VK_TRUE, UINT64_MAX), "waiting for the window");
}

}  // namespace splatray
