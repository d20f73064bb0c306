#include "app/view/viewer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/library/measure/surface_point.h"
#include "app/library/picture/reproduce.h"
#include "app/library/request/command_line.h"
#include "app/library/request/daylight_text.h"
#include "app/library/shot/scene_source.h"
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
constexpr double RESTING_SECONDS = 0.3;                       ///< of a camera, before what it sees is loaded
constexpr double CARET_SECONDS = 0.2;  ///< between looks at a text that is being written

bool flies_fast(const Window& window) {
  const auto all = bindings();
  return std::any_of(all.begin(), all.end(), [&](const Binding& binding) {
    return binding.action == Action::fly_fast && window.is_down(binding.code);
  });
}

/// The size that is asked for, or of the window that was closed last.
glm::uvec2 window_size(const Request& request, const UserState& user) {
  if (request.view.width > 0) return {request.view.width, request.view.height};
  return user.window_size.value_or(DEFAULT_WINDOW);
}

constexpr int LEFT_BUTTON = 0;   ///< GLFW_MOUSE_BUTTON_LEFT
constexpr double HOLD_EM = 0.7;  ///< how near to a handle it is taken hold of
constexpr double WALK_NOTCH = 1.25, FAST_WALK = 5.0;

}  // namespace

Viewer::Viewer(const Request& request, Clock::time_point start)
    : request_(request),
      // What was remembered is what the window had.
      window_("splatray", window_size(request, user_.state()),
              /*scaled=*/request.view.width > 0 || !user_.state().window_size),
      devices_(request_.settings.device, window_),
      stats_(start),
      presenter_(window_, devices_.showing()),
      loader_([this] { window_.wake(); }, user_scene_cache()),
      renderer_(devices_.tracing(), devices_.shared(), [this] { window_.wake(); }) {
  panels_.recent_files = user_.state().recent_files;
  const Choices& choices = choices_kept_ = user_.state().choices;
  document_.eye_dome = choices.eye_dome;
  document_.point_size = choices.point_size;
  panels_.walk_speed = choices.walk_speed;
  panels_.shows_handles = choices.shows_handles;
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
      remember_window(), remember_choices();
    if (frames_left == 0 && !presenter_.gui().wants_keyboard() && panels_.notice.empty() && !is_to_refine())
      continue;
    frames_left = std::max(frames_left - 1, 0);
    poll();
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
    stats_.write(request_.output.stats_json, devices_.validation_messages());
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
double Viewer::patience() const {
  if (is_to_refine()) return RESTING_SECONDS;
  return presenter_.gui().wants_keyboard() ? CARET_SECONDS : SIGNAL_SECONDS;
}

void Viewer::poll() {
  take_load_news();
  take_render_news();
  refine();
  const SceneFiles dropped = window_.take_dropped();
  if (!dropped.empty()) attempt_to("opening " + scene_title(dropped), [&] { take_files(dropped); });
}

void Viewer::take_load_news() {
  LoadNews news = loader_.poll();
  work_.reset();
  if (news.progress) work_ = {news.progress->stage, news.progress->share};
  if (!news.notice.empty()) add_line(panels_.notice, news.notice);
  if (!news.error.empty()) panels_.error = news.error;
  if (news.points) attempt_to("showing points", [&] { show(std::move(*news.points)); });
  if (news.opened) attempt_to("showing the scene", [&] { show(std::move(*news.opened)); });
  if (news.refined && scene_ && document_.loaded->facts.overview) {
    scene_ = std::move(news.refined);
    renderer_.open(scene_, document_, picture_px());
  }
  if (!news.progress) leave_points();
}

/// Has what the view needs of a scene in levels loaded, once it rests.
void Viewer::refine() {
  if (!scene_ || of_points_ || !document_.loaded->facts.overview) return;
  const Clock::time_point now = Clock::now();
  const View view{document_.camera, picture_px().x, picture_px().y};
  if (view.camera != resting_.camera || view.width != resting_.width || view.height != resting_.height) {
    resting_ = view;
    rests_since_ = now;
  }
  const std::chrono::duration<double> resting(RESTING_SECONDS);
  if (view.width == 0 || !is_to_refine() || now - rests_since_ < resting) return;
  rests_since_ = {};
  loader_.refine(request_of(document_, view.width, view.height));
}

void Viewer::take_render_news() {
  RenderNews news = renderer_.poll();
  if (news.frame) {
    frame_ = news.frame;
    has_new_frame_ = true;
    if (frame_->shown)
      presenter_.set_picture(frame_->shown, frame_->view.width, frame_->view.height);
    else
      presenter_.set_picture(frame_->display, frame_->view.width, frame_->view.height);
    stats_.shown(frame_, Clock::now());
  }
  if (news.saving) work_ = news.saving;
  if (news.light_at_camera) show_light_at_camera(*news.light_at_camera, document_);
  if (news.exposure_ev) {
    found_exposure_ev_ = news.exposure_ev;
    document_.request.look.exposure_ev = *news.exposure_ev;
  }
  const bool adapted = news.exposure_ev && std::exchange(adapts_, false);
  if ((news.light_at_camera || news.exposure_ev) && !adapted && scene_ && !of_points_)
    history_.start(document_);
  if (!news.notice.empty()) panels_.notice = news.notice;
  if (!news.error.empty()) panels_.error = news.error;
  if (!news.pick) return;
  take_pick(*news.pick);
}

void Viewer::take_pick(const Pick& pick) {
  if (pick.purpose == PickFor::inspect) inspected_ = pick.inspected;
  if (!pick.inspected) return;
  const glm::dvec3& hit_world = pick.inspected->hit_world;
  if (pick.purpose == PickFor::pivot) set_pivot(document_, hit_world);
  if (pick.purpose == PickFor::orbit && mouse_.is_held()) about_world_ = hit_world;
  if (pick.purpose == PickFor::measure && panels_.measuring)
    measure_at(*pick.inspected, pick.point, *panels_.measuring);
}

/// Adds what was picked to the measures; of a sphere or cylinder what is around the cursor.
void Viewer::measure_at(const Inspected& picked, const SurfacePoint& point, MeasureKind kind) {
  constexpr double AROUND_PX = 40.0;
  const Camera& camera = document_.camera;
  if (!is_fitted(kind)) return add_point(document_.measures, kind, point);
  const double height_world =
      camera.ortho_height > 0.0
          ? camera.ortho_height
          : 2.0 * std::tan(glm::radians(0.5 * camera.fov_y_deg)) * picked.distance_world;
  const double reach = AROUND_PX * height_world / std::max(picture_px().y, 1U);
  Measure measure{kind, {point}};
  if (!fit_near(*scene_, shown_region(), picked.hit_world, reach, measure))
    return void(panels_.notice = std::string("found no ") + measure_name(kind) + " around the cursor");
  document_.measures.push_back(std::move(measure));
}

/// What goes wrong becomes a sentence in the window.
void Viewer::attempt_to(const std::string& doing, const std::function<void()>& step) {
  if (const std::optional<Failure> failure = attempt(doing, step)) panels_.error = failure->sentence;
}

void Viewer::handle_inputs() {
  const Gui& gui = presenter_.gui();
  for (const InputEvent& event : window_.take_inputs()) {
    if (event.kind == InputEvent::Kind::key) {
      const std::optional<Command> command = command_for(InputKind::key, event.code, event.modifiers);
      if (flies() && command_for(InputKind::fly_key, event.code, 0) && (!command || event.modifiers == 0))
        continue;  // see fly_on
      if (command && (!gui.wants_keyboard() || command->action == Action::escape)) handle(*command);
      continue;
    }
    const bool over_controls = gui.wants_mouse() || !has_view();
    if ((handle_ || !over_controls) && take_hold(event)) continue;
    if (const std::optional<Gesture> gesture = mouse_.take(event, over_controls, Clock::now()))
      handle(*gesture);
  }
  fly_on();
}

/// Of a handle, which then follows the cursor until the button is up; of a point to orbit about. Returns whether the event is a
/// handle's.
bool Viewer::take_hold(const InputEvent& event) {
  using Kind = InputEvent::Kind;
  const bool left = event.code == LEFT_BUTTON && event.modifiers == 0;
  if (event.kind == Kind::release && handle_) {
    handle_.reset();
    return true;
  }
  if (event.kind == Kind::move && handle_) {
    drag_handle(document_, *handle_, hold_px_, event.position_px, picture_px());
    hold_px_ = event.position_px;
    return true;
  }
  if (event.kind != Kind::press || !left || mouse_.is_held()) return false;
  about_world_.reset();
  if (panels_.shows_handles)
    handle_ = handle_at(document_, event.position_px, picture_px(), HOLD_EM * presenter_.gui().em_px());
  if (handle_) hold_px_ = event.position_px;
  if (!handle_ && scene_ && !panels_.walks) renderer_.pick({event.position_px, picture_px(), PickFor::orbit});
  return handle_.has_value();
}

void Viewer::handle(const Gesture& gesture) {
  const glm::dvec2 size(picture_px()), step = gesture.to_px - gesture.from_px;
  switch (gesture.action) {
    case Action::orbit:
      return panels_.walks ? look(document_, step, size) : orbit(document_, step, size, about_world_);
    case Action::pan:
      return pan(document_, gesture.from_px, gesture.to_px, size);
    case Action::look:
      return look(document_, step, size);
    case Action::move_slice:
      static_cast<void>(move_slice(document_, gesture.notches));
      return;
    case Action::zoom:
      if (panels_.walks) return change_walk_speed(gesture.notches);
      return zoom(document_, gesture.notches, gesture.to_px, size);
    case Action::drag_light:
      if (std::vector<LightRequest>& lights = lights_of(document_); panels_.light < lights.size())
        drag_light(document_, gesture.to_px, size, lights[panels_.light].light);
      return;
    case Action::pivot:
      return renderer_.pick({gesture.to_px, picture_px(), PickFor::pivot});
    case Action::inspect:
      return renderer_.pick(
          {gesture.to_px, picture_px(), panels_.measuring ? PickFor::measure : PickFor::inspect});
    default:
      return;
  }
}

/// Moves on while the fly keys are down.
void Viewer::fly_on() {
  const Clock::time_point now = Clock::now();
  const glm::dvec3 direction = fly_direction([this](int key) { return window_.is_down(key); });
  if (!flies() || direction == glm::dvec3(0.0) || presenter_.gui().wants_keyboard() ||
      dialog_is_open(panels_)) {
    flown_ = now;
    return;
  }
  const double seconds = std::chrono::duration<double>(now - flown_).count();
  if (panels_.walks)
    walk(document_, direction, seconds, panels_.walk_speed * (flies_fast(window_) ? FAST_WALK : 1.0));
  else
    fly(document_, direction, seconds, flies_fast(window_));
  flown_ = now;
  window_.wake();
}

bool Viewer::flies() const { return panels_.walks || mouse_.drags(Action::look); }

void Viewer::change_walk_speed(double notches) {
  panels_.walk_speed = std::clamp(panels_.walk_speed * std::pow(WALK_NOTCH, notches), 1e-3, 1e3);
  remember_choices();
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
      return look_from(viewpoint_ == Viewpoint::sensor
                           ? Viewpoint::front
                           : static_cast<Viewpoint>(static_cast<int>(viewpoint_) + 1));
    case Action::view_oblique:
      return look_from(Viewpoint::oblique);
    case Action::view_inside:
      return look_from(Viewpoint::inside);
    case Action::view_dollhouse:
      return look_from(Viewpoint::dollhouse);
    case Action::view_sensor:
      return look_from(Viewpoint::sensor);
    case Action::undo:
    case Action::redo:
      return go_back(command.action == Action::undo);
    case Action::empty_cache:
      return empty_cache();
    default:
      return;
  }
}

