/// Compiled pipelines, kept in a file between runs: the next run's drivers need not compile them again.
#pragma once
#include <filesystem>

#include "engine/device/vulkan/handle.h"
#include "engine/device/vulkan/vulkan_device.h"

namespace splatray {

class PipelineStore {
 public:
  /// Reads what was kept for this device and driver in `folder`, which is made when it is missing; empty = none is kept. A file
  /// that is damaged, or another driver's, is not used. The device must outlive it.
  PipelineStore(const VulkanDevice& vulkan, const std::filesystem::path& folder);
  /// Writes the file where pipelines were added. One that cannot be written is left out, as it only saves time; so is one that
  /// would follow a link or replace what this class has not written.
  ~PipelineStore();
  PipelineStore(const PipelineStore&) = delete;
  PipelineStore& operator=(const PipelineStore&) = delete;

  [[nodiscard]] VkPipelineCache get() const { return cache_.get(); }
  /// Size of the driver's kept data; 0 = none was used.
  [[nodiscard]] std::size_t bytes_read() const { return bytes_read_; }

 private:
  const VulkanDevice& vulkan_;
  std::filesystem::path file_;  ///< empty = none
  std::size_t bytes_read_ = 0;
  Handle<VkPipelineCache, vkDestroyPipelineCache> cache_;
};

/// The file of a device and driver in that folder.
[[nodiscard]] std::filesystem::path pipeline_file(const std::filesystem::path& folder,
                                                  const VkPhysicalDeviceProperties& properties);

}  // namespace splatray
