/// Devices of the interface's scenes.
#pragma once
#include <unistd.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "app/library/api/guard.h"
#include "app/library/shot/scene_on_device.h"
#include "engine/device/device.h"

namespace splatray::api {

/// A device and its turn-taking: its queue and command pool take one thread at a time.
class SharedDevice {
 public:
  explicit SharedDevice(const std::string& wanted) : device(open_device(wanted)) {}

  /// Whether it was opened before this process was forked off: its threads and locks are another's, so that it can neither be
  /// used nor closed here.
  [[nodiscard]] bool is_of_parent() const { return process_ != getpid(); }
  /// Ends a scene's place in this turn or, where another thread has it, at that one's end: no one waits.
  void drop(std::unique_ptr<SceneOnDevice> scene);

  const std::unique_ptr<splatray::Device> device;

 private:
  friend class Turn;
  void free_dropped();
  [[nodiscard]] bool has_dropped();

  const pid_t process_ = getpid();
  std::recursive_timed_mutex turn_;  ///< recursive: a progress function may use other scenes
  std::mutex dropping_;
  std::vector<std::unique_ptr<SceneOnDevice>> dropped_;
};

/// Has the device to itself while it lives.
class Turn {
 public:
  /// Waits; asks `relay` meanwhile whether to go on, and throws splatray::Error (interrupted) when not.
  Turn(SharedDevice& device, ProgressRelay& relay);
  ~Turn();
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  SharedDevice& device_;
};

/// The device for `wanted` (open_device), one for all scenes of this process that live. Throws splatray::Error (no_device).
[[nodiscard]] std::shared_ptr<SharedDevice> shared_device(const std::string& wanted);

/// Keeps what a forked process has of its parent's devices, for as long as it runs.
void keep_for_good(std::shared_ptr<void> of_parent);

}  // namespace splatray::api
