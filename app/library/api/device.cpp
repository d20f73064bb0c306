#include "app/library/api/device.h"

#include <atomic>
#include <map>

#include "app/library/api/guard.h"

namespace splatray::api {
namespace {

/// What a process has of devices. A forked one has its own: the locks of its parent may be held by threads that it lacks.
struct DeviceList {
  const pid_t process = getpid();
  std::mutex mutex;
  std::map<std::string, std::weak_ptr<SharedDevice>> devices;
  std::vector<std::shared_ptr<void>> kept_for_good;
};

DeviceList& device_list() {
  static std::atomic<DeviceList*> current = nullptr;  // never freed: scenes may outlive static objects
  DeviceList* list = current.load();
  if (list != nullptr && list->process == getpid()) return *list;
  auto own = std::make_unique<DeviceList>();
  return current.compare_exchange_strong(list, own.get()) ? *own.release() : *list;
}

}  // namespace

void SharedDevice::drop(std::unique_ptr<SceneOnDevice> scene) {
  {
    const std::lock_guard lock(dropping_);
    dropped_.push_back(std::move(scene));
  }
  free_dropped();
}

bool SharedDevice::has_dropped() {
  const std::lock_guard lock(dropping_);
  return !dropped_.empty();
}

void SharedDevice::free_dropped() {
  while (has_dropped()) {  // asked after each turn: what was dropped in it waits for its end
    const std::unique_lock turn(turn_, std::try_to_lock);
    if (!turn) return;
    std::vector<std::unique_ptr<SceneOnDevice>> now;
    const std::lock_guard lock(dropping_);
    now.swap(dropped_);
  }
}

Turn::Turn(SharedDevice& device, ProgressRelay& relay) : device_(device) {
  constexpr auto PATIENCE = std::chrono::milliseconds(50);
  while (!device.turn_.try_lock_for(PATIENCE))
    if (!relay("waiting for the device", 0.0))
      throw splatray::Error(ExitCode::interrupted, "waiting for the device was cancelled");
}

Turn::~Turn() {
  device_.turn_.unlock();
  device_.free_dropped();
}

std::shared_ptr<SharedDevice> shared_device(const std::string& wanted) {
  DeviceList& list = device_list();
  const std::lock_guard lock(list.mutex);
  std::shared_ptr<SharedDevice> device = list.devices[wanted].lock();
  if (!device) list.devices[wanted] = device = std::make_shared<SharedDevice>(wanted);
  return device;
}

void keep_for_good(std::shared_ptr<void> of_parent) {
  DeviceList& list = device_list();
  const std::lock_guard lock(list.mutex);
  list.kept_for_good.push_back(std::move(of_parent));
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
