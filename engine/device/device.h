/// The door to what can trace: Vulkan's devices (engine/device/vulkan) and the host's CPU (engine/device/host), behind one
/// interface.
#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/device/device_profile.h"
#include "engine/device/queue.h"

namespace splatray {

/// What a user sees of a device.
struct DeviceInfo {
  std::string name;
  std::string type;     ///< "discrete GPU", "integrated GPU", "virtual GPU", "CPU", "other"
  std::string driver;   ///< name and version string of the driver
  std::string api;      ///< "1.3.230"
  std::string refused;  ///< why it cannot be used; empty = usable
};

/// What a device allows.
struct DeviceLimits {
  std::uint64_t storage_bytes = 0;     ///< largest storage buffer
  std::uint64_t allocation_bytes = 0;  ///< largest allocation
  std::uint32_t storage_buffers = 0;   ///< most storage buffers of a program for pools
  std::uint32_t texture_size = 0;      ///< most texels of a texture, across and down
};

struct QueueOptions {
  /// Where compiled programs are kept between runs; empty = nowhere.
  std::filesystem::path pipeline_folder{};
  unsigned threads = 0;  ///< of the host; 0 = one a core
  /// Most bits of the vectors that the host's tree is walked with (wide_functions).
  std::uint32_t vector_bits = UINT32_MAX;
};

/// What a program needs of Vulkan's devices beside what the engine does (vulkan/vulkan_device.h).
struct DeviceNeeds;

class Device {
 public:
  Device() = default;
  virtual ~Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  [[nodiscard]] virtual const DeviceInfo& info() const = 0;
  [[nodiscard]] virtual const DeviceLimits& limits() const = 0;
  /// How much it is given to do.
  [[nodiscard]] virtual DeviceProfile profile() const = 0;
  /// The device must outlive it.
  [[nodiscard]] virtual std::unique_ptr<Queue> make_queue(const QueueOptions& options = {}) const = 0;
  /// Messages of Vulkan's validation layers so far; from any thread.
  [[nodiscard]] virtual std::uint32_t validation_messages() const { return 0; }
};

/// What a user asks for who wants no Vulkan device but the host's CPU (engine/cpu).
inline constexpr const char* HOST_DEVICE = "cpu";

/// The device that a user asks for: "" = Vulkan's best GPU (discrete > integrated > virtual > other), or the host where
/// Vulkan has none, a number of list_devices, or part of a name (case-insensitive); HOST_DEVICE = no Vulkan, which is then not
/// even loaded. One of Vulkan's is given what `wishes` asks for where it has it. Throws Error (no_device) with every device's
/// reason when none fits.
[[nodiscard]] std::unique_ptr<Device> open_device(const std::string& wanted);
[[nodiscard]] std::unique_ptr<Device> open_device(const std::string& wanted, const DeviceNeeds& wishes);

/// All Vulkan devices, usable or not, in the order of their numbers. Empty when there is no Vulkan loader's driver
/// at all.
[[nodiscard]] std::vector<DeviceInfo> list_devices();

}  // namespace splatray
