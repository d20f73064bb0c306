#include "app/library/shot/scene_source.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "app/library/materials.h"
#include "app/library/shot/resolve.h"
#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/file/scene_file.h"
#include "engine/image/upright.h"
#include "preprocess/base/file_extension.h"
#include "preprocess/base/quoted_list.h"
#include "preprocess/read/scan/missing_attributes.h"

namespace splatray {
namespace {

void report_progress(const LoadListener& listener, const char* stage, double share) {
  if (listener.progress && !listener.progress(stage, share))
    throw Error(ExitCode::interrupted, "loading was interrupted");
}

ReadOptions reading_of(const Request& request, const Progress& progress) {
  ReadOptions reading = read_options(request.source, progress);
  reading.turn_outwards = !request.look.material.empty() &&
                          (named_material(request.look.material).flags & MATERIAL_DIELECTRIC) != 0;
  return reading;
}

/// What those who make pictures and measures may do about the up direction; a scene file is shown, and its up asked, later.
constexpr const char* UP_SAYS_OTHERWISE = "; --up=X,Y,Z says otherwise";

/// Builds the scene of objects whose points are there.
void build(Input input, const Request& request, const LoadListener& listener, const Progress& progress,
           LoadedScene& loaded) {
  const auto report_notes = [&](const std::vector<std::string>& notes) {
    if (listener.note) std::for_each(notes.begin(), notes.end(), listener.note);
  };
  report_notes(input.notes);
  if (request.source.params.ground && request.look.up) input.up = request.look.up;
  BuildStats& stats = loaded.build.emplace();
  loaded.scene =
      build_scene(std::move(input), request.source.params, request.source.threads, stats, progress);
  const std::string up = up_note(loaded.scene.up);
  if (request.look.up) std::erase(stats.notes, up);  // the request says otherwise
  std::replace(stats.notes.begin(), stats.notes.end(), up, up + UP_SAYS_OTHERWISE);
  report_notes(stats.notes);
}

/// Applies --material, --object, --up (else upright of upright.h), and shows the attributes that are asked for or suit the scene.
void show_as_asked(const Request& request, const LoadListener& listener, LoadedScene& loaded) {
  Scene& scene = loaded.scene;
  scene.materials = choose_materials(scene, request);
  const UpFound found = resolve_up(scene, request);
  const glm::dvec3 format_up = std::exchange(scene.up, found.up);
  if (listener.note && !request.look.up && scene.up != format_up)
    listener.note(up_note(scene.up) + UP_SAYS_OTHERWISE);
  loaded.facts = facts_of(scene);
  loaded.facts.up = found;
  const AttributeOptions attributes = resolve_attributes(request, loaded.facts);
  if (request.look.attributes.color_by.empty()) loaded.facts.color_by = attributes.color_by;
  loaded.facts.legend = show_attributes(scene, attributes);
}

/// The scene of the inputs, of those in levels the nodes that are named.
LoadedScene load_nodes(const Request& request, const ChosenNodes& nodes, const LoadListener& listener) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  LoadedScene loaded;
  report_progress(listener, "reading", 0.0);
  const std::vector<std::filesystem::path>& inputs = request.source.inputs;
  if (is_scene_file(inputs.front())) {
    if (request.source.params.ground)
      throw Error(ExitCode::usage,
                  "found --ground with a .soct, expected files of points or meshes, or splatray-preprocess "
                  "--ground");
    loaded.scene = read_scene(inputs.front(), listener.progress);
    const std::string missing = missing_attributes(request.source.scans.attributes, loaded.scene.columns);
    if (listener.note && !missing.empty()) listener.note(missing);
  } else {
    const Progress progress = watching_memory(listener.progress);
    ReadOptions reading = reading_of(request, progress);
    reading.points = listener.points;
    reading.nodes = nodes;
    build(read_input(inputs, reading), request, listener, progress, loaded);
  }
  loaded.load_ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  show_as_asked(request, listener, loaded);
  return loaded;
}

/// The request with what is chosen of the overview's values.
Request as_chosen(const Request& request, const SceneFacts& facts) {
  Request chosen = request;
  AttributeOptions& attributes = chosen.look.attributes;
  attributes = resolve_attributes(request, facts);
  const ColorLegend& legend = facts.legend;
  if (!attributes.color_range && !legend.ramp.empty()) attributes.color_range = {legend.low, legend.high};
  chosen.look.up = facts.overview->up;
  return chosen;
}

}  // namespace

SceneFacts load_overview(const Request& request, const InLevels& files, const LoadListener& listener) {
  LoadedScene overview = load_nodes(request, overview_of(files), {listener.progress, {}, listener.points});
  overview.facts.overview = std::make_shared<const Scene>(std::move(overview.scene));
  return std::move(overview.facts);
}

LoadedScene load_needed(const Request& request, const InLevels& files, const SceneFacts& overview,
                        const LoadListener& listener, const ChosenNodes& shown) {
  const Scene& whole = *overview.overview;
  const Shot shot = resolve(request, whole, overview);
  NeededNodes needed = needed_nodes(request, all_views(shot, whole), files);
  LoadedScene loaded;
  if (needed.nodes != shown) {
    if (listener.note) listener.note(read_note(request, files, needed));
    loaded = load_nodes(as_chosen(request, overview), needed.nodes, {listener.progress, listener.note});
  }
  ColorLegend legend = std::move(loaded.facts.legend);
  loaded.facts = overview;
  loaded.facts.legend = std::move(legend);
  loaded.facts.lod = needed.lod;
  loaded.nodes = std::move(needed.nodes);
  return loaded;
}

Scene load_nodes_of(const Request& request, const SceneFacts& overview, const ChosenNodes& nodes,
                    const LoadListener& listener) {
  return std::move(load_nodes(as_chosen(request, overview), nodes, listener).scene);
}

LoadedScene load_scene(const Request& request, const LoadListener& listener) {
  require_scene_alone(request.source.inputs);
  const InLevels files = in_levels(request);
  if (files.paths.empty()) return load_nodes(request, {}, listener);
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  LoadedScene loaded = load_needed(request, files, load_overview(request, files, listener), listener);
  loaded.load_ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  return loaded;
}

LoadedScene load_objects(Input input, const Request& request, const LoadListener& listener) {
  LoadedScene loaded;
  const Progress progress = watching_memory(listener.progress);
  finish_objects(input, reading_of(request, progress));
  build(std::move(input), request, listener, progress, loaded);
  show_as_asked(request, listener, loaded);
  return loaded;
}

std::vector<Material> choose_materials(const Scene& scene, const Request& request) {
  std::vector<Material> materials = scene.materials;
  std::vector<ObjectChange> changes;
  if (!request.look.material.empty()) {
    const std::size_t shown = scene.materials.size() - (scene.build.ground ? 1 : 0);
    if (shown != 1)
      throw Error(ExitCode::usage, "found --material with a scene of " + std::to_string(shown) +
                                       " objects, expected one object, or --object for one of these: " +
                                       quoted_list(scene.object_names));
    changes.push_back(read_object_change("0:preset=" + request.look.material));
  }
  changes.insert(changes.end(), request.look.objects.begin(), request.look.objects.end());
  apply_object_changes(changes, scene.object_names, materials);
  return materials;
}

}  // namespace splatray
