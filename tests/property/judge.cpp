#include "tests/property/judge.h"

#include <algorithm>
#include <cmath>

#include "engine/scene/splat.h"
#include "tests/trace/agreement.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

constexpr double EXACT_SHARE = 0x1p-42;
constexpr double FLOAT_SHARE = 0x1p-21;
constexpr double ANSWER_STEP = 0x1p-22;
constexpr double EDGE_ON = 0x1p-16;
constexpr double EDGE = 1U << LATTICE_BITS;
constexpr int EXACT_TRIES = 512;
constexpr int FLOAT_TRIES = 16;
constexpr std::uint32_t MEMBERS_COMPARED = 500;

bool same_color(const TrueHit& truth, const RayHit& answer) {
  const dvec3 found(unpack_color(answer.color));
  const dvec3 step = 2.0 / 255.0 * glm::sqrt(glm::max(truth.color, 0.0)) + 2e-4;
  return answer.color == 0U || glm::all(glm::lessThanEqual(glm::abs(found - truth.color), step));
}

/// Whether the ray lies nearly in the plane of a disc that it passes.
bool is_edge_on(const BruteForce& brute, const RayQuery& ray) {
  const dvec3 dir = glm::normalize(dvec3(ray.dir));
  for (const Splat& splat : brute.splats()) {
    if (std::abs(glm::dot(splat.normal, dir)) > EDGE_ON) continue;
    const dvec3 beside = glm::cross(splat.center - dvec3(ray.origin), dir);
    if (glm::dot(beside, beside) <= 1.01 * splat.radius_squared + 1.0) return true;
  }
  return false;
}

/// How far the answer's t may be from the truth.
double depth_allowed(const RayQuery& ray, const TrueHit& truth, double radius) {
  const double way = std::max(std::abs(truth.t), ray.t_min < 0.0F ? 2.0 * EDGE : 0.0);
  return 0.01 * radius + ANSWER_STEP * way;
}

}  // namespace

Verdict Judge::compare(const BruteForce& brute, const RayQuery& ray, const TrueHit& truth,
                       const RayHit& answer) const {
  const Agreement agreement = agreement_of(brute, {truth}, {answer});
  if (agreement.exceptions() > 0) return Verdict::wrong;
  if (!truth.found || truth.members > MEMBERS_COMPARED) return Verdict::right;
  const double radius = std::sqrt(brute.splats()[truth.first].radius_squared);
  const bool same_members = settings_.blend == BLEND_NEAREST || agreement.members == 0;
  const bool same_cluster = same_members && agreement.normal == 0 && same_color(truth, answer) &&
                            agreement.depth_most * radius <= depth_allowed(ray, truth, radius);
  if (same_cluster) return Verdict::right;
  return is_edge_on(brute, ray) ? Verdict::edge_on : Verdict::wrong;
}

bool Judge::is_right_in_float32(const BruteForce& exact, const RayQuery& ray, const TrueHit& truth,
                                const RayHit& answer, std::uint64_t seed) const {
  Dice dice(seed);
  const dvec3 first_hit = dvec3(ray.origin) + truth.t_first * dvec3(ray.dir);
  const double window =
      10.0 * double(settings_.kappa) * std::sqrt(exact.splats()[truth.first].radius_squared);
  for (int attempt = 0; attempt < FLOAT_TRIES; ++attempt) {
    BruteForce moved = exact;
    for (std::size_t i = 0; i < moved.splats().size(); ++i) {
      const Splat& splat = moved.splats()[i];
      const double distance = glm::distance(splat.center, first_hit);
      if (distance >= window + 2.0 * std::sqrt(splat.radius_squared)) continue;
      moved.move_splat(i, FLOAT_SHARE * distance * dice.in_cube());
      if (i != truth.first) moved.turn_splat(i, FLOAT_SHARE * dice.in_cube());
    }
    const TrueHit hit = moved.nearest(ray, settings_);
    if (hit.found && hit.first == truth.first && is_right(moved, ray, hit, answer)) return true;
  }
  return false;
}

bool Judge::is_tie(const RayQuery& ray, const RayHit& answer) const {
  Dice dice(1);
  for (int attempt = 0; attempt < EXACT_TRIES; ++attempt) {
    const BruteForce moved = moved_in_favour(ray, answer, attempt % 2 == 0, dice);
    RayQuery turned = ray;
    turned.from_normal += vec3(FLOAT_SHARE * dice.in_cube());
    const TrueHit hit = moved.nearest(turned, settings_);
    if (is_right(moved, turned, hit, answer)) return true;
    const bool same_first =
        hit.found && answer.object != NO_OBJECT && moved.words()[hit.first] == answer.first;
    if (same_first && is_right_in_float32(moved, turned, hit, answer, dice.seed())) return true;
  }
  return false;
}

BruteForce Judge::moved_in_favour(const RayQuery& ray, const RayHit& answer, bool favour, Dice& dice) const {
  const dvec3 dir(ray.dir);
  const double along = dice.log_between(1e-8, 1.0);
  BruteForce moved = brute_;
  for (std::size_t i = 0; i < moved.splats().size(); ++i) {
    const Splat& splat = moved.splats()[i];
    const double distance = glm::distance(splat.center, dvec3(ray.origin));
    const bool of_sheet_left =
        splat.object == ray.from_object && distance < 4.5 * std::sqrt(splat.radius_squared);
    const double most = of_sheet_left ? FLOAT_SHARE * distance : EXACT_SHARE * (distance + EDGE);
    // What the ray starts on stays behind it; what it meets with the answer comes after that.
    const double cosine = glm::dot(splat.normal, dir);
    const double t = glm::dot(splat.normal, splat.center - dvec3(ray.origin)) / cosine;
    const bool earlier = moved.words()[i] == answer.first ||
                         t < double(answer.t_first) - 0.5 * std::abs(double(answer.t_first));
    const double later = (cosine > 0.0) == earlier ? -1.0 : 1.0;
    dvec3 by = dice.in_cube();
    if (favour) by += (later * along - glm::dot(by, splat.normal)) * splat.normal;
    moved.move_splat(i, most * by);
  }
  return moved;
}

Verdict Judge::judge(const RayQuery& ray, const TrueHit& truth, const RayHit& answer) const {
  const Verdict verdict = compare(brute_, ray, truth, answer);
  if (verdict != Verdict::wrong) return verdict;
  return is_tie(ray, answer) ? Verdict::tie : Verdict::wrong;
}

}  // namespace splatray::testing
