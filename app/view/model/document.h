/// What a person looks at and changes in the viewer: one value, from which a picture, a command line and a saved file are
/// made. The window's thread owns it; other threads get copies.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "app/library/measure/measure_words.h"
#include "app/library/request/request.h"
#include "app/library/shot/scene_facts.h"
#include "engine/image/view.h"
#include "engine/scene/scene.h"

namespace splatray {

/// What a pixel shows; its row in false_color.cpp has its name, value and legend.
enum class ViewMode {
  shaded,
  normal,  ///< world normal, each axis -1..1 as 0..1
  depth,   ///< distance from the eye
  object,  ///< a colour per object
  splat,   ///< a colour per splat
  facing,  ///< back faces red
  tests,   ///< heat map of splat tests
  steps    ///< heat map of node words read
};
inline constexpr int VIEW_MODE_COUNT = static_cast<int>(ViewMode::steps) + 1;

/// What stays as it was loaded.
struct LoadedPart {
  Request asked;                             ///< files, how points are made of them, and how they are shown
  Request first;                             ///< what was shown of it first, as Document::request
  SceneFacts facts{};                        ///< of the scene in its own colours
  std::vector<std::string> object_names;     ///< one per object
  std::vector<Material> materials{};         ///< one per object, as the scene has them
  std::vector<std::string> color_sources{};  ///< attributes that colours may show (attributes.h)
  std::vector<Category> classes{}, scans{};  ///< of the points; empty = not known
  std::string crs{};                         ///< Scene::crs
  bool is_scan = false;
  bool exposes = false;  ///< Shot::exposes of `asked`
};

/// A request without what is left open about it for a scene, and what no request has: how one looks at it.
struct Document {
  std::shared_ptr<const LoadedPart> loaded = std::make_shared<const LoadedPart>();  ///< shared by all copies
  /// What is shown, but for camera and changes of objects, and nothing of files; samples: where a still picture stops. What the
  /// tracer needs follows from it (resolve_settings, resolve_lights).
  Request request;
  Camera camera;
  std::vector<Material> materials;  ///< one per object, as shown; hidden objects have MATERIAL_HIDDEN
  ViewMode mode = ViewMode::shaded;
  double eye_dome = 1.0;          ///< strength of the shading of what moves and of points, as eye_dome has it
  double point_size = 1.0;        ///< of points, in their spacings
  std::vector<Measure> measures;  ///< in the order they were made
  glm::dvec3 bounds_min_world{0.0};  ///< of the scene's splat centres
  glm::dvec3 bounds_max_world{0.0};
};

/// The scene's up axis: of orbits, framing and the environment.
[[nodiscard]] inline glm::dvec3 up_of(const Document& document) {
  return document.request.look.up.value_or(glm::dvec3(0.0, 1.0, 0.0));
}
/// What the document's measures share.
[[nodiscard]] inline MeasureFrame measure_frame(const Document& document) {
  return {up_of(document), document.loaded ? document.loaded->crs : std::string()};
}
/// LOOK_*.
[[nodiscard]] inline std::uint32_t look_of(const Document& document) {
  return document.request.look.style.value_or(document.loaded->first.look.style.value_or(LOOK_LIT));
}
/// Stops.
[[nodiscard]] inline double exposure_of(const Document& document) {
  return document.request.look.exposure_ev.value_or(0.0);
}
/// To be changed; all of them have their power.
[[nodiscard]] inline std::vector<LightRequest>& lights_of(Document& document) {
  std::optional<std::vector<LightRequest>>& lights = document.request.look.lights;
  return lights ? *lights : lights.emplace();
}

}  // namespace splatray
