#include "app/view/thread/render_thread.h"

#include <utility>

#include "app/library/measure/surface_point.h"
#include "app/library/shot/resolve.h"
#include "app/view/model/attempt.h"
#include "app/view/model/document_request.h"
#include "app/view/model/inspect.h"
#include "app/view/thread/point_picture.h"
#include "app/view/thread/point_sampler.h"
#include "engine/base/stopwatch.h"
#include "engine/scene/scene_splat.h"

namespace splatray {
namespace {

constexpr std::size_t MANY_SPLATS = 4'000'000;

}  // namespace

RenderThread::RenderThread(const Device& device, const VulkanDevice* shared, std::function<void()> wake)
    : device_(device),
      progressive_(live_, device.info().name, shared),
      wake_(std::move(wake)),
      thread_([this] { run(); }) {}

RenderThread::~RenderThread() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void RenderThread::show(const Document& document, glm::uvec2 window_px) {
  open(nullptr, document, window_px);
}

void RenderThread::open(SharedScene scene, const Document& document, glm::uvec2 window_px, Finds finds) {
  std::optional<Document> copy(document);  // made, and the one before freed, without the mutex
  const std::lock_guard lock(mutex_);
  if (scene || finds.any()) pending_.finds = finds;
  if (scene) pending_.scene = std::move(scene);
  std::swap(pending_.document, copy);
  pending_.window_px = window_px;
  changed_.notify_one();
}

void RenderThread::open_points(SharedPoints points, const Document& document, glm::uvec2 window_px) {
  std::optional<Document> copy(document);
  const std::lock_guard lock(mutex_);
  pending_.points = std::move(points);
  std::swap(pending_.document, copy);
  pending_.window_px = window_px;
  changed_.notify_one();
}

void RenderThread::pick(const PickRequest& request) {
  const std::lock_guard lock(mutex_);
  pending_.pick = request;
  changed_.notify_one();
}

void RenderThread::save(SaveJob job) {
  const std::lock_guard lock(mutex_);
  pending_.save = std::move(job);
  cancelled_ = false;
  changed_.notify_one();
}

void RenderThread::cancel_save() {
  const std::lock_guard lock(mutex_);
  cancelled_ = true;
}

RenderNews RenderThread::poll() {
  const std::lock_guard lock(mutex_);
  RenderNews news = std::exchange(news_, {});
  news_.saving = news.saving;
  return news;
}

void RenderThread::run() {
  while (const std::optional<Pending> pending = wait_for_requests()) {
    attempt_to("showing the scene", [&] { fulfil(*pending); });
    const auto when = points_ ? std::nullopt : progressive_.next_work();
    if (!when || *when > Progressive::Clock::now()) continue;
    attempt_to("tracing the picture", [this] {
      if (SharedFrame frame = progressive_.work([this] { return something_waits(); }))
        deliver([&](RenderNews& news) { news.frame = std::move(frame); });
      if (finds_.any()) find();  // what is seen first does not wait for it
    });
  }
}

/// Sleeps until there is something to do; returns what has been asked for, or nothing at the end.
std::optional<RenderThread::Pending> RenderThread::wait_for_requests() {
  std::unique_lock lock(mutex_);
  const auto awaited = [this] { return ending_ || pending_.any(); };
  if (const auto when = points_ ? std::nullopt : progressive_.next_work())
    changed_.wait_until(lock, *when, awaited);
  else
    changed_.wait(lock, awaited);
  if (ending_) return {};
  return std::exchange(pending_, {});
}

void RenderThread::fulfil(const Pending& pending) {
  if (pending.scene) open_now(pending);
  if (pending.points) points_ = *pending.points;
  if (pending.document) {
    shown_ = *pending.document;
    if (!points_) progressive_.show(shown_, pending.window_px);
  }
  if (points_) return show_points(pending.points.has_value(), pending.window_px);
  if (pending.scene) progressive_.restart_with_scene();
  if (pending.points) progressive_.restart();
  if (!live_.is_open()) return;
  if (pending.scene || pending.finds.any()) finds_ = pending.finds;
  if (pending.pick) answer(*pending.pick);
  if (pending.save) save_now(*pending.save);
}

/// Brings a scene to the device. A large one takes a while there: its points are seen until then.
void RenderThread::open_now(const Pending& pending) {
  if (!points_ && pending.document && splat_count(*pending.scene) > MANY_SPLATS) {
    shown_ = *pending.document;
    points_ = std::make_shared<const PointCloud>(points_of(*pending.scene, shown_));
    show_points(true, pending.window_px);
  }
  points_.reset();
  const auto prepare = [&] {
    if (!pending.document) return;
    attempt_to("showing the scene", [&] { progressive_.prepare(*pending.document, pending.window_px); });
  };
  live_.open(pending.scene, pending.document ? pending.document->request.look.attributes : AttributeOptions{},
             prepare);
}

/// Draws the points where they, or how they are seen, are new.
void RenderThread::show_points(bool others, glm::uvec2 window_px) {
  if (window_px.x == 0 || window_px.y == 0) return;
  const View view{shown_.camera, window_px.x, window_px.y};
  if (!others && view.camera == points_view_.camera && view.width == points_view_.width &&
      view.height == points_view_.height)
    return;
  points_view_ = view;
  Frame frame;
  frame.view = view;
  frame.of_points = true;
  frame.device = device_.info().name;
  PointStyle style;
  style.cutaway = shown_.request.view.look_in;
  style.eye_dome = shown_.eye_dome;
  style.size = shown_.point_size;
  const auto start = std::chrono::steady_clock::now();
  frame.display = draw_points(*points_, frame.view, style).rgba;
  frame.ms = milliseconds_since(start);
  deliver([&](RenderNews& news) { news.frame = std::make_shared<const Frame>(std::move(frame)); });
}

/// Reports the light and the exposure that suit the scene opened.
void RenderThread::find() {
  const Finds finds = std::exchange(finds_, {});
  const glm::uvec2 size_px = glm::max(progressive_.window_px(), glm::uvec2(1));
  const std::optional<SceneLight> light =
      finds.light_at_camera ? live_.light_at_camera(shown_, size_px) : std::nullopt;
  if (light) show_light_at_camera(*light, shown_);
  std::optional<double> exposure_ev;
  if (finds.exposure) exposure_ev = live_.exposure_ev(shown_, size_px);
  deliver([&](RenderNews& news) {
    news.light_at_camera = light;
    news.exposure_ev = exposure_ev;
  });
}

void RenderThread::answer(const PickRequest& request) {
  const View view{shown_.camera, request.size_px.x, request.size_px.y};
  live_.match(shown_, shown_.mode);
  const RayQuery query = cursor_query(live_.scene(), view, request.position_px);
  const Settings settings = resolve_settings(live_.scene(), shown_.request);
  const RayHit hit = live_.tracer().intersect(live_.look(), {&query, 1}, settings).front();
  Pick pick{inspect(live_.scene(), shown_.camera, query, hit), request.purpose};
  if (pick.inspected && request.purpose == PickFor::measure)
    pick.point = point_on_ray(live_.scene(), {pick.inspected->hit_world, glm::dvec3(hit.normal)},
                              glm::dvec3(query.dir));
  deliver([&](RenderNews& news) { news.pick = std::move(pick); });
}

void RenderThread::save_now(const SaveJob& job) {
  std::string notice;
  attempt_to("saving a picture", [&] {
    notice = save_pictures(job, live_, [this](const Work& work) {
      deliver([&](RenderNews& news) { news.saving = work; });
      const std::lock_guard lock(mutex_);
      return !cancelled_ && !ending_;
    });
  });
  deliver([&](RenderNews& news) {
    news.saving.reset();
    if (!notice.empty()) news.notice = notice;
  });
  progressive_.restart();
}

/// What goes wrong in a step becomes a sentence for the window.
void RenderThread::attempt_to(const char* doing, const std::function<void()>& step) {
  const std::optional<Failure> failure = attempt(doing, step);
  if (!failure) return;
  deliver([&](RenderNews& news) {
    if (failure->interrupted)
      news.notice = "cancelled";
    else
      news.error = failure->sentence;
  });
}

void RenderThread::deliver(const std::function<void(RenderNews&)>& change) {
  {
    const std::lock_guard lock(mutex_);
    change(news_);
  }
  wake_();
}

bool RenderThread::something_waits() {
  const std::lock_guard lock(mutex_);
  return ending_ || pending_.any();
}

}  // namespace splatray
