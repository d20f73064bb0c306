#include "app/view/display/device_picture.h"

#include <algorithm>
#include <atomic>

namespace splatray {

std::shared_ptr<DevicePicture> PictureRing::take(std::uint64_t bytes) {
  const auto is_free = [](const std::shared_ptr<DevicePicture>& picture) { return picture.use_count() == 1; };
  auto found = std::find_if(pictures_.begin(), pictures_.end(), is_free);
  if (found == pictures_.end()) found = pictures_.insert(found, std::make_shared<DevicePicture>());
  std::atomic_thread_fence(std::memory_order_acquire);  // what its last holder did with it is done
  DevicePicture& picture = **found;
  if (picture.pixels.get() == VK_NULL_HANDLE || picture.pixels.size() < bytes)
    picture.pixels = VulkanBuffer(vulkan_, bytes, usage_, residence_);
  return *found;
}

}  // namespace splatray
