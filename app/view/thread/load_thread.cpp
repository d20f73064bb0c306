#include "app/view/thread/load_thread.h"

#include <chrono>
#include <string_view>
#include <utility>

#include "app/library/shot/resolve.h"
#include "app/view/model/attempt.h"
#include "app/view/model/document_request.h"
#include "app/view/model/scene_files.h"
#include "engine/scene/scene_splat.h"

namespace splatray {
namespace {

constexpr std::chrono::duration<double> FIRST_POINTS{0.3};  ///< after reading began
constexpr std::size_t WORTH_KEEPING = std::size_t{1}
                                      << 14U;  ///< splats of a scene that takes a while to make
constexpr double POINTS_PAUSE = 2.0;  ///< points are shown again when reading has taken as many times as long

std::string stage_text(const char* stage, const Request& request) {
  return std::string(stage) + " " + scene_title(request.source.inputs);
}

/// The request of the scene as its files have it: the document keeps its materials, the render thread colours it.
Request plain_scene_of(Request request) {
  request.look.objects.clear();
  request.look.attributes = {};
  request.look.attributes.color_by = "rgb";
  return request;
}

}  // namespace

LoadThread::LoadThread(std::function<void()> wake, SceneCache cache)
    : wake_(std::move(wake)), cache_(std::move(cache)), thread_([this] { run(); }) {}

LoadThread::~LoadThread() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = cancelled_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void LoadThread::load(const Request& request) {
  const std::lock_guard lock(mutex_);
  waiting_ = request;
  news_.points.reset();
  news_.progress = {stage_text("reading", request), 0.0};
  cancelled_ = true;  // what is being loaded
  changed_.notify_one();
}

void LoadThread::refine(const Request& request) {
  const std::lock_guard lock(mutex_);
  refining_ = request;
  changed_.notify_one();
}

void LoadThread::cancel() {
  const std::lock_guard lock(mutex_);
  cancelled_ = true;
  if (std::exchange(waiting_, {})) news_.progress.reset();
}

LoadNews LoadThread::poll() {
  const std::lock_guard lock(mutex_);
  LoadNews news = std::exchange(news_, {});
  news_.progress = news.progress;
  return news;
}

void LoadThread::run() {
  while (true) {
    Request asked;
    bool refines = false;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return ending_ || waiting_ || refining_; });
      if (ending_) return;
      refines = !waiting_;
      asked = std::move(*std::exchange(refines ? refining_ : waiting_, {}));
      refining_.reset();  // of the scene before, or taken
      cancelled_ = false;
    }
    const std::optional<Failure> failure = attempt("loading " + scene_title(asked.source.inputs),
                                                   [&] { refines ? refine_now(asked) : load_now(asked); });
    deliver([&](LoadNews& news) {
      if (!waiting_) news.progress.reset();
      if (failure && !failure->interrupted) news.error = failure->sentence;
    });
  }
}

/// The scene that was made before, or a new one.
Scene LoadThread::made_scene(const Request& request, const LoadListener& listener, bool& worth_keeping) {
  if (std::optional<Scene> made = cache_.find(request, listener.progress)) return *std::move(made);
  LoadedScene loaded = load_and_show_points(request, listener);
  worth_keeping = loaded.build && splat_count(loaded.scene) > WORTH_KEEPING;
  return std::move(loaded.scene);
}

/// Loads the scene, and delivers its points as they are read: soon, then ever more seldom, and all that are kept at the end.
LoadedScene LoadThread::load_and_show_points(const Request& request, const LoadListener& listener) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  PointSampler sampler(request);
  std::chrono::duration<double> next = FIRST_POINTS;
  bool all = false;
  const auto show = [&] {
    if (sampler.is_small()) return;
    static_cast<void>(attempt("showing points", [&] {
      OpenedPoints points = sampler.make();
      deliver([&](LoadNews& news) {
        if (!cancelled_) news.points = std::move(points);
      });
    }));  // what is wrong with them is said of the scene
  };
  LoadListener watching = listener;
  watching.points = [&](const SeenPoints& seen) {
    sampler.add(seen);
    if (Clock::now() - start < next) return;
    show();
    next = POINTS_PAUSE * (Clock::now() - start);
  };
  watching.progress = [&](const char* stage, double share) {
    const bool is_read = std::string_view(stage) != "reading";
    if (is_read && !std::exchange(all, true)) show();
    all = is_read;
    return listener.progress(stage, share);
  };
  return load_scene(request, watching);
}

LoadListener LoadThread::listener_for(const Request& asked) {
  return {[this, asked](const char* stage, double share) {
            deliver([&](LoadNews& news) {
              if (!cancelled_) news.progress = {stage_text(stage, asked), share};
            });
            return !is_cancelled();
          },
          [this](const std::string& note) { deliver([&](LoadNews& news) { add_line(news.notice, note); }); }};
}

void LoadThread::load_now(const Request& asked) {
  const LoadListener listener = listener_for(asked);
  const Request request = plain_scene_of(asked);
  bool worth_keeping = false;
  SharedScene scene;
  SceneFacts facts;
  levels_ = {request.source, in_levels(request), {}, {}};
  if (levels_.files.paths.empty()) {
    scene = std::make_shared<const Scene>(made_scene(request, listener, worth_keeping));
    facts = facts_of(*scene);
  } else {
    levels_.facts = facts = load_overview(request, levels_.files, listener);
    scene = facts.overview;
  }
  const Shot shot = resolve(asked, *scene, facts);
  if (!shot.of.empty() && !shot.choices.empty()) listener.note(shot.of + ": " + choices_text(shot));
  OpenedScene opened{scene, first_document(*scene, facts, asked, shot)};
  const SharedScene kept = worth_keeping ? opened.scene : nullptr;
  if (is_cancelled()) return;
  deliver([&](LoadNews& news) {
    news.opened = std::move(opened);
    news.refined.reset();
    news.progress.reset();
  });
  if (kept) cache_.keep(request, *kept, [this](const char*, double) { return !is_cancelled(); });
}

void LoadThread::refine_now(const Request& asked) {
  if (levels_.files.paths.empty() || asked.source != levels_.source) return;  // of the scene before
  const Request request = plain_scene_of(asked);
  LoadedScene loaded =
      load_needed(request, levels_.files, levels_.facts, {listener_for(asked).progress, {}}, levels_.shown);
  if (is_cancelled() || loaded.nodes == levels_.shown) return;
  levels_.shown = std::move(loaded.nodes);
  deliver([&](LoadNews& news) {
    news.refined = std::make_shared<const Scene>(std::move(loaded.scene));
    news.progress.reset();
  });
}

/// `change` runs with the mutex held.
void LoadThread::deliver(const std::function<void(LoadNews&)>& change) {
  {
    const std::lock_guard lock(mutex_);
    change(news_);
  }
  wake_();
}

bool LoadThread::is_cancelled() {
  const std::lock_guard lock(mutex_);
  return cancelled_;
}

}  // namespace splatray
