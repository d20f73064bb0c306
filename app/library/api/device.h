/// Devices of the interface's scenes.
#pragma once
#include <memory>
#include <mutex>
#include <string>

#include "engine/vulkan/context.h"

namespace splatray::api {

/// A device and its turn-taking: its queue and command pool take one thread at a time.
struct SharedDevice {
  explicit SharedDevice(const std::string& wanted) : context(wanted) {}
  Context context;
  std::mutex turn;
};

/// The device for `wanted` (Context::Context), one for all scenes that live. Throws splatray::Error (no_device).
[[nodiscard]] std::shared_ptr<SharedDevice> shared_device(const std::string& wanted);

}  // namespace splatray::api
