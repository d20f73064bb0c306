#include "app/library/api/device.h"

#include <map>

#include "app/library/api/guard.h"

namespace splatray::api {

std::shared_ptr<SharedDevice> shared_device(const std::string& wanted) {
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<SharedDevice>> devices;
  const std::lock_guard lock(mutex);
  std::shared_ptr<SharedDevice> device = devices[wanted].lock();
  if (!device) devices[wanted] = device = std::make_shared<SharedDevice>(wanted);
  return device;
}

std::vector<Device> devices() {
  return guarded([] {
    std::vector<Device> found;
    for (const DeviceInfo& info : list_devices())
      found.push_back({info.name, info.type, info.driver, info.refused});
    return found;
  });
}

std::string version() { return SPLATRAY_VERSION; }

}  // namespace splatray::api
