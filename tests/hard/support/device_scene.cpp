#include "tests/hard/support/device_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "engine/device/vulkan/vulkan_device.h"
#include "engine/scene/splat.h"
#include "tests/all_tests.h"
#include "tests/trace/agreement.h"
#include "tests/trace/rays.h"

namespace splatray::testing {
namespace {

bool is_sound(const RayHit& hit) {
  if (hit.object == NO_OBJECT) return std::isinf(hit.t);
  const double length = glm::length(glm::dvec3(hit.normal));
  return std::isfinite(hit.t) && std::isfinite(hit.t_first) && std::abs(length - 1.0) < 1e-3;
}

constexpr std::size_t DEFAULT_RAYS = 1'000'000;
constexpr std::size_t RAYS_OF_A_LANDING = 10'000;
constexpr int MOST_AT_ONE_T = 64;          ///< discs that are met at the same t
constexpr double TIES_PER_MILLION = 20.0;  ///< measured: 1, of rays through lattice points 160
constexpr std::uint64_t TIES_OF_FEW = 20;  ///< where there are few rays, made to meet splats at equal t

/// Whether the answer's first splat meets the ray at the truth's t, by brute force itself without the splats that come before
/// it: so the ray is on its disc, on a side that counts, and leaves no sheet of it.
bool is_tie(const BruteForce& brute, const RayQuery& ray, const TrueHit& truth, const RayHit& answer) {
  if (!truth.found || answer.object == NO_OBJECT || answer.first == brute.words()[truth.first]) return false;
  BruteForce without = brute;
  TrueHit next = truth;
  for (int i = 0; i < MOST_AT_ONE_T && next.found; ++i) {
    const Splat& splat = brute.splats()[next.first];
    const double cosine = std::abs(glm::dot(splat.normal, glm::dvec3(ray.dir)));
    const double distance = glm::length(splat.center - glm::dvec3(ray.origin));
    if ((next.t_first - truth.t_first) * cosine > 0x1p-44 * distance) return false;
    if (brute.words()[next.first] == answer.first) return true;
    without.move_splat(next.first, glm::dvec3(1e12));
    next = without.nearest(ray, {});
  }
  return false;
}

}  // namespace

const Device& shared_device() {
  static const std::unique_ptr<Device> device = [] {
    const char* wanted = std::getenv("SPLATRAY_HARD_DEVICE");
    return wanted == nullptr ? std::make_unique<VulkanDevice>() : open_device(wanted);
  }();
  return *device;
}

std::size_t hard_rays() {
  const char* wanted = std::getenv("SPLATRAY_HARD_RAYS");
  if (wanted != nullptr) return static_cast<std::size_t>(std::stod(wanted));
  return all_or(DEFAULT_RAYS, RAYS_OF_A_LANDING);
}

std::uint32_t hard_width(std::uint32_t all) { return all_or(all, all / 2); }

std::uint64_t known_of(std::uint64_t by_default, std::uint64_t of_ten_million) {
  return hard_rays() <= DEFAULT_RAYS ? by_default : of_ten_million;
}

DeviceScene::DeviceScene(const Scene& scene, const Device& device) : tracer_(device) {
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
  // More than these are no accident of rounding, and all of them count.
  const auto most =
      std::max<std::uint64_t>(TIES_OF_FEW, std::uint64_t(TIES_PER_MILLION * 1e-6 * double(rays.size())));
  row.exceptions = agreement.exceptions() - (ties <= most ? ties : 0);
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
