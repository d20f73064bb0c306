/// The picture of a document: coarse while it changes, then ever finer, at its end without noise as a saved one is.
#pragma once
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <optional>

#include "app/view/display/display_table.h"
#include "app/view/display/moving_picture.h"
#include "app/view/display/screen.h"
#include "app/view/model/document.h"
#include "app/view/model/frame.h"
#include "app/view/thread/live_scene.h"
#include "app/view/thread/resolution.h"

namespace splatray {

/// A frame that threads share.
using SharedFrame = std::shared_ptr<const Frame>;

/// On the render thread. The live scene must outlive it.
class Progressive {
 public:
  using Clock = std::chrono::steady_clock;

  /// `device`: its name. `shared`: the live scene's, where it also shows pictures, which then stay there; else null, and they are
  /// brought to the host. It must outlive this and the frames. `filters_there`: whether our own filter runs on that; by default where it
  /// is not the host's own processor.
  Progressive(LiveScene& live, std::string device, const VulkanDevice* shared = nullptr,
              std::optional<bool> filters_there = {});

  /// Shows this from now on, in a window of `window_px` pixels. A document equal to the last changes nothing; another starts
  /// the picture anew, with a coarse one until nothing has changed for a while. Only another exposure recolours it.
  void show(const Document& document, glm::uvec2 window_px);
  /// Begins to build the programs of a document's picture, of the live scene that is being uploaded.
  void prepare(const Document& document, glm::uvec2 window_px);
  /// Traces anew what is shown: the live scene was used for something else.
  void restart();
  /// The same where the live scene is another.
  void restart_with_scene();
  [[nodiscard]] glm::uvec2 window_px() const { return window_px_; }
  /// When work() has something to do: nothing = the picture is finished.
  [[nodiscard]] std::optional<Clock::time_point> next_work() const;
  /// Some tens of milliseconds of work; returns a picture when a new one is whole, else null. `stop` = something newer waits.
  /// Throws Error, as LiveScene::match and Tracer do, and then rests until the next change.
  [[nodiscard]] SharedFrame work(const std::function<bool()>& stop);

 private:
  /// `guided`: all samples are in, what guides the filter is traced; `filtered`: a thread of its own filters.
  enum class Stage { coarse, settling, fine, guided, filtered, finished };

  void prepare_fine(const View& view);
  [[nodiscard]] SharedFrame trace_coarse();
  [[nodiscard]] SharedFrame trace_fine(const std::function<bool()>& stop);
  [[nodiscard]] SharedFrame trace_samples();
  [[nodiscard]] bool denoises() const;
  [[nodiscard]] SharedFrame begin_filter(const std::function<bool()>& stop);
  [[nodiscard]] SharedFrame filtered_there(const Settings& settings, const Tracer::Progress& progress);
  void keep_half();
  [[nodiscard]] SharedFrame filtered();
  void trace_aovs(Frame& frame, const Settings& settings, const std::function<bool()>& stop);
  [[nodiscard]] Settings settings() const;
  [[nodiscard]] Settings coarse_settings() const;
  [[nodiscard]] Frame new_frame(glm::uvec2 size_px, double scale) const;
  void begin(const View& view, const Settings& settings);
  void take_grown(Frame& frame);
  [[nodiscard]] SharedFrame recoloured();
  [[nodiscard]] SharedFrame coloured(Frame frame);
  void display_on_device(Frame& frame);

  LiveScene& live_;
  std::string device_;
  const VulkanDevice* shared_;
  const bool filters_there_;
  std::optional<Screen> screen_;  ///< made with the first picture; none where `shared_` is null
  bool kept_there_ = false;       ///< the first half is on the device, not in half_
  bool shows_filtered_ = false;   ///< last_ is what the screen filtered
  Document document_;
  glm::uvec2 window_px_{0};
  Stage stage_ = Stage::finished;
  Clock::time_point due_{};         ///< when settling ends, or the filter is looked at next
  Clock::time_point pass_start_{};  ///< of the pass over the picture under way
  Clock::time_point published_{};   ///< last time that trace_samples gave a picture
  MovingResolution resolution_;
  std::optional<DisplayTable> table_;
  MovingPicture moving_;
  SharedFrame last_;
  bool grows_last_ = false;  ///< the tracer's picture begun is what last_ shows
  std::vector<vec4> half_;   ///< means of the first half of the samples
  /// The picture's pixels without noise; those of a picture that is no longer shown are not used.
  std::future<std::vector<vec4>> filter_;
  bool recolour_ = false;  ///< last_ has another exposure
};

}  // namespace splatray
