/// The viewer: what a person does becomes a document, documents become pictures, pictures come into the window.
#pragma once
#include <filesystem>
#include <functional>
#include <optional>

#include "app/view/model/history.h"
#include "app/view/model/region_edit.h"
#include "app/view/model/user_files.h"
#include "app/view/thread/load_thread.h"
#include "app/view/thread/render_thread.h"
#include "app/view/ui/panels.h"
#include "app/view/view_options.h"
#include "app/view/view_stats.h"
#include "app/view/window/mouse.h"
#include "app/view/window/presenter.h"
#include "app/view/window/view_devices.h"
#include "app/view/window/window.h"

namespace splatray {

/// On the program's first thread.
class Viewer {
 public:
  /// Opens the window. `start`: of the program. Throws Error (no_device).
  Viewer(const Request& request, ViewStats::Clock::time_point start);

  /// Until the window is closed or a signal comes. State that could not be kept is noted on stderr at the end. Throws Error (failed) when
  /// the window cannot be drawn or the statistics not be written.
  void run();

 private:
  void poll();
  void take_load_news();
  void refine();
  void take_render_news();
  void attempt_to(const std::string& doing, const std::function<void()>& step);
  void open(const SceneFiles& files);
  void add(const SceneFiles& files);
  void open(Request request);
  void show(OpenedScene opened);
  void show(OpenedPoints opened);
  void leave_points();
  void load(const Request& request);
  void require_scene(const std::filesystem::path& file, const char* found) const;
  void take_files(const SceneFiles& files);
  void take_file(const std::filesystem::path& file);
  void handle_inputs();
  void handle(const Gesture& gesture);
  void handle(const Command& command);
  void fly_on();
  void look_from(Viewpoint viewpoint);
  void take_pick(const Pick& pick);
  void measure_at(const Inspected& picked, const SurfacePoint& point, MeasureKind kind);
  [[nodiscard]] bool take_hold(const InputEvent& event);
  [[nodiscard]] bool flies() const;
  void change_walk_speed(double notches);
  void go_back(bool undo);
  void empty_cache();
  void remember_choices();
  void draw_controls();
  void handle(const Requests& requests);
  void cancel();
  void copy();
  void paste();
  void submit();
  [[nodiscard]] bool is_worth_drawing();
  void remember(const UserChange& change);
  void remember_bookmarks();
  void remember_window();
  void write_stats();
  [[nodiscard]] Region shown_region() const;
  [[nodiscard]] glm::uvec2 picture_px() const;
  [[nodiscard]] double aspect() const;
  /// Whether there is something to look at and move about.
  [[nodiscard]] bool has_view() const { return scene_ || of_points_; }
  [[nodiscard]] double patience() const;
  [[nodiscard]] bool is_to_refine() const { return rests_since_ != ViewStats::Clock::time_point{}; }

  UserMemory user_{user_state_path()};
  std::string unkept_;         ///< why the last change of user_ could not be kept; empty = it was
  glm::uvec2 window_kept_{0};  ///< size of the window as user_ has it
  Choices choices_kept_;       ///< those of this window
  Request request_;            ///< of the command line
  Window window_;
  ViewDevices devices_;  ///< before all that has pictures of theirs
  ViewStats stats_;
  Presenter presenter_;
  LoadThread loader_;
  RenderThread renderer_;

  Document document_;
  std::optional<double> asked_exposure_ev_;  ///< by an option; unset = what suits a scan, else as it was
  std::optional<double> found_exposure_ev_;  ///< that suits the scan shown
  std::string lit_by_;                       ///< the environment that the exposure was last found in
  bool adapts_ = false;     ///< an exposure is being found for another environment of the scene shown
  SharedScene scene_;       ///< null: none is open
  bool of_points_ = false;  ///< document_ is that of points, which are shown until their scene is made
  Document before_;         ///< then: that of scene_
  Viewpoint viewpoint_ = Viewpoint::automatic;  ///< that look_from took last
  History history_;                             ///< of the scene shown
  std::optional<glm::dvec3> about_world_;       ///< what lay under the cursor when its button was pressed
  std::optional<Grip> handle_;                  ///< that is held
  std::uint64_t cache_bytes_ = 0;               ///< as it was when a scene was opened last
  glm::dvec2 hold_px_{0.0};                     ///< where the cursor held it last
  Mouse mouse_;
  PanelState panels_;
  SharedFrame frame_;
  std::optional<Inspected> inspected_;
  std::optional<Work> work_;
  ViewStats::Clock::time_point flown_{};        ///< when fly_on last moved
  bool has_new_frame_ = false;                  ///< frame_ has not been drawn
  ViewStats::Clock::time_point drawn_{};        ///< when the window was drawn last
  View resting_{};                              ///< the view that was seen last, of a scene in levels
  ViewStats::Clock::time_point rests_since_{};  ///< unset: what it needs is there, or asked for
  bool closing_ = false;
};

}  // namespace splatray
