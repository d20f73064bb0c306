#include "tests/bench/exact/exact_count.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/scene/splat.h"
#include "tests/bench/exact/exact_scenes.h"
#include "tests/trace/agreement.h"
#include "tests/trace/rays.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

/// Share of the distances involved that the shaders' arithmetic is exact to.
constexpr double EXACT_SHARE = 0x1p-44;
/// Bounces of a path, at most.
constexpr int MOST_BOUNCES = 6;

/// Whether the answer's first splat is another, whose disc the ray meets at the same t, so that either may be the first.
bool is_tie(const BruteForce& brute, const RayQuery& ray, const TrueHit& truth, const RayHit& answer) {
  if (!truth.found || answer.object == NO_OBJECT || answer.first == brute.words()[truth.first]) return false;
  const Splat splat = unpack_splat(answer.first);
  const dvec3 to_center = splat.center - dvec3(ray.origin);
  const double cosine = glm::dot(splat.normal, dvec3(ray.dir));
  const double t = glm::dot(splat.normal, to_center) / cosine;
  const dvec3 from_center = t * dvec3(ray.dir) - to_center;
  return std::abs((t - truth.t_first) * cosine) <= EXACT_SHARE * glm::length(to_center) &&
         glm::dot(from_center, from_center) <= splat.radius_squared * (1.0 + 1e-9);
}

}  // namespace

void ExactCount::add(const ExactCount& more) {
  rays += more.rays;
  hits += more.hits;
  hit_or_miss += more.hit_or_miss;
  first_splat += more.first_splat;
  ties += more.ties;
  members += more.members;
  normals += more.normals;
}

ExactCount count_different(const BruteForce& brute, const std::vector<RayQuery>& rays,
                           const std::vector<TrueHit>& truth, const std::vector<RayHit>& answers) {
  const Agreement agreement = agreement_of(brute, truth, answers);
  ExactCount count{.rays = rays.size(), .hits = agreement.hits, .hit_or_miss = agreement.hit_or_miss};
  for (std::size_t i = 0; i < rays.size(); ++i)
    count.ties += is_tie(brute, rays[i], truth[i], answers[i]) ? 1 : 0;
  count.first_splat = agreement.first_splat - count.ties;
  count.members = agreement.members;
  count.normals = agreement.normal;
  return count;
}

ExactScene::ExactScene(const Device& device, Scene scene, bool in_regions)
    : scene_(std::move(scene)), in_regions_(in_regions), tracer_(device), brute_(scene_) {
  tracer_.upload(scene_);
}

void ExactScene::look(const std::vector<Material>& materials) {
  scene_.materials = materials;
  tracer_.set_materials(materials);
  brute_.set_materials(materials);
}

ExactScene::Traced ExactScene::compare(std::vector<RayQuery> rays, ExactCount& count) {
  Traced traced{std::move(rays), {}};
  if (traced.rays.empty()) return traced;
  traced.hits = all_nearest(brute_, traced.rays, settings_);
  count.add(count_different(brute_, traced.rays, traced.hits, tracer_.intersect(traced.rays, settings_)));
  return traced;
}

void ExactScene::count_paths(const Traced& first, Next next, std::size_t rays, const dvec3& to_light,
                             ExactCount& count) {
  Traced last = first;
  for (int bounce = 0; bounce < MOST_BOUNCES && count.rays < rays; ++bounce) {
    std::vector<RayQuery> following = following_rays(scene_, last.rays, last.hits, next, to_light);
    following.resize(std::min(following.size(), rays - static_cast<std::size_t>(count.rays)));
    last = compare(std::move(following), count);
    if (next == Next::shadow || last.rays.empty()) return;
  }
}

void ExactScene::count(std::size_t rays, std::uint64_t seed, const Report& report) {
  Dice dice(seed);
  if (in_regions_) settings_.region = random_region(scene_, dice);
  look(materials_with(scene_, seed % 2 == 0 ? Sides::one : Sides::both));
  ExactCount primary, shadow, mirrored, refracted, random;
  const Traced first = compare(random_primary_rays(scene_, rays, dice.seed()), primary);
  report("primary", primary);
  for (int light = 0; light < MOST_BOUNCES && shadow.rays < rays; ++light)
    count_paths(first, Next::shadow, rays, dice.direction(), shadow);
  report("shadow", shadow);
  count_paths(first, Next::mirrored, rays, {}, mirrored);
  report("mirrored", mirrored);
  compare(rays_from_anywhere(rays, dice), random);
  report("random", random);
  for (const std::string_view kind : ADVERSARIAL) {
    ExactCount adversarial;
    compare(adversarial_rays(kind, brute_, rays / 10, dice), adversarial);
    report(std::string(kind), adversarial);
  }
  look(materials_with(scene_, Sides::glass));
  ExactCount seen;
  count_paths(compare(random_primary_rays(scene_, rays, dice.seed()), seen), Next::refracted, rays, {},
              refracted);
  report("refracted", refracted);
}

}  // namespace splatray::testing
