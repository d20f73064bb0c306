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

Presenter::Presenter(Window& window, const VulkanDevice& vulkan)
    : window_(window),
      vulkan_(vulkan),
      queue_(vulkan, vulkan.second_queue()),
      pool_(make_command_pool(vulkan)),
      of_host_(vulkan, 0, Residence::host) {
  surface_.emplace(vulkan_.instance, window.make_surface(vulkan_.instance));
  format_ = choose_surface_format(vulkan_, surface_->get());
  pass_ = make_overlay_pass(vulkan_, format_.format);
  for (Frame& frame : frames_) {
    frame.commands = make_commands(vulkan_, pool_.get());
    frame.acquired = make_semaphore(vulkan_);
    frame.drawn = make_signalled_fence(vulkan_);
  }
  gui_.emplace(window, vulkan_, queue_, pass_.get(), [this] { finish(); });
}

Presenter::~Presenter() { vulkan_.second_queue().wait(); }

void Presenter::set_picture(std::span<const std::uint8_t> rgba, std::uint32_t width, std::uint32_t height) {
  const std::shared_ptr<DevicePicture> picture = of_host_.take(rgba.size());
  std::memcpy(picture->pixels.mapped(), rgba.data(), rgba.size());
  set_picture(picture, width, height);
}

void Presenter::set_picture(SharedPicture picture, std::uint32_t width, std::uint32_t height) {
  source_ = std::move(picture);
  if (width == size_.width && height == size_.height) return;
  finish();  // the image before may be being shown
  size_ = {width, height};
  image_ = make_image(vulkan_, size_);
  VkMemoryRequirements needs{};
  vkGetImageMemoryRequirements(vulkan_.device, image_.get(), &needs);
  memory_ = allocate_memory(vulkan_, needs, Residence::device);
  check(vkBindImageMemory(vulkan_.device, image_.get(), memory_.handle.get(), 0),
        "binding the shown picture's memory");
}

void Presenter::draw(std::uint32_t picture_width) {
  const glm::uvec2 size = window_.framebuffer_size();
  if (size.x == 0 || size.y == 0) return;
  if (size != swapchain_size_) renew_swapchain();
  Frame& frame = frames_[next_];
  wait_until_drawn(frame);
  const std::optional<std::uint32_t> index = acquire(frame);
  if (!index) return;
  record(frame, swapchain_.pictures[*index], picture_width);
  submit(frame, swapchain_.pictures[*index].drawn.get());
  next_ = (next_ + 1) % frames_.size();
  present(*index);
}

