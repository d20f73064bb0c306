#include "app/view/viewer.h"

#include <algorithm>
#include <cstdio>

#include "app/library/picture/reproduce.h"
#include "app/library/request/command_line.h"
#include "app/library/user_folders.h"
#include "app/view/model/attempt.h"
#include "app/view/model/document_request.h"
#include "app/view/model/navigation.h"
#include "engine/base/interrupt.h"

namespace splatray {
namespace {

using Clock = ViewStats::Clock;

/// Frames drawn after something happened, for controls that take their place in the next.
constexpr int FRAMES_TO_SETTLE = 3;
constexpr std::chrono::milliseconds LONGEST_STANDSTILL{100};  ///< of the window during a drag
constexpr double SIGNAL_SECONDS = 0.5;                        ///< between looks for an interrupt
constexpr double CARET_SECONDS = 0.2;  ///< between looks at a text that is being written

bool flies_fast(const Window& window) {
  const auto all = bindings();
  return std::any_of(all.begin(), all.end(), [&](const Binding& binding) {
    return binding.action == Action::fly_fast && window.is_down(binding.code);
  });
}

/// With the size of the window that was closed last, unless another is asked for.
Request sized(Request request, const UserState& user) {
  if (request.view.width > 0) return request;
  request.view.width = static_cast<std::uint32_t>(user.window_width);
  request.view.height = static_cast<std::uint32_t>(user.window_height);
  return request;
}

/// In the user's cache folder, where there is one.
SceneCache scene_cache() {
  const std::filesystem::path folder = user_cache_folder();
  return SceneCache(folder.empty() ? folder : folder / "scenes");
}

}  // namespace

Viewer::Viewer(const Request& request, Clock::time_point start)
    : request_(sized(request, user_.state())),
      stats_(start),
      window_("splatray", request_.view.width, request_.view.height),
      presenter_(window_),
      loader_([this] { window_.wake(); }, scene_cache()),
      renderer_(request_.settings.device, [this] { window_.wake(); }) {
  panels_.recent_files = user_.state().recent_files;
  asked_exposure_ev_ = request.look.exposure_ev;
  Request first = request_;
  first.view.width = std::max(picture_px().x, 1U);
  first.view.height = std::max(picture_px().y, 1U);
  if (!request_.source.inputs.empty()) loader_.load(first);
}

void Viewer::run() {
  int frames_left = FRAMES_TO_SETTLE;
  while (!closing_ && !window_.should_close() && !interrupted()) {
    if (window_.wait(frames_left > 0 ? 0.0 : patience()))
      frames_left = FRAMES_TO_SETTLE;
    else if (frames_left == 0)
      remember_window();
    if (frames_left == 0 && !presenter_.gui().wants_keyboard() && panels_.notice.empty()) continue;
    frames_left = std::max(frames_left - 1, 0);
    take_news();
    presenter_.gui().begin();
    handle_inputs();
    draw_controls();
    presenter_.gui().end();
    submit();
    if (is_worth_drawing()) presenter_.draw(picture_px().x);
    if (stats_.has_news()) write_stats();
  }
  window_kept_ = {};  // the window that is closed last decides
  remember_window();
  if (!unkept_.empty()) std::fprintf(stderr, "splatray-view: note: %s\n", unkept_.c_str());
  write_stats();
}

void Viewer::write_stats() {
  if (!request_.output.stats_json.empty())
    stats_.write(request_.output.stats_json,
                 presenter_.validation_messages() + renderer_.validation_messages());
}

/// While a drag changes the picture, the window waits for that picture: on the CPU, drawing costs the tracer's time.
bool Viewer::is_worth_drawing() {
  const Clock::time_point now = Clock::now();
  if (mouse_.is_held() && !has_new_frame_ && now - drawn_ < LONGEST_STANDSTILL) return false;
  has_new_frame_ = false;
  drawn_ = now;
  return true;
}

/// How long nothing needs to be drawn, seconds.
double Viewer::patience() const { return presenter_.gui().wants_keyboard() ? CARET_SECONDS : SIGNAL_SECONDS; }

void Viewer::take_news() {
  take_load_news();
  take_render_news();
  const SceneFiles dropped = window_.take_dropped();
  if (!dropped.empty()) attempt_to("opening " + scene_title(dropped), [&] { take_files(dropped); });
}

void Viewer::take_load_news() {
  LoadNews news = loader_.take_news();
  work_.reset();
  if (news.progress) work_ = {news.progress->stage, news.progress->share};
  if (!news.notice.empty()) add_line(panels_.notice, news.notice);
  if (!news.error.empty()) panels_.error = news.error;
  if (news.points) attempt_to("showing points", [&] { show(std::move(*news.points)); });
  if (news.opened) attempt_to("showing the scene", [&] { show(std::move(*news.opened)); });
  if (!news.progress) leave_points();
}

void Viewer::take_render_news() {
  RenderNews news = renderer_.take_news();
  if (news.frame) {
    frame_ = news.frame;
    has_new_frame_ = true;
    presenter_.set_picture(frame_->display, frame_->view.width, frame_->view.height);
    stats_.shown(frame_, Clock::now());
  }
  if (news.saving) work_ = news.saving;
  if (news.exposure_ev) {
    found_exposure_ev_ = news.exposure_ev;
    document_.exposure_ev = *news.exposure_ev;
  }
  if (!news.notice.empty()) panels_.notice = news.notice;
  if (!news.error.empty()) panels_.error = news.error;
  if (!news.pick) return;
  if (!news.pick->as_pivot)
    inspected_ = news.pick->inspected;
  else if (news.pick->inspected)
    set_pivot(document_, news.pick->inspected->hit_world);
}

/// What goes wrong becomes a sentence in the window.
void Viewer::attempt_to(const std::string& doing, const std::function<void()>& step) {
  if (const std::optional<Failure> failure = attempt(doing, step)) panels_.error = failure->sentence;
}

void Viewer::handle_inputs() {
  const Gui& gui = presenter_.gui();
  for (const InputEvent& event : window_.take_inputs()) {
    if (event.kind == InputEvent::Kind::key) {
      if (mouse_.drags(Action::look) && command_for(InputKind::fly_key, event.code, 0))
        continue;  // see fly_on
      const std::optional<Command> command = command_for(InputKind::key, event.code, event.modifiers);
      if (command && (!gui.wants_keyboard() || command->action == Action::escape)) handle(*command);
      continue;
    }
    const bool over_controls = gui.wants_mouse() || !has_view();
    if (const std::optional<Gesture> gesture = mouse_.take(event, over_controls, Clock::now()))
      handle(*gesture);
  }
  fly_on();
}

void Viewer::handle(const Gesture& gesture) {
  const glm::dvec2 size(picture_px()), step = gesture.to_px - gesture.from_px;
  switch (gesture.action) {
    case Action::orbit:
      return orbit(document_, step, size);
    case Action::pan:
      return pan(document_, gesture.from_px, gesture.to_px, size);
    case Action::look:
      return look(document_, step, size);
    case Action::zoom:
      return zoom(document_, gesture.notches, gesture.to_px, size);
    case Action::drag_light:
      if (panels_.light < document_.lights.size())
        drag_light(document_, gesture.to_px, size, document_.lights[panels_.light]);
      return;
    case Action::pivot:
    case Action::inspect:
      return renderer_.pick({gesture.to_px, picture_px(), gesture.action == Action::pivot});
    default:
      return;
  }
}

/// Moves on while the fly keys are down.
void Viewer::fly_on() {
  const Clock::time_point now = Clock::now();
  const glm::dvec3 direction = fly_direction([this](int key) { return window_.is_down(key); });
  if (!mouse_.drags(Action::look) || direction == glm::dvec3(0.0)) {
    flown_ = now;
    return;
  }
  fly(document_, direction, std::chrono::duration<double>(now - flown_).count(), flies_fast(window_));
  flown_ = now;
  window_.wake();
}

void Viewer::handle(const Command& command) {
  if (command.action == Action::escape && close_drop_down()) return;
  if (apply(command, aspect(), document_, panels_)) return remember_bookmarks();
  switch (command.action) {
    case Action::quit:
      closing_ = true;
      return;
    case Action::escape:
      return cancel();
    case Action::copy_command:
      return copy();
    case Action::paste_command:
      return attempt_to("pasting", [this] { paste(); });
    case Action::next_viewpoint:
      return look_from_next();
    default:
      return;
  }
}

/// Goes round the views of --view.
void Viewer::look_from_next() {
  if (!scene_ || of_points_) return;
  viewpoint_ = viewpoint_ == Viewpoint::sensor ? Viewpoint::front
                                               : static_cast<Viewpoint>(static_cast<int>(viewpoint_) + 1);
  document_.camera = viewpoint_camera(*scene_, viewpoint_, aspect(), {});
  document_.settings.cutaway = viewpoint_ == Viewpoint::dollhouse;
  panels_.notice = std::string("view: ") + viewpoint_name(viewpoint_);
}

void Viewer::draw_controls() {
  panels_.ui_scale = presenter_.gui().scale();
  PanelView view;
  view.frame = frame_.get();
  view.inspected = inspected_ ? &*inspected_ : nullptr;
  view.frames_per_second = stats_.per_second(Clock::now());
  view.work = work_ ? &*work_ : nullptr;
  const Requests requests = draw_panels(document_, panels_, view);
  if (!panels_.error.empty()) stats_.add_error(panels_.error);
  attempt_to("doing what was asked for", [&] { handle(requests); });
}

void Viewer::handle(const Requests& requests) {
  for (const Command& command : requests.commands) handle(command);
  if (requests.open) requests.add ? add(*requests.open) : open(*requests.open);
  if (requests.save && scene_ && !of_points_) renderer_.save(save_job(document_, *requests.save));
  if (requests.change && scene_ && !of_points_) open(*requests.change);
  if (requests.cancel) cancel();
}

void Viewer::cancel() {
  loader_.cancel();
  renderer_.cancel_save();
}

void Viewer::copy() {
  if (!scene_ || of_points_) return;
  Request request = request_of(document_, picture_px().x, picture_px().y);
  request.output.path = panels_.save.output.path;
  window_.set_clipboard(command_line(request));
  panels_.notice = "copied a splatray-render command";
}

/// Hands the document over; the render thread finds out whether anything has changed.
void Viewer::submit() {
  const glm::uvec2 size = picture_px();
  if (has_view() && size.x > 0 && size.y > 0) renderer_.show(document_, size);
}

/// The part of the window that shows the picture, pixels; 0 x 0 while minimised.
glm::uvec2 Viewer::picture_px() const {
  const glm::uvec2 window = window_.framebuffer_size();
  const float width = static_cast<float>(window_.size().x);
  if (width == 0.0F) return window;
  const float column = panel_column_px(panels_, width) * static_cast<float>(window.x) / width;
  return {window.x - std::min(window.x, static_cast<std::uint32_t>(column)), window.y};
}

double Viewer::aspect() const {
  const glm::uvec2 size = glm::max(picture_px(), glm::uvec2(1));
  return static_cast<double>(size.x) / size.y;
}

}  // namespace splatray
