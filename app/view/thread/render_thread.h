/// The thread that traces: it takes the newest document and hands over pictures, answers and sentences.
#pragma once
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "app/library/measure/measure.h"
#include "app/view/thread/live_scene.h"
#include "app/view/thread/point_cloud.h"
#include "app/view/thread/progressive.h"
#include "app/view/thread/save.h"
#include "engine/device/device.h"

namespace splatray {

/// What a person points for.
enum class PickFor {
  inspect,
  pivot,   ///< it becomes the middle of the picture
  orbit,   ///< while the button is down
  measure  ///< it becomes a point of a measure
};

/// Where in a picture of `size_px` pixels a person points.
struct PickRequest {
  glm::dvec2 position_px{0.0};
  glm::uvec2 size_px{0};
  PickFor purpose = PickFor::inspect;
};

/// What it hit; nothing on a miss.
struct Pick {
  std::optional<Inspected> inspected;
  PickFor purpose = PickFor::inspect;
  SurfacePoint point{};  ///< PickFor::measure
};

/// What of a scene opened is found with its picture.
struct Finds {
  bool exposure = false, light_at_camera = false;
  [[nodiscard]] bool any() const { return exposure || light_at_camera; }
};

/// What has come from the render thread since it was last asked.
struct RenderNews {
  SharedFrame frame;
  std::optional<Pick> pick;
  std::optional<double> exposure_ev;          ///< that suits the scene opened, where open asked for it
  std::optional<SceneLight> light_at_camera;  ///< that the scene opened needs, where open asked for it
  std::optional<Work> saving;                 ///< nothing: no picture is being saved
  std::string notice;                         ///< a sentence
  std::string error;                          ///< a sentence
};

/// All members are for one thread, the window's, and return at once.
class RenderThread {
 public:
  /// Traces with a device, which must outlive it and its frames; `shared` as Progressive has it. `wake` is called on its thread
  /// after each delivery.
  RenderThread(const Device& device, const VulkanDevice* shared, std::function<void()> wake);
  ~RenderThread();
  RenderThread(const RenderThread&) = delete;
  RenderThread& operator=(const RenderThread&) = delete;

  /// From now on shows this document of the scene opened; the newest counts.
  void show(const Document& document, glm::uvec2 window_px);
  /// As show, of another scene, or null: of the same. What it `finds` is reported behind its first picture.
  void open(SharedScene scene, const Document& document, glm::uvec2 window_px, Finds finds = {});
  /// Shows points of this document until a scene is opened; null: what was shown before, anew.
  void open_points(SharedPoints points, const Document& document, glm::uvec2 window_px);
  /// The newest counts.
  void pick(const PickRequest& request);
  void save(SaveJob job);
  void cancel_save();

  /// What is new; `saving` as it is now.
  [[nodiscard]] RenderNews poll();

 private:
  /// What the window asked for and the thread has not yet taken.
  struct Pending {
    SharedScene scene;
    std::optional<SharedPoints> points;
    std::optional<Document> document;
    glm::uvec2 window_px{0};
    Finds finds;
    std::optional<PickRequest> pick;
    std::optional<SaveJob> save;
    [[nodiscard]] bool any() const { return scene || points || document || pick || save; }
  };

  void run();
  [[nodiscard]] std::optional<Pending> wait_for_requests();
  void fulfil(const Pending& pending);
  void open_now(const Pending& pending);
  void show_points(bool others, glm::uvec2 window_px);
  void find();
  void answer(const PickRequest& request);
  void save_now(const SaveJob& job);
  void attempt_to(const char* doing, const std::function<void()>& step);
  void deliver(const std::function<void(RenderNews&)>& change);
  [[nodiscard]] bool something_waits();

  const Device& device_;
  LiveScene live_{device_};
  Progressive progressive_;
  Document shown_;       ///< by the thread
  Finds finds_;          ///< what is yet to be found of the scene
  SharedPoints points_;  ///< shown instead of the scene; null = none are
  View points_view_;     ///< in which they were drawn last
  std::function<void()> wake_;

  std::mutex mutex_;  ///< of what follows
  std::condition_variable changed_;
  Pending pending_;
  RenderNews news_;
  bool ending_ = false, cancelled_ = false;
  std::thread thread_;
};

}  // namespace splatray
