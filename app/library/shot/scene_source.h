/// From a request to the scene that is shown.
#pragma once
#include <functional>
#include <string>

#include "app/library/request/request.h"
#include "app/library/shot/scene_facts.h"
#include "app/library/shot/scene_levels.h"
#include "preprocess/build.h"

namespace splatray {

/// A scene and how it came to be.
struct LoadedScene {
  Scene scene;
  SceneFacts facts{};
  double load_ms = 0.0;             ///< reading and preprocess
  std::optional<BuildStats> build;  ///< unless read from a .soct
  ChosenNodes nodes{};              ///< that it has, of files in levels; empty: all
};

/// Who hears of loading, on its thread; each may be empty.
struct LoadListener {
  Progress progress;  ///< returns false to stop: load_scene then throws Error (interrupted)
  std::function<void(const std::string&)> note;  ///< a sentence about something odd in the files
  PointsListener points{};                       ///< as ReadOptions::points
};

/// Reads or preprocesses the scene, of files in levels what the request's pictures need; applies --material, --object, --up (else upright of upright.h), and shows the attributes that are
/// asked for or suit the scene. Throws Error.
[[nodiscard]] LoadedScene load_scene(const Request& request, const LoadListener& listener);

/// The facts of the first levels of files in levels, with these as their overview. Throws Error.
[[nodiscard]] SceneFacts load_overview(const Request& request, const InLevels& files,
                                       const LoadListener& listener);
/// The scene that the request's pictures need of files of which this is the overview; without a scene where these are the nodes that are
/// `shown`. Throws Error.
[[nodiscard]] LoadedScene load_needed(const Request& request, const InLevels& files,
                                      const SceneFacts& overview, const LoadListener& listener,
                                      const ChosenNodes& shown = {});

/// A scene of these nodes of the files, in what is chosen of the overview. Throws Error.
[[nodiscard]] Scene load_nodes_of(const Request& request, const SceneFacts& overview,
                                  const ChosenNodes& nodes, const LoadListener& listener);

/// The same of objects that are in memory, without what files alone have; their numbers stay. Throws Error.
[[nodiscard]] LoadedScene load_objects(Input input, const Request& request, const LoadListener& listener);

/// What the scene's objects look like with --material and --object. Throws Error (usage).
[[nodiscard]] std::vector<Material> choose_materials(const Scene& scene, const Request& request);

}  // namespace splatray