/// A picture to draw, unless the window changes right now: then the swapchain is renewed for the next time.
std::optional<std::uint32_t> Presenter::acquire(const Frame& frame) {
  if (swapchain_.pictures.empty()) {
    renew_swapchain();
    if (swapchain_.pictures.empty()) return {};
  }
  std::uint32_t index = 0;
  const VkResult result = vkAcquireNextImageKHR(vulkan_.device, swapchain_.handle.get(), UINT64_MAX,
                                                frame.acquired.get(), VK_NULL_HANDLE, &index);
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

void Presenter::record(Frame& frame, const Swapchain::Picture& target, std::uint32_t picture_width) {
  begin_commands(frame.commands);
  record_picture(frame, target.image, picture_width);
  VkRenderPassBeginInfo pass{};
  pass.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
  pass.renderPass = pass_.get();
  pass.framebuffer = target.framebuffer.get();
  pass.renderArea.extent = swapchain_.extent;
  vkCmdBeginRenderPass(frame.commands, &pass, VK_SUBPASS_CONTENTS_INLINE);
  gui_->record(frame.commands);
  vkCmdEndRenderPass(frame.commands);
  check(vkEndCommandBuffer(frame.commands), "recording the window");
}

void Presenter::record_picture(Frame& frame, VkImage target, std::uint32_t picture_width) {
  constexpr VkImageLayout SOURCE = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                          TARGET = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
  const VkCommandBuffer commands = frame.commands;
  record_layout(commands, target, VK_IMAGE_LAYOUT_UNDEFINED, TARGET);
  const VkExtent2D area{std::min(picture_width, swapchain_.extent.width), swapchain_.extent.height};
  const bool covered = size_.width > 0 && area.width == swapchain_.extent.width;
  if (!covered) {
    const VkClearColorValue dark{{0.1F, 0.1F, 0.11F, 1.0F}};
    const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    vkCmdClearColorImage(commands, target, TARGET, &dark, 1, &all);
    record_transfer_order(commands, target);
  }
  if (size_.width == 0 || area.width == 0) return;
  if (source_) {
    record_layout(commands, image_.get(), VK_IMAGE_LAYOUT_UNDEFINED, TARGET);
    const VkBufferImageCopy copy{0, 0, 0, COLOR_LAYER, {}, {size_.width, size_.height, 1}};
    vkCmdCopyBufferToImage(commands, source_->pixels.get(), image_.get(), TARGET, 1, &copy);
    record_layout(commands, image_.get(), TARGET, SOURCE);
    frame.source = std::move(source_);
  }
  const bool same = size_.width == area.width && size_.height == area.height;
  const VkImageBlit blit{COLOR_LAYER, {{}, corner(size_)}, COLOR_LAYER, {{}, corner(area)}};
  vkCmdBlitImage(commands, image_.get(), SOURCE, target, TARGET, 1, &blit,
                 same ? VK_FILTER_NEAREST : VK_FILTER_LINEAR);
}

void Presenter::submit(const Frame& frame, VkSemaphore drawn) {
  const bool waits = frame.source && frame.source->made;
  const std::array<VkSemaphore, 2> awaited = {frame.acquired.get(),
                                              waits ? frame.source->made->get() : VK_NULL_HANDLE};
  const std::array<std::uint64_t, 2> values = {0, waits ? frame.source->made_at : 0};
  const std::array<VkPipelineStageFlags, 2> copies = {VK_PIPELINE_STAGE_TRANSFER_BIT,
                                                      VK_PIPELINE_STAGE_TRANSFER_BIT};
  VkTimelineSemaphoreSubmitInfo timeline{};
  timeline.sType = VK_STRUCTURE_TYPE_TIMELINE_SEMAPHORE_SUBMIT_INFO;
  timeline.waitSemaphoreValueCount = waits ? 2 : 1;
  timeline.pWaitSemaphoreValues = values.data();
  VkSubmitInfo submit{};
  submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  submit.pNext = &timeline;
  submit.waitSemaphoreCount = timeline.waitSemaphoreValueCount;
  submit.pWaitSemaphores = awaited.data();
  submit.pWaitDstStageMask = copies.data();
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &frame.commands;
  submit.signalSemaphoreCount = 1;
  submit.pSignalSemaphores = &drawn;
  const VkFence fence = frame.drawn.get();
  check(vkResetFences(vulkan_.device, 1, &fence), "resetting the window's fence");
  check(vulkan_.second_queue().submit(submit, fence), "drawing the window");
}

void Presenter::present(std::uint32_t index) {
  const VkSemaphore drawn = swapchain_.pictures[index].drawn.get();
  const VkSwapchainKHR swapchain = swapchain_.handle.get();
  VkPresentInfoKHR info{};
  info.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR;
  info.waitSemaphoreCount = 1;
  info.pWaitSemaphores = &drawn;
  info.swapchainCount = 1;
  info.pSwapchains = &swapchain;
  info.pImageIndices = &index;
  const VkResult result = vulkan_.second_queue().present(info);
  if (result == VK_SUBOPTIMAL_KHR || result == VK_ERROR_OUT_OF_DATE_KHR ||
      result == VK_ERROR_SURFACE_LOST_KHR) {
    swapchain_size_ = {};  // renewed by the next draw
    return window_.wake();
  }
  check(result, "showing the window's picture");
}

void Presenter::renew_swapchain() {
  finish();
  swapchain_size_ = window_.framebuffer_size();
  swapchain_ =
      Swapchain(vulkan_, surface_->get(), format_, pass_.get(), swapchain_size_, swapchain_.handle.get());
}

void Presenter::wait_until_drawn(Frame& frame) {
  const VkFence fence = frame.drawn.get();
  check(vkWaitForFences(vulkan_.device, 1, &fence, VK_TRUE, UINT64_MAX), "waiting for the window");
  frame.source.reset();
}

/// Waits for all frames, and until they are shown.
void Presenter::finish() {
  check(vulkan_.second_queue().wait(), "waiting for the window");
  for (Frame& frame : frames_) wait_until_drawn(frame);
}

}  // namespace splatray
