#include "app/cli/typical_work.h"

#include <algorithm>

#include "preprocess/read/formats.h"

namespace splatray {
namespace {

/// Of typical builds, measured with --stats-json of splatray-preprocess on an airborne LAZ of 2.6 million points and an E57 of 0.7
/// million, percent of the time, and how often each stage counts from 0 to 1.
const WorkPlan BUILD = {{"reading", 8}, {"sampling", 3},     {"normals", 59, 5}, {"radii", 15, 3},
                        {"packing", 6}, {"insertion", 5, 2}, {"slabs", 3},       {"empty space", 1}};

/// Seconds on two cores, from those builds and from pictures of 1280 x 720 and 16 samples (README.md): what a megabyte of points takes
/// until it is a scene, what one of a scene file takes, and what a million samples take.
constexpr double BUILD_S = 0.25, SCENE_S = 0.002, SAMPLES_S = 0.6;

double megabytes(const std::vector<std::filesystem::path>& inputs) {
  constexpr double MEGABYTE = 1e6;
  double bytes = 0.0;
  std::error_code error;
  for (const std::filesystem::path& input : inputs) {
    if (!std::filesystem::is_directory(input, error)) {
      const auto size = std::filesystem::file_size(input, error);
      bytes += error ? 0.0 : static_cast<double>(size);
      continue;
    }
    for (const auto& entry : std::filesystem::directory_iterator(input, error))
      bytes += find_format(entry.path()) != nullptr && entry.is_regular_file(error)
                   ? static_cast<double>(entry.file_size(error))
                   : 0.0;
  }
  return bytes / MEGABYTE;
}

bool is_a_scene(const Request::Source& source) {
  return !source.inputs.empty() && is_scene_file(source.inputs.front());
}

/// Seconds that tracing may take.
double tracing_s(const Shot& shot) {
  const PixelWindow made = shot.view.made();
  constexpr double MILLION = 1e6;
  const double samples = double(made.width) * made.height * shot.settings.samples / MILLION;
  const double goal = shot.request.settings.seconds_goal;
  return (goal > 0.0 ? goal : SAMPLES_S * samples) * static_cast<double>(pictures_of(shot));
}

}  // namespace

WorkPlan work_of_scene(const Request::Source& source) {
  return is_a_scene(source) ? WorkPlan{{"reading", 1.0}} : BUILD;
}

WorkPlan work_of_pictures(const Shot& shot) {
  const Request& request = shot.request;
  WorkPlan plan = work_of_scene(request.source);
  double cost = 0.0;
  for (const PlannedStage& stage : plan) cost += stage.cost;
  const double scene_s = megabytes(request.source.inputs) * (is_a_scene(request.source) ? SCENE_S : BUILD_S);
  constexpr double LEAST_S = 0.1;  // what any scene takes
  const double factor = std::max(scene_s, LEAST_S) / cost;
  for (PlannedStage& stage : plan) stage.cost *= factor;
  plan.push_back({"tracing", tracing_s(shot)});
  return plan;
}

std::size_t pictures_of(const Shot& shot) {
  const auto* orbit = std::get_if<Orbit>(&shot.output);
  return orbit != nullptr ? std::size_t{orbit->columns} * orbit->rows : shot.frames.size();
}

}  // namespace splatray
