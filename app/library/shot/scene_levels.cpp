#include "app/library/shot/scene_levels.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "app/library/shot/level_cut.h"
#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "preprocess/read/formats.h"
#include "preprocess/read/scan/input_files.h"

namespace splatray {
namespace {

/// Scans of so few points are read whole.
constexpr std::uint64_t FEW_POINTS = 250'000;
/// Enough to show what a scan is: what decides looks at 65 536 points of a scene at most. The first picture waits for them.
constexpr std::uint64_t OVERVIEW_POINTS = 100'000;

/// How many points the memory that a request may take holds.
std::uint64_t most_points(const Request& request) {
  constexpr std::uint64_t POINT_BYTES = 190;  // while a scene is made of a scan
  constexpr double SHARE = 0.6;
  const std::uint64_t there = available_memory();
  const std::uint64_t usual = there == std::numeric_limits<std::uint64_t>::max()
                                  ? there
                                  : static_cast<std::uint64_t>(SHARE * static_cast<double>(there));
  const std::uint64_t asked = request.source.memory_bytes;
  return (asked > 0 ? asked : usual) / POINT_BYTES;
}

}  // namespace

std::uint64_t InLevels::points() const {
  std::uint64_t sum = 0;
  for (const Levels& one : levels) sum += one.points();
  return sum;
}

std::uint64_t InLevels::points(const ChosenNodes& nodes) const {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < paths.size(); ++i)
    for (const std::uint32_t node : nodes.at(paths[i])) sum += levels[i].nodes[node].points;
  return sum;
}

std::uint64_t InLevels::loaded(const ChosenNodes& nodes) const {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    LoadCount count(levels[i]);
    for (const std::uint32_t node : nodes.at(paths[i])) count.add(node);
    sum += count.sum();
  }
  return sum;
}

InLevels in_levels(const Request& request) {
  InLevels files;
  if (request.source.lod == 0.0 || is_scene_file(request.source.inputs.front())) return files;
  for (const InputFile& file : input_files(request.source.inputs)) {
    Levels levels = levels_of(file.path);
    if (levels.nodes.empty()) continue;
    files.paths.push_back(file.path);
    files.levels.push_back(std::move(levels));
  }
  return files.points() > FEW_POINTS ? files : InLevels{};
}

ChosenNodes overview_of(const InLevels& files) {
  ChosenNodes nodes;
  for (std::size_t i = 0; i < files.paths.size(); ++i)
    nodes[files.paths[i]] = first_levels(files.levels[i], OVERVIEW_POINTS / files.paths.size());
  return nodes;
}

NeededNodes needed_nodes(const Request& request, const std::vector<View>& views, const InLevels& files) {
  LevelCut cut;
  cut.views = views;
  cut.spacing_px = request.source.lod.value_or(1.0);
  cut.most_points = most_points(request);
  if (asks_for_materials(request.look)) cut.unseen_factor = 1.0;  // mirrors show it
  cut.z_scale = request.source.scans.z_scale;
  const CutLevels chosen = cut_levels(files.levels, cut);
  NeededNodes needed{{}, chosen.spacing_px};
  for (std::size_t i = 0; i < files.paths.size(); ++i) needed.nodes[files.paths[i]] = chosen.nodes[i];
  return needed;
}

std::string read_note(const Request& request, const InLevels& files, const NeededNodes& needed) {
  const std::uint64_t points = files.points(needed.nodes);
  std::string why = "as the pictures need; --lod 0 reads all";
  if (files.loaded(needed.nodes) > most_points(request))
    why = "the coarsest level, which takes more memory than there is or --max-memory says";
  else if (needed.lod > request.source.lod.value_or(1.0))
    why = "as memory holds, of which --max-memory may say more; the pictures need finer ones";
  return "read " + std::to_string(points) + " of " + std::to_string(files.points()) + " points in levels, " +
         why;
}

ChosenNodes with_all_seen(const Request& request, const std::vector<View>& parts, const InLevels& files,
                          const ChosenNodes& nodes) {
  LevelCut cut;
  cut.views = parts;
  cut.spacing_px = 0.0;
  cut.unseen_factor = std::numeric_limits<double>::infinity();
  cut.z_scale = request.source.scans.z_scale;
  const CutLevels seen = cut_levels(files.levels, cut);
  ChosenNodes all = nodes;
  for (std::size_t i = 0; i < files.paths.size(); ++i) {
    std::vector<std::uint32_t>& of_file = all[files.paths[i]];
    const std::vector<std::uint32_t> before = std::exchange(of_file, {});
    std::set_union(before.begin(), before.end(), seen.nodes[i].begin(), seen.nodes[i].end(),
                   std::back_inserter(of_file));
  }
  const std::uint64_t points = files.loaded(all), most = most_points(request);
  if (points > most)
    throw Error(ExitCode::out_of_memory, "--lod-error takes " + std::to_string(points) +
                                             " points, expected at most the " + std::to_string(most) +
                                             " that fit (--max-memory)");
  return all;
}

}  // namespace splatray
