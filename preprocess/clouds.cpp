#include "preprocess/clouds.h"

#include <algorithm>
#include <string>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/number_text.h"
#include "preprocess/base/counted_list.h"

namespace splatray {
namespace {

constexpr double LEAST_STEPS = 1000.0;  // of the lattice across an object whose shape it keeps

std::string counted_points(std::uint64_t count) {
  return std::to_string(count) + (count == 1 ? " point" : " points");
}

/// What is said of an object's far points.
std::string far_note(const std::string& name, const Cloud& cloud) {
  const FarPoints& far = cloud.far;
  const bool one = far.numbers.size() == 1;
  const std::string range = far.nearest_world == far.farthest_world
                                ? short_number(far.nearest_world)
                                : short_number(far.nearest_world) + " to " + short_number(far.farthest_world);
  const std::string place = (one ? " lies " : " lie ") + range + " away from all others, which are " +
                            short_number(longest_side(far.others)) + " across";
  const std::string found = "object '" + name + "': " + counted_points(far.numbers.size());
  return cloud.measured ? found + (one ? " was" : " were") + " left out: " + (one ? "it" : "they") + place
                        : found + place + (one ? "; it blurs" : "; they blur") + " the others";
}

}  // namespace

std::vector<Cloud> make_clouds(Input& input, const std::vector<std::string>& names, BuildStats& stats) {
  std::vector<Cloud> clouds;
  for (InputObject& object : input.objects) {
    const bool measured =
        object.measured && !object.oriented && !(object.surface_area > 0.0) && !object.points.lattice;
    clouds.push_back(make_cloud(std::move(object.points), object.oriented, measured, stats));
    clouds.back().on_facets = object.surface_area > 0.0;
    if (!clouds.back().far.numbers.empty())
      stats.notes.push_back(far_note(names[clouds.size() - 1], clouds.back()));
  }
  if (stats.points_read == 0)
    throw Error(ExitCode::input_unreadable, "the input has no points, expected at least one");
  if (stats.points_read == stats.dropped_non_finite)
    throw Error(ExitCode::input_unreadable,
                "the input has no usable point: found " + counted_points(stats.points_read) +
                    " with positions that are not finite or beyond 1e100, expected at least one other");
  return clouds;
}

void require_points(const std::vector<Cloud>& clouds, const BuildStats& stats) {
  if (std::any_of(clouds.begin(), clouds.end(), [](const Cloud& cloud) { return cloud.size() > 0; })) return;
  const std::pair<std::uint64_t, const char*> lost[] = {
      {stats.dropped_non_finite, "not finite or beyond 1e100"},
      {stats.dropped_far, "far from all others"},
      {stats.dropped_isolated, "isolated"},
      {stats.dropped_mixed, "between two surfaces"},
      {stats.dropped_unsupported, "with too few neighbours"}};
  throw Error(ExitCode::input_unreadable, "the input has no point on a surface: found " +
                                              counted_points(stats.points_read) + ", of them " +
                                              counted_list(lost) + ", expected at least one other");
}

void note_coarse_objects(const std::vector<Cloud>& clouds, const std::vector<std::string>& names,
                         double step_world, BuildStats& stats) {
  std::size_t coarse = 0, smallest = 0;
  double least = LEAST_STEPS * step_world;
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    const double side = longest_side(clouds[i].far.others);
    if (!(side > 0.0 && side < LEAST_STEPS * step_world)) continue;
    ++coarse;
    if (side < least) least = side, smallest = i;
  }
  if (coarse == 0) return;
  stats.notes.push_back(
      "object '" + names[smallest] + "' is " + short_number(least) +
      " across in a scene whose coordinates have steps of " + short_number(step_world) +
      (coarse > 1 ? ", and " + std::to_string(coarse - 1) + " more are less than 1000 steps" : "") +
      ": such shapes are coarse beside what is so large or far away");
}

}  // namespace splatray
