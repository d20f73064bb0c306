#include "app/view/window/gui.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_vulkan.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "app/view/ui/panels.h"

namespace splatray {
namespace {

void check_imgui(VkResult result) { check(result, "drawing the window's controls"); }

/// Room for the one texture of the back end, its font.
Handle<VkDescriptorPool, vkDestroyDescriptorPool> make_descriptors(const VulkanDevice& vulkan) {
  const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1};
  VkDescriptorPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  info.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
  info.maxSets = 1;
  info.poolSizeCount = 1;
  info.pPoolSizes = &size;
  VkDescriptorPool pool = VK_NULL_HANDLE;
  check(vkCreateDescriptorPool(vulkan.device, &info, nullptr, &pool), "making the controls' descriptors");
  return {vulkan.device, pool};
}

}  // namespace

Gui::Gui(Window& window, const VulkanDevice& vulkan, CommandQueue& queue, VkRenderPass pass,
         std::function<void()> finish)
    : window_(window),
      vulkan_(vulkan),
      queue_(queue),
      pass_(pass),
      finish_(std::move(finish)),
      scale_(window.content_scale()) {
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  ImGui_ImplGlfw_InitForVulkan(window.get(), true);
  start_renderer();
}

Gui::~Gui() {
  ImGui_ImplVulkan_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void Gui::start_renderer() {
  set_style(scale_);
  descriptors_ = make_descriptors(vulkan_);
  ImGui_ImplVulkan_InitInfo info{};
  info.Instance = vulkan_.instance;
  info.PhysicalDevice = vulkan_.physical_device;
  info.Device = vulkan_.device;
  info.QueueFamily = vulkan_.queue_family;
  info.Queue = vulkan_.second_queue().get();
  info.DescriptorPool = descriptors_.get();
  info.MinImageCount = FRAMES;
  info.ImageCount = FRAMES;
  info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
  info.CheckVkResultFn = check_imgui;
  ImGui_ImplVulkan_Init(&info, pass_);
  queue_.run([](VkCommandBuffer commands) { ImGui_ImplVulkan_CreateFontsTexture(commands); });
  ImGui_ImplVulkan_DestroyFontUploadObjects();
}

void Gui::begin() {
  if (const float scale = window_.content_scale(); scale != scale_) {
    scale_ = scale;
    finish_();
    ImGui_ImplVulkan_Shutdown();
    start_renderer();
  }
  ImGui_ImplVulkan_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void Gui::end() { ImGui::Render(); }

void Gui::record(VkCommandBuffer commands) {
  ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), commands);
}

double Gui::em_px() const {
  return double(ImGui::GetFontSize()) * std::max(ImGui::GetIO().DisplayFramebufferScale.y, 1.0F);
}

bool Gui::is_editing() const { return ImGui::IsAnyItemActive(); }

bool Gui::wants_mouse() const { return ImGui::GetIO().WantCaptureMouse; }

bool Gui::wants_keyboard() const { return ImGui::GetIO().WantTextInput; }

}  // namespace splatray
