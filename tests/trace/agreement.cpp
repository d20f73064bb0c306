#include "tests/trace/agreement.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "shaders/lang/hit_numbers.h"
#include "tests/trace/different_bits.h"

namespace splatray::testing {
namespace {

/// Between neighbours of float32 at the larger of two numbers.
double step_of(float a, float b) {
  const float larger = std::max(std::abs(a), std::abs(b));
  return double(std::nextafter(larger, std::numeric_limits<float>::infinity())) - double(larger);
}

/// |a - b|, none where both are the same infinity.
double apart(float a, float b) { return a == b ? 0.0 : std::abs(double(a) - double(b)); }

bool finite(const RayHit& hit) {
  return std::isfinite(hit.t) && std::isfinite(hit.t_first) &&
         std::isfinite(hit.normal.x + hit.normal.y + hit.normal.z);
}

bool same_decisions(const RayHit& a, const RayHit& b) {
  if (a.object != b.object || a.first != b.first || a.members != b.members) return false;
  return a.object == NO_OBJECT || finite(a) == finite(b);
}

double colors_apart(std::uint32_t a, std::uint32_t b) {
  int most = 0;
  for (int shift = 0; shift < 32; shift += 8)
    most = std::max(most, std::abs(int(a >> shift & 255U) - int(b >> shift & 255U)));
  return most;
}

/// Raises the shares of what may differ to those of one hit, and returns the largest of them.
double raise_to_hit(const RayQuery& ray, const RayHit& a, const RayHit& b, double kappa,
                    DeviceAgreement& agreement) {
  const Splat first = unpack_splat(a.first);
  const double cosine = std::abs(glm::dot(first.normal, glm::dvec3(ray.dir)));
  const double first_error = FIRST_ERROR / cosine;
  const double depth = kappa * std::sqrt(first.radius_squared) / std::max(cosine, double(MIN_COSINE));
  double worst = 0.0;
  const auto raise = [&worst](double& most, double difference, double allowed) {
    most = std::max(most, difference / allowed);
    worst = std::max(worst, difference / allowed);
  };
  raise(agreement.t_first, apart(a.t_first, b.t_first), step_of(a.t_first, b.t_first) + first_error);
  raise(agreement.t, apart(a.t, b.t), step_of(a.t, b.t) + first_error + MEAN_ERROR * depth);
  for (int axis = 0; axis < 3; ++axis)
    raise(agreement.normal, apart(a.normal[axis], b.normal[axis]), MEAN_ERROR);
  raise(agreement.color, colors_apart(a.color, b.color), COLOR_ERROR);
  return worst;
}

}  // namespace

Agreement agreement_of(const BruteForce& brute, const std::vector<TrueHit>& truth,
                       const std::vector<RayHit>& answers) {
  assert(truth.size() == answers.size());
  Agreement result;
  result.rays = truth.size();
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const TrueHit& expected = truth[i];
    const RayHit& answer = answers[i];
    const bool found = answer.object != NO_OBJECT;
    result.hits += expected.found ? 1 : 0;
    result.hit_or_miss += expected.found != found ? 1 : 0;
    if (!expected.found || !found) continue;
    if (answer.first != brute.words()[expected.first]) {
      ++result.first_splat;
      continue;
    }
    result.members += answer.members != expected.members ? 1 : 0;
    // asin of the cross product: acos of float32 normals cannot resolve angles below 0.03 degree.
    const glm::dvec3 normal = glm::normalize(glm::dvec3(answer.normal));
    const double sine = glm::length(glm::cross(normal, expected.normal));
    const bool turned = glm::dot(normal, expected.normal) < 0.0;
    const double angle_deg = turned ? 180.0 : std::asin(std::min(sine, 1.0)) * 180.0 / M_PI;
    result.normal += angle_deg <= 0.01 ? 0 : 1;
    result.normal_most_deg = std::max(result.normal_most_deg, angle_deg);
    const double radius = std::sqrt(brute.splats()[expected.first].radius_squared);
    result.depth_most = std::max(result.depth_most, std::abs(double(answer.t) - expected.t) / radius);
  }
  return result;
}

std::ostream& operator<<(std::ostream& out, const Agreement& a) {
  return out << a.rays << " rays, " << a.hits << " hits: " << a.hit_or_miss << " hit or miss, "
             << a.first_splat << " first splats, " << a.members << " cluster sizes, " << a.normal
             << " normals differ; largest normal angle " << a.normal_most_deg << " degree, depth "
             << a.depth_most << " r";
}

DeviceAgreement device_agreement(const std::vector<RayQuery>& rays, const std::vector<RayHit>& a,
                                 const std::vector<RayHit>& b, const Settings& settings) {
  DeviceAgreement agreement;
  agreement.rays = rays.size();
  if (a.size() != rays.size() || b.size() != rays.size()) {
    agreement.decisions = agreement.unlike = std::max(rays.size(), std::size_t{1});
    return agreement;
  }
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const bool same = same_decisions(a[i], b[i]);
    const bool hit = same && a[i].object != NO_OBJECT && finite(a[i]);
    const double worst = hit ? raise_to_hit(rays[i], a[i], b[i], double(settings.kappa), agreement) : 0.0;
    agreement.hits += hit ? 1 : 0;
    agreement.decisions += same ? 0 : 1;
    agreement.unlike += same && worst <= 1.0 ? 0 : 1;
  }
  return agreement;
}

std::size_t unlike_answers(const std::vector<RayQuery>& rays, const std::vector<RayHit>& a,
                           const std::vector<RayHit>& b, bool cpus, const Settings& settings) {
  return cpus ? different_bits(a, b) : device_agreement(rays, a, b, settings).unlike;
}

std::ostream& operator<<(std::ostream& out, const DeviceAgreement& a) {
  return out << a.rays << " rays, " << a.hits << " hits: " << a.decisions << " decided otherwise, "
             << a.unlike << " unlike; of what is allowed first t " << a.t_first << ", t " << a.t
             << ", normals " << a.normal << ", colours " << a.color;
}

}  // namespace splatray::testing
