#include "app/view/thread/load_thread.h"

#include <utility>

#include "app/library/picture/scene_source.h"
#include "app/view/model/attempt.h"
#include "app/view/model/document_request.h"
#include "app/view/model/scene_files.h"

namespace splatray {
namespace {

std::string stage_text(const char* stage, const Request& request) {
  return std::string(stage) + " " + scene_title(request.source.inputs);
}

}  // namespace

LoadThread::LoadThread(std::function<void()> wake) : wake_(std::move(wake)), thread_([this] { run(); }) {}

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
  news_.progress = {stage_text("reading", request), 0.0};
  cancelled_ = true;  // what is being loaded
  changed_.notify_one();
}

void LoadThread::cancel() {
  const std::lock_guard lock(mutex_);
  cancelled_ = true;
  if (std::exchange(waiting_, {})) news_.progress.reset();
}

LoadNews LoadThread::take_news() {
  const std::lock_guard lock(mutex_);
  LoadNews news = std::exchange(news_, {});
  news_.progress = news.progress;
  return news;
}

void LoadThread::run() {
  while (true) {
    Request asked;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return ending_ || waiting_; });
      if (ending_) return;
      asked = std::move(*std::exchange(waiting_, {}));
      cancelled_ = false;
    }
    const std::optional<Failure> failure =
        attempt("loading " + scene_title(asked.source.inputs), [&] { load_now(asked); });
    deliver([&](LoadNews& news) {
      if (!waiting_) news.progress.reset();
      if (failure && !failure->interrupted) news.error = failure->sentence;
    });
  }
}

void LoadThread::load_now(const Request& asked) {
  const LoadListener listener{
      [&](const char* stage, double share) {
        deliver([&](LoadNews& news) {
          if (!cancelled_) news.progress = {stage_text(stage, asked), share};
        });
        return !is_cancelled();
      },
      [&](const std::string& note) { deliver([&](LoadNews& news) { add_line(news.notice, note); }); }};
  Request request = asked;
  request.look.objects.clear();  // the document keeps the materials without them
  request.look.attributes = {};  // the render thread applies them
  request.look.attributes.color_by = "rgb";
  LoadedScene loaded = load_scene(request, listener);
  const std::string choices = suited_picture(loaded.scene, asked).choices;
  if (!choices.empty()) listener.note(choices);
  OpenedScene opened{nullptr, first_document(loaded.scene, asked)};
  opened.scene = std::make_shared<const Scene>(std::move(loaded.scene));
  if (is_cancelled()) return;
  deliver([&](LoadNews& news) { news.opened = std::move(opened); });
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
