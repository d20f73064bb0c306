#include "app/view/display/device_picture.h"

#include <algorithm>

namespace splatray {

std::shared_ptr<DevicePicture> PictureRing::take(std::uint64_t bytes) {
  const auto is_free = [](const std::shared_ptr<Place>& place) {
    return !place->taken.load(std::memory_order_acquire);  // what its last holder did with it is done
  };
  auto found = std::find_if(places_.begin(), places_.end(), is_free);
  if (found == places_.end()) found = places_.insert(found, std::make_shared<Place>());
  const std::shared_ptr<Place> place = *found;
  if (place->picture.pixels.get() == VK_NULL_HANDLE || place->picture.pixels.size() < bytes)
    place->picture.pixels = VulkanBuffer(vulkan_, bytes, usage_, residence_);
  place->taken.store(true, std::memory_order_relaxed);
  return {&place->picture,
          [place](DevicePicture* /*picture*/) { place->taken.store(false, std::memory_order_release); }};
}

}  // namespace splatray