void Viewer::go_back(bool undo) {
  if (!scene_ || of_points_) return;
  if (!(undo ? history_.undo(document_) : history_.redo(document_)))
    panels_.notice = undo ? "nothing to undo" : "nothing to redo";
}

/// One of the views of --view, of what the region holds.
void Viewer::look_from(Viewpoint viewpoint) {
  if (!scene_ || of_points_) return;
  viewpoint_ = viewpoint;
  document_.camera = viewpoint_camera(*scene_, viewpoint_, aspect(), {}, shown_region());
  document_.request.view.look_in = viewpoint_ == Viewpoint::dollhouse;
  panels_.notice = std::string("view: ") + viewpoint_name(viewpoint_);
}

void Viewer::draw_controls() {
  panels_.ui_scale = presenter_.gui().scale();
  PanelView view;
  view.frame = frame_.get();
  view.inspected = inspected_ ? &*inspected_ : nullptr;
  view.frames_per_second = stats_.per_second(Clock::now());
  view.work = work_ ? &*work_ : nullptr;
  view.picture_px = picture_px();
  view.about_world = mouse_.drags(Action::orbit) ? about_world_ : std::nullopt;
  view.handle = handle_ ? &*handle_ : nullptr;
  view.cache_bytes = cache_bytes_;
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

Region Viewer::shown_region() const { return region_of(document_.request.view.region, up_of(document_)); }

/// Hands the document over; the render thread finds out whether anything has changed.
void Viewer::submit() {
  const glm::uvec2 size = picture_px();
  if (scene_ && !of_points_)
    history_.see(document_, mouse_.is_held() || handle_ || presenter_.gui().is_editing());
  if (!has_view() || size.x == 0 || size.y == 0) return;
  // Daylight is some hundred times as bright as other environments: where it comes or goes the exposure follows.
  const std::string& environment = document_.request.look.environment;
  const bool adapts =
      environment != lit_by_ && (is_daylight(environment) || is_daylight(lit_by_)) && scene_ && !of_points_;
  if (!of_points_) lit_by_ = environment;
  adapts_ = adapts_ || adapts;
  renderer_.open(nullptr, document_, size, {.exposure = adapts});
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
