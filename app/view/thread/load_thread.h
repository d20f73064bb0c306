/// The thread that reads and preprocesses scenes.
#pragma once
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "app/library/request/request.h"
#include "app/library/shot/scene_source.h"
#include "app/view/model/document.h"
#include "app/view/thread/live_scene.h"
#include "app/view/thread/point_sampler.h"
#include "app/view/thread/scene_cache.h"

namespace splatray {

/// How far loading has come.
struct LoadProgress {
  std::string stage;   ///< "octree dragon.ply"
  double share = 0.0;  ///< of the stage, 0..1
};

/// A scene, and the document that first shows it.
struct OpenedScene {
  SharedScene scene;
  Document document;
};

/// What has come from the load thread since it was last asked.
struct LoadNews {
  std::optional<OpenedPoints> points;  ///< to look at until the scene comes
  std::optional<OpenedScene> opened;
  SharedScene refined;  ///< of the scene opened last: what the view asked for needs; null: nothing new
  std::optional<LoadProgress> progress;  ///< of what is being loaded, as it is now
  std::string notice;                    ///< sentences, one a line
  std::string error;                     ///< a sentence
};

/// All members are for one thread, the window's, and return at once; but the destructor waits for the file that is being
/// read.
class LoadThread {
 public:
  /// `wake` is called on its thread after each delivery. What took a while to make is kept in `cache`.
  explicit LoadThread(std::function<void()> wake, SceneCache cache = SceneCache({}));
  ~LoadThread();
  LoadThread(const LoadThread&) = delete;
  LoadThread& operator=(const LoadThread&) = delete;

  /// Starts to load; ends what is being loaded. The picture's size gives the aspect of the first view.
  void load(const Request& request);
  /// Starts to load what the request's picture needs of the scene in levels that was opened last; behind what is being loaded, instead of
  /// what waits to be refined.
  void refine(const Request& request);
  void cancel();
  /// What is new; `progress` as it is now.
  [[nodiscard]] LoadNews poll();

 private:
  void run();
  void load_now(const Request& asked);
  void refine_now(const Request& asked);
  [[nodiscard]] LoadListener listener_for(const Request& asked);
  [[nodiscard]] Scene made_scene(const Request& request, const LoadListener& listener, bool& worth_keeping);
  [[nodiscard]] LoadedScene load_and_show_points(const Request& request, const LoadListener& listener);
  void deliver(const std::function<void(LoadNews&)>& change);
  [[nodiscard]] bool is_cancelled();

  std::function<void()> wake_;
  SceneCache cache_;
  /// The scene opened last, of files in levels. Of the thread alone.
  struct {
    Request::Source source;
    InLevels files;
    SceneFacts facts;
    ChosenNodes shown;  ///< none: the overview
  } levels_;
  std::mutex mutex_;  ///< of what follows
  std::condition_variable changed_;
  std::optional<Request> waiting_, refining_;
  LoadNews news_;
  bool ending_ = false, cancelled_ = false;
  std::thread thread_;
};

}  // namespace splatray
