/// The host's CPU as a device: buffers are host memory, programs C++ (engine/cpu); without Vulkan.
#pragma once
#include "engine/device/device.h"

namespace splatray {

class HostDevice final : public Device {
 public:
  [[nodiscard]] const DeviceInfo& info() const override;
  [[nodiscard]] const DeviceLimits& limits() const override;
  [[nodiscard]] DeviceProfile profile() const override;
  [[nodiscard]] std::unique_ptr<Queue> make_queue(const QueueOptions& options = {}) const override;
};

}  // namespace splatray
