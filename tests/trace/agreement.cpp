#include "tests/trace/agreement.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace splatray::testing {

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

}  // namespace splatray::testing
