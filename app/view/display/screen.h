/// Makes of a picture on a Vulkan device what a screen takes, without bringing it to the host.
#pragma once
#include <future>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "app/library/shot/scene_on_device.h"
#include "app/view/display/device_picture.h"
#include "app/view/display/display_table.h"
#include "engine/device/vulkan/command_queue.h"
#include "engine/device/vulkan/descriptor_set.h"
#include "engine/device/vulkan/device_filter.h"
#include "engine/image/image.h"
#include "engine/image/view.h"
#include "shaders/display/display_layout.h"

namespace splatray {

/// How a picture is shown.
struct ShownAs {
  const DisplayTable& table;
  const View& view;       ///< of the whole picture
  bool moving = false;    ///< else it is one at rest, whose brightness is remembered
  bool is_seen = false;   ///< of LOOK_SEEN, as MovingPicture has it
  double eye_dome = 0.0;  ///< strength, as eye_dome has it
};

/// The device's side of DisplayTable and MovingPicture (display.comp.glsl). For one thread, that of the queue which traces.
class Screen {
 public:
  /// The device must outlive it and its pictures.
  explicit Screen(const VulkanDevice& vulkan);
  /// Waits for the device.
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  /// Begins to build the programs of a tone curve on another thread: show() then waits for less.
  void prepare(Tone tone);
  /// A picture that the device grew: within 1 of 255 of what DisplayTable and MovingPicture make of it. The device may still be at
  /// it when it is handed out. Throws Error as check() does.
  [[nodiscard]] SharedPicture show(const GrownPicture& grown, const ShownAs& how);
  /// Likewise of one that the host has changed, which is brought to the device.
  [[nodiscard]] SharedPicture show(const Image& image, const ShownAs& how);
  /// Keeps a picture as Image::part of what is filtered next.
  void keep(const GrownPicture& part);
  /// Has the device take the noise out of a picture (device_filter.h); `part_share`: of its samples, that are in what was kept.
  void filter(const GrownPicture& grown, float part_share, const DeviceGuide& guide);
  /// As show, what was filtered last.
  [[nodiscard]] SharedPicture show_filtered(const ShownAs& how);
  /// Whether the picture shown last has pixels whose loops a driver has cut: Tracer::picture() says so.
  [[nodiscard]] bool has_cut_loops();
  /// Waits until the device has read what it was given: before that changes other than by work of its queue.
  void wait();
  /// Forgets how bright pictures at rest are: another scene is shown.
  void forget();

 private:
  /// A step, DISPLAY_PLAIN and its like, and a tone curve, DISPLAY_TONE_*.
  using ProgramKey = std::pair<std::uint32_t, std::uint32_t>;
  using Program = Handle<VkPipeline, vkDestroyPipeline>;

  VkResult wait_for_last() const;
  void take_curve(const DisplayTable& table);
  [[nodiscard]] Program build(const ProgramKey& key) const;
  /// Built when it is the first such.
  [[nodiscard]] VkPipeline program(const ProgramKey& key);
  void record_step(std::uint32_t step, std::uint32_t pixels, const DisplayTable& table);
  void record(const DisplayParams& params, const ShownAs& how);
  void submit();

  const VulkanDevice& vulkan_;
  CommandQueue transfers_;
  DescriptorSet set_;
  std::map<ProgramKey, Program> programs_;
  std::future<std::map<ProgramKey, Program>> begun_;  ///< on another thread
  Handle<VkCommandPool, vkDestroyCommandPool> pool_;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  VulkanBuffer params_, curves_, state_, means_;  ///< means_: of an image of the host
  std::optional<DeviceFilter> filter_;            ///< made when it is first needed
  GrownPicture filtered_;                         ///< its result
  PictureRing ring_;
  std::shared_ptr<const TimelineSemaphore> made_;
  std::uint64_t made_at_ = 0;     ///< value of made_ when all that was submitted is done
  std::optional<Display> curve_;  ///< that curves_ holds
  bool rests_ = false;  ///< the last picture at rest has not yet given the gain of those of LOOK_SEEN
};

}  // namespace splatray
