#include "app/view/window/view_devices.h"

namespace splatray {

ViewDevices::ViewDevices(const std::string& wanted, const Window& window) {
  DeviceNeeds needs = window.needs();
  needs.optional = true;
  tracing_ = open_device(wanted, needs);
  const auto* traces = dynamic_cast<const VulkanDevice*>(tracing_.get());
  if (traces == nullptr || !traces->meets_needs())
    own_ = std::make_unique<VulkanDevice>("", false, window.needs());
  showing_ = own_ ? own_.get() : traces;
}

std::uint32_t ViewDevices::validation_messages() const {
  return tracing_->validation_messages() + (own_ ? own_->validation_messages() : 0);
}

}  // namespace splatray
