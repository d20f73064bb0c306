#include "tests/hard/support/device_scene.h"

#include <cmath>
#include <cstdlib>

#include "tests/trace/agreement.h"
#include "tests/trace/rays.h"

namespace splatray::testing {
namespace {

bool is_sound(const RayHit& hit) {
  if (hit.object == NO_OBJECT) return std::isinf(hit.t);
  const double length = glm::length(glm::dvec3(hit.normal));
  return std::isfinite(hit.t) && std::isfinite(hit.t_first) && std::abs(length - 1.0) < 1e-3;
}

/// Whether both answers' first splats meet the ray at the same t, so that either may be the first.
bool is_tie(const BruteForce& brute, const RayQuery& ray, const TrueHit& truth, const RayHit& answer) {
  if (!truth.found || answer.object == NO_OBJECT || answer.first == brute.words()[truth.first]) return false;
  const Splat splat = unpack_splat(answer.first);
  const glm::dvec3 to_center = splat.center - glm::dvec3(ray.origin);
  const double cosine = glm::dot(splat.normal, glm::dvec3(ray.dir));
  const double t = glm::dot(splat.normal, to_center) / cosine;
  return std::abs((t - truth.t_first) * cosine) <= 0x1p-44 * glm::length(to_center);
}

}  // namespace

const Context& shared_context() {
  static const Context context;
  return context;
}

std::size_t hard_rays() {
  const char* wanted = std::getenv("SPLATRAY_HARD_RAYS");
  return wanted == nullptr ? 1'000'000 : static_cast<std::size_t>(std::stod(wanted));
}

DeviceScene::DeviceScene(const Scene& scene, const Context& context) : tracer_(context) {
  tracer_.upload(scene);
}

std::vector<RayHit> DeviceScene::intersect(std::span<const RayQuery> rays, Settings settings) {
  settings.counters = true;
  std::vector<RayHit> hits = tracer_.intersect(rays, settings);
  lost_ += counter(COUNT_LOST);
  for (const RayHit& hit : hits) non_finite_ += is_sound(hit) ? 0 : 1;
  return hits;
}

Image DeviceScene::render(const View& view, Settings settings, const Environment& environment) {
  settings.counters = true;
  tracer_.set_environment(environment);
  Image image = tracer_.render(view, settings);
  lost_ += counter(COUNT_LOST);
  non_finite_ += counter(COUNT_NON_FINITE);
  for (const vec4& pixel : image.rgba) non_finite_ += std::isfinite(glm::dot(pixel, vec4(1.0F))) ? 0 : 1;
  return image;
}

CaseRow DeviceScene::row(const std::string& compared) {
  const CaseRow row{.compared = compared, .lost = lost_, .non_finite = non_finite_};
  lost_ = non_finite_ = 0;
  return row;
}

RayQuery primary_ray(const glm::dvec3& origin, const glm::dvec3& dir) {
  RayQuery query{};
  query.origin = vec3(origin);
  query.dir = vec3(glm::normalize(dir));
  query.from_object = NO_OBJECT;
  return query;
}

CaseRow compare_answers(CaseRow row, const BruteForce& brute, const std::vector<RayQuery>& rays,
                        const std::vector<TrueHit>& truth, const std::vector<RayHit>& answers,
                        Compared compared) {
  const Agreement agreement = agreement_of(brute, truth, answers);
  std::uint64_t ties = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) ties += is_tie(brute, rays[i], truth[i], answers[i]) ? 1 : 0;
  row.count = agreement.rays;
  row.exceptions = agreement.exceptions() - ties;
  if (compared == Compared::blends) row.exceptions += agreement.members + agreement.normal;
  row.remark = std::to_string(agreement.hits) + " hits" +
               (ties > 0 ? ", " + std::to_string(ties) + " ties" : std::string());
  if (compared == Compared::hits)
    row.remark += ", " + std::to_string(agreement.normal) + " normals differ, up to " +
                  short_number(agreement.normal_most_deg) + "°";
  return row;
}

CaseRow compare_with_brute_force(DeviceScene& device, const BruteForce& brute,
                                 const std::vector<RayQuery>& rays, const std::string& what,
                                 Compared compared) {
  const std::vector<RayHit> answers = device.intersect(rays);
  return compare_answers(device.row(what + ": device, brute force"), brute, rays,
                         all_nearest(brute, rays, {}), answers, compared);
}

}  // namespace splatray::testing
