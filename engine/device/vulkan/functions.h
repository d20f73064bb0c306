/// Vulkan's functions, found in the loader's library when the first of them is called: programs and modules that hold the engine
/// start, and do all that needs no device, on systems without Vulkan. The names are those of vulkan.h, which they hide in this
/// namespace.
#pragma once
#include <vulkan/vulkan.h>

#include <cstddef>

namespace splatray {

/// Every function that the engine or the viewer calls.
#define SPLATRAY_VULKAN_FUNCTIONS(FUNCTION)           \
  FUNCTION(vkAcquireNextImageKHR)                     \
  FUNCTION(vkAllocateCommandBuffers)                  \
  FUNCTION(vkAllocateDescriptorSets)                  \
  FUNCTION(vkAllocateMemory)                          \
  FUNCTION(vkBeginCommandBuffer)                      \
  FUNCTION(vkBindBufferMemory)                        \
  FUNCTION(vkBindImageMemory)                         \
  FUNCTION(vkCmdBeginRenderPass)                      \
  FUNCTION(vkCmdBindDescriptorSets)                   \
  FUNCTION(vkCmdBindPipeline)                         \
  FUNCTION(vkCmdBlitImage)                            \
  FUNCTION(vkCmdClearColorImage)                      \
  FUNCTION(vkCmdCopyBuffer)                           \
  FUNCTION(vkCmdCopyBufferToImage)                    \
  FUNCTION(vkCmdDispatch)                             \
  FUNCTION(vkCmdEndRenderPass)                        \
  FUNCTION(vkCmdFillBuffer)                           \
  FUNCTION(vkCmdPipelineBarrier)                      \
  FUNCTION(vkCmdResetQueryPool)                       \
  FUNCTION(vkCmdUpdateBuffer)                         \
  FUNCTION(vkCmdWriteTimestamp)                       \
  FUNCTION(vkCreateBuffer)                            \
  FUNCTION(vkCreateBufferView)                        \
  FUNCTION(vkCreateCommandPool)                       \
  FUNCTION(vkCreateComputePipelines)                  \
  FUNCTION(vkCreateDescriptorPool)                    \
  FUNCTION(vkCreateDescriptorSetLayout)               \
  FUNCTION(vkCreateDevice)                            \
  FUNCTION(vkCreateFence)                             \
  FUNCTION(vkCreateFramebuffer)                       \
  FUNCTION(vkCreateImage)                             \
  FUNCTION(vkCreateImageView)                         \
  FUNCTION(vkCreateInstance)                          \
  FUNCTION(vkCreatePipelineCache)                     \
  FUNCTION(vkCreatePipelineLayout)                    \
  FUNCTION(vkCreateQueryPool)                         \
  FUNCTION(vkCreateRenderPass)                        \
  FUNCTION(vkCreateSampler)                           \
  FUNCTION(vkCreateSemaphore)                         \
  FUNCTION(vkCreateShaderModule)                      \
  FUNCTION(vkCreateSwapchainKHR)                      \
  FUNCTION(vkDestroyBuffer)                           \
  FUNCTION(vkDestroyBufferView)                       \
  FUNCTION(vkDestroyCommandPool)                      \
  FUNCTION(vkDestroyDescriptorPool)                   \
  FUNCTION(vkDestroyDescriptorSetLayout)              \
  FUNCTION(vkDestroyDevice)                           \
  FUNCTION(vkDestroyFence)                            \
  FUNCTION(vkDestroyFramebuffer)                      \
  FUNCTION(vkDestroyImage)                            \
  FUNCTION(vkDestroyImageView)                        \
  FUNCTION(vkDestroyInstance)                         \
  FUNCTION(vkDestroyPipeline)                         \
  FUNCTION(vkDestroyPipelineCache)                    \
  FUNCTION(vkDestroyPipelineLayout)                   \
  FUNCTION(vkDestroyQueryPool)                        \
  FUNCTION(vkDestroyRenderPass)                       \
  FUNCTION(vkDestroySampler)                          \
  FUNCTION(vkDestroySemaphore)                        \
  FUNCTION(vkDestroyShaderModule)                     \
  FUNCTION(vkDestroySurfaceKHR)                       \
  FUNCTION(vkDestroySwapchainKHR)                     \
  FUNCTION(vkEndCommandBuffer)                        \
  FUNCTION(vkEnumerateInstanceLayerProperties)        \
  FUNCTION(vkEnumeratePhysicalDevices)                \
  FUNCTION(vkFreeMemory)                              \
  FUNCTION(vkGetBufferMemoryRequirements)             \
  FUNCTION(vkGetDeviceQueue)                          \
  FUNCTION(vkGetImageMemoryRequirements)              \
  FUNCTION(vkGetInstanceProcAddr)                     \
  FUNCTION(vkGetPhysicalDeviceFeatures)               \
  FUNCTION(vkGetPhysicalDeviceFormatProperties)       \
  FUNCTION(vkGetPhysicalDeviceMemoryProperties)       \
  FUNCTION(vkGetPhysicalDeviceProperties)             \
  FUNCTION(vkGetPhysicalDeviceProperties2)            \
  FUNCTION(vkGetPhysicalDeviceQueueFamilyProperties)  \
  FUNCTION(vkGetPhysicalDeviceSurfaceCapabilitiesKHR) \
  FUNCTION(vkGetPhysicalDeviceSurfaceFormatsKHR)      \
  FUNCTION(vkGetPipelineCacheData)                    \
  FUNCTION(vkGetQueryPoolResults)                     \
  FUNCTION(vkGetSwapchainImagesKHR)                   \
  FUNCTION(vkMapMemory)                               \
  FUNCTION(vkQueuePresentKHR)                         \
  FUNCTION(vkQueueSubmit)                             \
  FUNCTION(vkQueueWaitIdle)                           \
  FUNCTION(vkResetCommandBuffer)                      \
  FUNCTION(vkResetFences)                             \
  FUNCTION(vkUpdateDescriptorSets)                    \
  FUNCTION(vkWaitForFences)                           \
  FUNCTION(vkWaitSemaphores)

/// The place of each function in a table.
enum class VulkanFunctionNumber : std::size_t {
#define SPLATRAY_NUMBER(name) name,
  SPLATRAY_VULKAN_FUNCTIONS(SPLATRAY_NUMBER)
#undef SPLATRAY_NUMBER
};

/// Whether the loader's library and all functions in it were found.
[[nodiscard]] bool vulkan_is_installed();

/// Throws Error (no_device) in a process that was forked off by one that had loaded the loader: drivers keep threads and locks,
/// which no fork copies. Whoever makes an instance asks first.
void refuse_vulkan_of_parent();

/// The function itself. Throws Error (no_device), which names Debian's packages, where there is no loader.
[[nodiscard]] PFN_vkVoidFunction vulkan_function(VulkanFunctionNumber number);

template <typename Pointer, VulkanFunctionNumber NUMBER>
struct VulkanFunction;

/// Called as the function is.
template <typename Result, typename... Arguments, VulkanFunctionNumber NUMBER>
struct VulkanFunction<Result(VKAPI_PTR*)(Arguments...), NUMBER> {
  Result operator()(Arguments... arguments) const {
    return reinterpret_cast<Result(VKAPI_PTR*)(Arguments...)>(vulkan_function(NUMBER))(arguments...);
  }
};

#define SPLATRAY_FUNCTION(name) inline constexpr VulkanFunction<PFN_##name, VulkanFunctionNumber::name> name;
SPLATRAY_VULKAN_FUNCTIONS(SPLATRAY_FUNCTION)
#undef SPLATRAY_FUNCTION

}  // namespace splatray
