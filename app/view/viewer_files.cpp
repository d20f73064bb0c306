// What the viewer does with files: those of scenes and others that a person opens, drops or pastes, and its own.
#include <GLFW/glfw3.h>

#include <algorithm>
#include <utility>

#include "app/library/camera_file.h"
#include "app/library/picture/reproduce.h"
#include "app/library/request/command_line.h"
#include "app/library/shot/resolve.h"
#include "app/view/model/attempt.h"
#include "app/view/model/document_request.h"
#include "app/view/viewer.h"
#include "app/view/window/drop.h"
#include "engine/base/error.h"

namespace splatray {

void Viewer::load(const Request& request) {
  leave_points();
  of_points_ = false;
  panels_.notice.clear();
  loader_.load(request);
}

/// Opens another scene; the first one as the command line says.
void Viewer::open(const SceneFiles& files) {
  Request request = scene_ ? kept_request(document_) : request_;
  request.source = request_.source;
  request.source.inputs = files;
  request.look.material.clear();
  request.view.width = picture_px().x;
  request.view.height = picture_px().y;
  load(request);
}

/// Loads the scene shown together with more files.
void Viewer::add(const SceneFiles& files) {
  if (!scene_) return open(files);
  leave_points();
  load(request_with(document_, files));
}

/// A request of the scene shown changes what it looks like, at once; another is loaded.
void Viewer::open(Request request) {
  require_inputs(request.source);
  if (scene_ && is_of_scene(document_, request)) {
    request.view.width = std::max(picture_px().x, 1U);
    request.view.height = std::max(picture_px().y, 1U);
    const Finds finds{resolve(request, *scene_, document_.loaded->facts).exposes, !request.look.lights};
    document_ = shown_as(*scene_, document_, request);
    lit_by_ = document_.request.look.environment;
    renderer_.open(nullptr, document_, picture_px(), finds);
  } else {
    load(request);
  }
  asked_exposure_ev_ = request.look.exposure_ev;
  document_.request.look.exposure_ev = request.look.exposure_ev;
}

/// Points of the scene that is being made, more each time: where the camera was moved it stays.
void Viewer::show(OpenedPoints opened) {
  const bool moved = of_points_ && document_.camera != panels_.home;
  if (!of_points_) before_ = document_;
  opened.document.eye_dome = document_.eye_dome;
  opened.document.point_size = document_.point_size;
  of_points_ = true;
  panels_.home = opened.document.camera;
  if (moved) {
    opened.document.camera = document_.camera;
    opened.document.request.view.look_in = document_.request.view.look_in;
  }
  document_ = std::move(opened.document);
  renderer_.open_points(std::move(opened.points), document_, picture_px());
}

/// Goes back to the scene from the points of another that does not come; where there is none, they stay.
void Viewer::leave_points() {
  if (!of_points_ || !scene_) return;
  of_points_ = false;
  document_ = std::move(before_);
  renderer_.open_points(nullptr, document_, picture_px());
}

void Viewer::show(OpenedScene opened) {
  panels_.home = opened.document.camera;
  if (of_points_) {  // the view stays as it is
    opened.document.camera = document_.camera;
    opened.document.request.view.look_in = document_.request.view.look_in;
    document_ = std::move(before_);
    of_points_ = false;
  }
  const Finds finds{!asked_exposure_ev_ && opened.document.loaded->exposes,
                    !opened.document.loaded->asked.look.lights};
  const bool kept = exposure_of(document_) != found_exposure_ev_;
  opened.document.request.look.exposure_ev = asked_exposure_ev_.value_or(kept ? exposure_of(document_) : 0.0);
  opened.document.mode = document_.mode;
  opened.document.eye_dome = document_.eye_dome;
  opened.document.point_size = document_.point_size;
  document_ = std::move(opened.document);
  if (!scene_) {
    for (Request* asked : {&panels_.save, &panels_.sheet, &panels_.record}) {
      asked->view.width = std::max(picture_px().x, 1U);
      asked->view.height = std::max(picture_px().y, 1U);
      asked->settings.samples = document_.request.settings.samples;
    }
  }
  lit_by_ = document_.request.look.environment;
  scene_ = std::move(opened.scene);
  const SceneFiles& files = document_.loaded->asked.source.inputs;
  remember([&files](UserState& state) { remember_files(state, files); });
  panels_.can_add = true;
  history_.start(document_);
  cache_bytes_ = user_scene_cache().bytes();
  handle_.reset();
  about_world_.reset();
  viewpoint_ = Viewpoint::automatic;
  panels_.object = panels_.light = 0;
  inspected_.reset();
  resting_ = {};
  window_.set_title(scene_title(files) + " - splatray");
  renderer_.open(scene_, document_, picture_px(), finds);
}

/// Throws Error when there is no scene that a dropped file could change.
void Viewer::require_scene(const std::filesystem::path& file, const char* found) const {
  if (!scene_)
    throw Error(ExitCode::failed,
                "found '" + file.filename().string() + "', " + found + ", expected a scene first");
}

/// Files that were dropped or pasted: those of scenes make one.
void Viewer::take_files(const SceneFiles& files) {
  SceneFiles scene;
  for (const std::filesystem::path& file : files)
    drop_kind(file) == DropKind::scene ? scene.push_back(file) : take_file(file);
  if (scene.empty()) return;
  window_.is_down(GLFW_KEY_LEFT_SHIFT) || window_.is_down(GLFW_KEY_RIGHT_SHIFT) ? add(scene) : open(scene);
}

/// A file of no scene.
void Viewer::take_file(const std::filesystem::path& file) {
  switch (drop_kind(file)) {
    case DropKind::picture:
      return open(read_picture_request(file));
    case DropKind::environment:
      require_scene(file, "an environment");
      show_environment(file.string(), document_);
      return;
    case DropKind::camera:
      require_scene(file, "a camera");
      document_.camera = read_camera(file);
      return;
    case DropKind::scene:
    case DropKind::unknown:
      panels_.error = "found '" + file.filename().string() +
                      "', expected a scene, a model, an environment, a camera or a picture of splatray";
  }
}

/// A splatray-render command, or files as file managers copy them.
void Viewer::paste() {
  const std::string text = window_.clipboard();
  const std::vector<std::string> words = shell_words(text);
  if (!words.empty() && std::filesystem::path(words.front()).filename() == "splatray-render")
    return open(parse_command_line(text));
  take_files(pasted_files(text));
}

/// Keeps a change of what is remembered, and shows what other windows have added. Why it cannot be kept is reported once.
void Viewer::remember(const UserChange& change) {
  const std::optional<Failure> failure = attempt("keeping the viewer's state", [&] { user_.change(change); });
  const std::string before = std::exchange(unkept_, failure ? failure->sentence : std::string());
  if (!unkept_.empty() && unkept_ != before) {
    panels_.notice = unkept_;
    window_.wake();
  }
  panels_.recent_files = user_.state().recent_files;
  if (!scene_) return;
  const auto found = user_.state().bookmarks.find(scene_name(document_.loaded->asked.source.inputs));
  panels_.bookmarks = found != user_.state().bookmarks.end() ? found->second : Bookmarks();
}

/// Keeps the bookmarks that a command has set.
void Viewer::remember_bookmarks() {
  if (!scene_) return;
  const std::string name = scene_name(document_.loaded->asked.source.inputs);
  const Bookmarks now = panels_.bookmarks;
  const auto found = user_.state().bookmarks.find(name);
  const Bookmarks before = found != user_.state().bookmarks.end() ? found->second : Bookmarks();
  if (now == before) return;
  remember([name, now, before](UserState& state) {
    Bookmarks& kept = state.bookmarks[name];
    for (std::size_t i = 0; i < now.size(); ++i)
      if (now[i] != before[i]) kept[i] = now[i];
  });
}

void Viewer::empty_cache() {
  user_scene_cache().clear();
  cache_bytes_ = user_scene_cache().bytes();
  panels_.notice = "the cache of made scenes is empty";
}

/// Keeps what a person likes to have in any scene.
void Viewer::remember_choices() {
  const Choices now{document_.eye_dome, document_.point_size, panels_.walk_speed, panels_.shows_handles};
  if (now == choices_kept_) return;
  choices_kept_ = now;
  remember([now](UserState& state) { state.choices = now; });
}

void Viewer::remember_window() {
  const glm::uvec2 size = window_.size();
  if (size.x == 0 || size.y == 0 || size == window_kept_) return;
  window_kept_ = size;
  remember([size](UserState& state) { state.window_size = size; });
}

}  // namespace splatray
