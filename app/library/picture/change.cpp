#include "app/library/picture/change.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "app/library/picture/aimed_ray.h"
#include "app/library/shot/scene_on_device.h"
#include "engine/base/error.h"
#include "engine/scene/scene_splat.h"
#include "preprocess/base/select.h"

namespace splatray {
namespace {

constexpr std::size_t SPLATS_AT_ONCE = std::size_t{1} << 16;
/// Rays begin so far behind the splat, lattice units: a surface through its centre is not missed.
constexpr double BEHIND = 4.0;

/// Distances along one direction of each normal to the earlier scene; infinite for none.
class Probe {
 public:
  Probe(const Scene& scene, const Scene& earlier, SceneOnDevice& shown)
      : scene_(scene), earlier_(earlier), shown_(shown) {
    look_ = shown.look();
    for (Material& material : look_.materials) material.flags |= MATERIAL_TWO_SIDED;
  }

  /// How far the surface lies from the splats from `begin` on, along their normals (1) or against them (-1).
  [[nodiscard]] std::vector<double> reach(std::size_t begin, std::size_t count, double way) {
    const double behind_world = BEHIND * earlier_.root.unit_world;
    std::vector<double> distances(count, INFINITY);
    std::vector<RayQuery> queries;
    std::vector<std::size_t> number;
    std::vector<double> start;
    for (std::size_t i = 0; i < count; ++i) {
      const SceneSplat splat = splat_at(scene_, begin + i);
      const glm::dvec3 dir = way * splat.normal();
      const auto aimed = aim_ray(earlier_.root, splat.center_world() - behind_world * dir, dir);
      if (!aimed) continue;
      queries.push_back(aimed->query);
      number.push_back(i);
      start.push_back(aimed->start);
    }
    const std::vector<RayHit> hits = shown_.tracer().intersect(look_, queries, Settings{});
    for (std::size_t n = 0; n < hits.size(); ++n)
      if (hits[n].object != NO_OBJECT)
        distances[number[n]] = (start[n] + double{hits[n].t}) * earlier_.root.unit_world - behind_world;
    return distances;
  }

 private:
  const Scene& scene_;
  const Scene& earlier_;
  SceneOnDevice& shown_;
  Look look_;
};

ChangeFound judge(const std::vector<float>& changes, double noise, double earlier_noise) {
  constexpr double SURE = 1.96;  // standard deviations
  ChangeFound found;
  std::vector<double> sizes;
  for (const float change : changes)
    if (std::isfinite(change)) sizes.push_back(std::abs(double{change}));
  found.met = sizes.size();
  if (noise > 0.0 && earlier_noise > 0.0) found.significant_world = SURE * std::hypot(noise, earlier_noise);
  found.significant = static_cast<std::uint64_t>(
      std::count_if(sizes.begin(), sizes.end(), [&](double size) { return size > found.significant_world; }));
  if (!sizes.empty()) found.median_world = median_of(std::span(sizes));
  return found;
}

}  // namespace

ChangeFound add_change(Scene& scene, const Scene& earlier, const Device& device, const Progress& progress) {
  SceneOnDevice shown(device);
  shown.open(earlier);
  Probe probe(scene, earlier, shown);
  std::vector<float> changes;
  const std::size_t splats = splat_count(scene);
  changes.reserve(splats);
  for (std::size_t begin = 0; begin < splats; begin += SPLATS_AT_ONCE) {
    if (progress && !progress("comparing", static_cast<double>(begin) / static_cast<double>(splats)))
      throw Error(ExitCode::interrupted, "comparing the scenes was interrupted");
    const std::size_t count = std::min(SPLATS_AT_ONCE, splats - begin);
    const std::vector<double> before = probe.reach(begin, count, 1.0),
                              behind = probe.reach(begin, count, -1.0);
    for (std::size_t i = 0; i < count; ++i) {
      const double change = std::abs(before[i]) < std::abs(behind[i]) ? -before[i] : behind[i];
      changes.push_back(std::isfinite(change) ? static_cast<float>(change) : NAN);
    }
  }
  const ChangeFound found =
      judge(changes, most_noise_world(scene.stations), most_noise_world(earlier.stations));
  std::erase_if(scene.columns, [](const Column& column) { return column.name == COLUMN_CHANGE; });
  if (scene.columns.size() >= COLUMNS_MOST)
    throw Error(ExitCode::usage, "found " + std::to_string(scene.columns.size()) +
                                     " attributes of points, expected fewer beside the one of changes");
  scene.columns.push_back({std::string(COLUMN_CHANGE), std::move(changes)});
  return found;
}

}  // namespace splatray
