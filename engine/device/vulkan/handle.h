/// Ownership of a Vulkan object.
#pragma once
#include <utility>

#include "engine/device/vulkan/functions.h"

namespace splatray {

/// Move-only owner of a Vulkan object that `Destroy` (a vkDestroy... or vkFree... of a device) ends.
template <typename T, auto Destroy>
class Handle {
 public:
  Handle() = default;
  /// Takes over `handle`, an object of `device`, which must outlive this.
  Handle(VkDevice device, T handle) : device_(device), handle_(handle) {}
  ~Handle() {
    if (handle_ != VK_NULL_HANDLE) Destroy(device_, handle_, nullptr);
  }
  Handle(Handle&& other) noexcept
      : device_(other.device_), handle_(std::exchange(other.handle_, T{VK_NULL_HANDLE})) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(handle_, other.handle_);
    return *this;
  }

  /// The object, or VK_NULL_HANDLE.
  [[nodiscard]] T get() const { return handle_; }

 private:
  VkDevice device_ = VK_NULL_HANDLE;
  T handle_ = VK_NULL_HANDLE;
};

}  // namespace splatray
