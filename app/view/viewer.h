/// The viewer: what a person does becomes a document, documents become pictures, pictures come into the window.
#pragma once
#include <filesystem>
#include <functional>
#include <optional>

#include "app/view/model/user_files.h"
#include "app/view/thread/load_thread.h"
#include "app/view/thread/render_thread.h"
#include "app/view/ui/panels.h"
#include "app/view/view_options.h"
#include "app/view/view_stats.h"
#include "app/view/window/mouse.h"
#include "app/view/window/presenter.h"
#include "app/view/window/window.h"

namespace splatray {

/// On the program's first thread.
class Viewer {
 public:
  /// Opens the window. `start`: of the program. Throws Error (no_device).
  Viewer(const ViewOptions& options, ViewStats::Clock::time_point start);

  /// Until the window is closed or a signal comes. State that cannot be kept is noted on stderr. Throws Error (failed) when
  /// the window cannot be drawn or the statistics not be written.
  void run();

 private:
  void take_news();
  void take_load_news();
  void take_render_news();
  void attempt_to(const std::string& doing, const std::function<void()>& step);
  void open(const std::filesystem::path& file);
  void open(const RenderOptions& options);
  void show(OpenedScene opened);
  void require_scene(const std::filesystem::path& file, const char* found) const;
  void take_dropped(const std::filesystem::path& file);
  void handle_inputs();
  void handle(const Gesture& gesture);
  void handle(const Command& command);
  void fly_on();
  void draw_controls();
  void handle(const Requests& requests);
  void cancel();
  void copy();
  void paste();
  void submit();
  [[nodiscard]] bool is_worth_drawing();
  void remember();
  void write_stats();
  [[nodiscard]] glm::uvec2 picture_px() const;
  [[nodiscard]] double aspect() const;
  [[nodiscard]] double patience() const;

  std::filesystem::path user_path_ = user_state_path();
  UserState user_ = read_user_state(user_path_);
  ViewOptions options_;
  ViewStats stats_;
  Window window_;
  Presenter presenter_;
  LoadThread loader_;
  RenderThread renderer_;

  Document document_;
  bool has_scene_ = false;
  std::filesystem::path file_;  ///< of the scene shown
  Mouse mouse_;
  PanelState panels_;
  SharedFrame frame_;
  std::optional<Inspected> inspected_;
  std::optional<Work> work_;
  ViewStats::Clock::time_point flown_{};  ///< when fly_on last moved
  bool has_new_frame_ = false;            ///< frame_ has not been drawn
  ViewStats::Clock::time_point drawn_{};  ///< when the window was drawn last
  bool closing_ = false;
};

}  // namespace splatray
