/// What a person looks at and changes in the viewer: one value, from which a picture, a command line and a saved file are
/// made. The window's thread owns it; other threads get copies.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "app/library/measure/measure.h"
#include "app/library/request/request.h"
#include "app/library/shot/scene_facts.h"
#include "engine/image/view.h"
#include "engine/scene/scene.h"

namespace splatray {

/// What a pixel shows.
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

/// What stays as it was loaded.
struct LoadedPart {
  Request asked;                             ///< files, how points are made of them, and how they are shown
  SceneFacts facts{};                        ///< of the scene in its own colours
  std::uint32_t look = LOOK_LIT;             ///< as first shown
  std::vector<std::string> object_names;     ///< one per object
  ObjectLooks looks{};                       ///< one per object, as the scene has them
  std::vector<std::string> color_sources{};  ///< attributes that colours may show (attributes.h)
  std::vector<Category> classes{}, scans{};  ///< of the points; empty = not known
  std::string crs{};                         ///< Scene::crs
  bool is_scan = false;                      ///< its exposure is automatic where nothing is said of it
};

struct Document {
  std::shared_ptr<const LoadedPart> loaded = std::make_shared<const LoadedPart>();  ///< shared by all copies
  ObjectLooks looks;  ///< as shown; hidden objects have MATERIAL_HIDDEN
  std::vector<SceneLight> lights;
  std::string environment;  ///< as --environment has it
  Camera camera;
  Settings settings;     ///< samples: where a still picture stops
  RegionRequest region;  ///< what of the scene is shown; Settings::region is made of it
  double exposure_ev = 0.0;
  Tone tone = Tone::neutral;
  ViewMode mode = ViewMode::shaded;
  double eye_dome = 1.0;          ///< strength of the shading of what moves and of points, as eye_dome has it
  double point_size = 1.0;        ///< of points, in their spacings
  std::vector<Measure> measures;  ///< in the order they were made
  AttributeOptions attributes;    ///< what is shown of the points' attributes
  glm::dvec3 up{0.0, 1.0, 0.0};   ///< the scene's up axis: of orbits, framing and the environment
  glm::dvec3 bounds_min_world{0.0};  ///< of the scene's splat centres
  glm::dvec3 bounds_max_world{0.0};
};

}  // namespace splatray
