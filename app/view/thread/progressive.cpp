#include "app/view/thread/progressive.h"

#include <limits>

#include "app/library/picture/denoise.h"
#include "app/library/shot/resolve.h"
#include "engine/base/error.h"
#include "engine/base/stopwatch.h"
#include "engine/image/picture_error.h"

namespace splatray {
namespace {

constexpr double MOVING_MS = 1000.0 / 20.0;  ///< of a coarse picture
/// The same where it would be coarser than a third of the window.
constexpr double SLOWEST_MS = 1000.0 / 11.0;
constexpr double BAND_MS = 30.0;  ///< of work before changes are looked for
constexpr std::chrono::milliseconds SETTLING{150};
/// Least time between the pictures of trace_samples, so that reading back costs little.
constexpr std::chrono::milliseconds BETWEEN_PICTURES{33};
constexpr std::chrono::milliseconds BETWEEN_LOOKS{20};  ///< at a filter that works

/// Whether a picture of one is a picture of the other, but for how it is displayed.
bool same_picture(const Document& a, const Document& b) {
  Request request = a.request;
  request.look.exposure_ev = b.request.look.exposure_ev;
  request.look.tone = b.request.look.tone;
  return request == b.request && a.camera == b.camera && a.mode == b.mode && a.eye_dome == b.eye_dome &&
         same_bytes(a.materials, b.materials);
}

Display display_of(const Document& document) {
  return {exposure_of(document), resolve_tone(document.request)};
}

}  // namespace

Progressive::Progressive(LiveScene& live, std::string device, const VulkanDevice* shared,
                         std::optional<bool> filters_there)
    : live_(live),
      device_(std::move(device)),
      shared_(shared),
      filters_there_(shared != nullptr && filters_there.value_or(!shared->profile().slow)) {}

void Progressive::show(const Document& document, glm::uvec2 window_px) {
  const bool same = window_px == window_px_ && same_picture(document, document_);
  if (display_of(document) != display_of(document_)) recolour_ = last_ != nullptr;
  document_ = document;
  window_px_ = window_px;
  if (!same) restart();
}

void Progressive::prepare(const Document& document, glm::uvec2 window_px) {
  show(document, window_px);
  if (document_.mode != ViewMode::shaded || window_px_.x == 0 || window_px_.y == 0) return;
  live_.match_look(document_, document_.mode);
  const View view{document_.camera, window_px_.x, window_px_.y};
  live_.tracer().prepare(live_.look(), view, coarse_settings());
  prepare_fine(view);
  if (shared_ == nullptr) return;
  if (!screen_) screen_.emplace(*shared_);
  screen_->prepare(display_of(document_).tone);
}

/// Begins to build the programs of what follows a coarse picture, but where the threads that build them are what traces.
void Progressive::prepare_fine(const View& view) {
  if (live_.shown().device().profile().slow) return;
  Settings fine = settings();
  fine.aov = denoises();
  live_.tracer().prepare(live_.look(), view, fine);
}

void Progressive::restart() { stage_ = Stage::coarse; }

void Progressive::restart_with_scene() {
  moving_.forget();
  if (screen_) screen_->forget();
  grows_last_ = false;
  restart();
}

std::optional<Progressive::Clock::time_point> Progressive::next_work() const {
  if (recolour_) return Clock::time_point{};
  if (stage_ == Stage::finished || !live_.is_open()) return {};
  return stage_ == Stage::settling || stage_ == Stage::filtered ? due_ : Clock::time_point{};
}

SharedFrame Progressive::work(const std::function<bool()>& stop) {
  if (recolour_) return recoloured();
  const Stage stage = stage_;
  stage_ = Stage::finished;  // should an Error fly
  live_.match(document_, document_.mode);
  if (stage == Stage::coarse) {
    SharedFrame frame = trace_coarse();
    due_ = Clock::now() + SETTLING;
    stage_ = Stage::settling;
    return frame;
  }
  if (stage == Stage::guided) return begin_filter(stop);
  if (stage == Stage::filtered) return filtered();
  if (stage == Stage::settling && document_.mode == ViewMode::shaded) {
    begin({document_.camera, window_px_.x, window_px_.y}, settings());
    pass_start_ = Clock::now();
    half_.clear();
  }
  stage_ = Stage::fine;
  return trace_fine(stop);
}

SharedFrame Progressive::trace_coarse() {
  const double scale = resolution_.scale(window_px_, MOVING_MS, SLOWEST_MS);
  Frame frame = new_frame(scaled_size(window_px_, scale), scale);
  frame.moving = true;
  const Settings coarse = coarse_settings();
  frame.is_seen = coarse.look == LOOK_SEEN;
  const Clock::time_point start = Clock::now();
  if (document_.mode == ViewMode::shaded) {
    prepare_fine(frame.view);  // while this is built and seen
    begin(frame.view, coarse);
    while (!live_.tracer().advance(std::numeric_limits<double>::infinity())) {
    }
    take_grown(frame);
  } else {
    trace_aovs(frame, coarse, {});
  }
  frame.ms = milliseconds_since(start);
  frame.stats = live_.tracer().stats();
  const double pixels = double(frame.view.width) * frame.view.height;
  SharedFrame shown = coloured(std::move(frame));
  resolution_.learn(pixels,
                    milliseconds_since(start));  // with its colouring, which the display waits for too
  return shown;
}

/// Begins another picture.
void Progressive::begin(const View& view, const Settings& settings) {
  if (screen_) screen_->wait();  // which may read the one before
  shows_filtered_ = false;
  grows_last_ = false;
  live_.tracer().begin(live_.look(), view, settings);
}

/// Gives a frame the picture begun as it is: where pictures are shown from the device only its size.
void Progressive::take_grown(Frame& frame) {
  if (shared_ == nullptr)
    frame.image = live_.tracer().picture();
  else
    frame.image = {frame.view.width, frame.view.height, {}, {}};
  grows_last_ = true;
}

SharedFrame Progressive::trace_fine(const std::function<bool()>& stop) {
  if (document_.mode == ViewMode::shaded) return trace_samples();
  Frame frame = new_frame(window_px_, 1.0);
  const Clock::time_point start = Clock::now();
  try {
    trace_aovs(frame, settings(), stop);
  } catch (const Error& error) {
    if (error.code() != ExitCode::interrupted) throw;
    return {};
  }
  frame.ms = milliseconds_since(start);
  frame.stats = live_.tracer().stats();
  stage_ = Stage::finished;
  return coloured(std::move(frame));
}

/// Adds to the picture begun; it is handed over when all of its pixels have the same number of samples.
SharedFrame Progressive::trace_samples() {
  Tracer& tracer = live_.tracer();
  const std::uint32_t before = tracer.samples();
  const bool finished = tracer.advance(BAND_MS);
  if (finished) stage_ = denoises() ? Stage::guided : Stage::finished;
  if (tracer.samples() == before) return {};
  if (tracer.samples() == settings().samples / 2 && denoises()) keep_half();
  const double ms = milliseconds_since(pass_start_);
  pass_start_ = Clock::now();
  if (!finished && pass_start_ - published_ < BETWEEN_PICTURES) return {};
  published_ = pass_start_;
  Frame frame = new_frame(window_px_, 1.0);
  take_grown(frame);
  frame.samples = tracer.samples();
  frame.ms = ms;
  frame.stats = tracer.stats();
  SharedFrame shown = coloured(std::move(frame));
  pass_start_ = Clock::now();
  return shown;
}

/// Keeps the picture as it is, which has half of its samples.
void Progressive::keep_half() {
  kept_there_ = false;
  if (filters_there_ && has_own_filter()) {
    try {
      screen_->keep(live_.tracer().grown());
      kept_there_ = true;
      return;
    } catch (const Error& error) {
      if (error.code() != ExitCode::out_of_memory) throw;  // else the host does it
    }
  }
  half_ = live_.tracer().picture().rgba;
}

bool Progressive::denoises() const {
  Request request = document_.request;
  request.output = document_.loaded->asked.output;
  request.output.path.clear();
  return document_.mode == ViewMode::shaded && resolve_denoise(request, settings().look);
}

/// Traces what a filter is guided by, and has a thread filter the last picture.
SharedFrame Progressive::begin_filter(const std::function<bool()>& stop) {
  stage_ = Stage::guided;
  due_ = Clock::now() + BETWEEN_LOOKS;
  if (filter_.valid() && filter_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
    return {};  // that of a picture that is no longer shown
  const Settings settings = this->settings();
  const Tracer::Progress progress = [&stop](double) { return !stop(); };
  if (kept_there_) return filtered_there(settings, progress);
  Image image = live_.tracer().picture();
  std::vector<vec4> base;
  try {
    image.aov = live_.tracer().trace_aov(live_.look(), last_->view, settings, progress);
    base = base_colors(live_.tracer(), live_.look(), last_->view, settings, progress);
  } catch (const Error& error) {
    if (error.code() != ExitCode::interrupted) throw;
    return {};
  }
  estimate_errors(half_, settings.samples / 2, settings.samples, image);
  filter_ = std::async(std::launch::async, [image = std::move(image), base = std::move(base)]() mutable {
    static_cast<void>(remove_noise(image, std::move(base)));
    return std::move(image.rgba);
  });
  stage_ = Stage::filtered;
  return {};
}

/// The last picture as the device filters it.
SharedFrame Progressive::filtered_there(const Settings& settings, const Tracer::Progress& progress) {
  DeviceGuide guide;
  screen_->wait();  // which may read the one before
  try {
    guide =
        live_.tracer().trace_guide(live_.look(), last_->view, settings, base_settings(settings), progress);
  } catch (const Error& error) {
    if (error.code() != ExitCode::interrupted) throw;
    return {};
  }
  const float share = static_cast<float>(settings.samples / 2) / static_cast<float>(settings.samples);
  screen_->filter(live_.tracer().grown(), share, guide);
  shows_filtered_ = true;
  stage_ = Stage::finished;
  Frame frame = *last_;
  frame.denoised = true;
  return coloured(std::move(frame));
}

/// The last picture as it was filtered, once it was.
SharedFrame Progressive::filtered() {
  stage_ = Stage::filtered;
  due_ = Clock::now() + BETWEEN_LOOKS;
  if (filter_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return {};
  stage_ = Stage::finished;
  Frame frame = *last_;
  frame.image.rgba = filter_.get();
  frame.denoised = true;
  return coloured(std::move(frame));
}

void Progressive::trace_aovs(Frame& frame, const Settings& settings, const std::function<bool()>& stop) {
  Tracer::Progress progress;
  if (stop) progress = [&stop](double) { return !stop(); };
  frame.image.width = frame.view.width;
  frame.image.height = frame.view.height;
  frame.image.aov = live_.tracer().trace_aov(live_.look(), frame.view, settings, progress);
}

Settings Progressive::settings() const {
  Settings settings = resolve_settings(live_.scene(), document_.request);
  settings.aov = false;
  settings.counters = document_.mode == ViewMode::tests || document_.mode == ViewMode::steps;
  return settings;
}

/// Those of a coarse picture.
Settings Progressive::coarse_settings() const {
  Settings coarse = settings();
  coarse.samples = 1;
  if (coarse.look == LOOK_PAPER) return coarse;  // whose one sample has no noise
  coarse.look = LOOK_SEEN;
  coarse.lens_radius_world = 0.0;
  return coarse;
}

Frame Progressive::new_frame(glm::uvec2 size_px, double scale) const {
  Frame frame;
  frame.view = {document_.camera, size_px.x, size_px.y};
  frame.samples = 1;
  frame.scale = scale;
  frame.mode = document_.mode;
  frame.device = device_;
  return frame;
}

/// The last picture in another exposure, or nothing where another has been begun, which will have it.
SharedFrame Progressive::recoloured() {
  recolour_ = false;
  const bool there = last_->mode != ViewMode::shaded || !last_->image.rgba.empty() || grows_last_;
  return there ? coloured(*last_) : nullptr;
}

SharedFrame Progressive::coloured(Frame frame) {
  recolour_ = false;
  frame.pool_bytes = live_.tracer().pool_bytes();
  frame.legend = live_.legend();
  frame.pools_uploaded = live_.tracer().pools_uploaded();
  if (frame.mode == ViewMode::shaded) {
    if (!table_ || table_->display() != display_of(document_)) table_.emplace(display_of(document_));
    if (shared_ != nullptr) {
      display_on_device(frame);
    } else {
      frame.display = frame.is_seen ? moving_.display(frame.image, frame.view, document_.eye_dome, *table_)
                                    : table_->rgba(frame.image.rgba);
      if (!frame.moving) moving_.rest(frame.image, frame.display);
    }
  } else {
    frame.range = color_range(frame.image.aov, frame.mode);
    frame.display = false_color(frame.image.aov, frame.mode, frame.range);
  }
  last_ = std::make_shared<const Frame>(std::move(frame));
  return last_;
}

void Progressive::display_on_device(Frame& frame) {
  if (!screen_) screen_.emplace(*shared_);
  const ShownAs how{*table_, frame.view, frame.moving, frame.is_seen, document_.eye_dome};
  if (!frame.image.rgba.empty()) {
    frame.shown = screen_->show(frame.image, how);
    return;
  }
  if (shows_filtered_) {
    frame.shown = screen_->show_filtered(how);
    return;
  }
  frame.shown = screen_->show(live_.tracer().grown(), how);
  if (screen_->has_cut_loops()) static_cast<void>(live_.tracer().picture());  // which says so
}

}  // namespace splatray
