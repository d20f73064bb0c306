/// A scene on the device, with the counters always on.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "tests/gpu/shown_tracer.h"
#include "tests/hard/support/case_table.h"
#include "tests/trace/brute_force.h"
#include "tests/trace/different_bits.h"

namespace splatray::testing {

/// The device of all hard cases, made at the first call.
[[nodiscard]] const Device& shared_device();

/// How many rays the big counts take: the variable SPLATRAY_HARD_RAYS, or a million with SPLATRAY_TEST_ALL, else 20 000.
[[nodiscard]] std::size_t hard_rays();

/// How wide a picture is of which each pixel is a case of its own: `all` with SPLATRAY_TEST_ALL, else half of it.
[[nodiscard]] std::uint32_t hard_width(std::uint32_t all);

/// The number of exceptions measured with the default number of rays, or with more of them, up to 10^7.
[[nodiscard]] std::uint64_t known_of(std::uint64_t by_default, std::uint64_t of_ten_million);

class DeviceScene {
 public:
  explicit DeviceScene(const Scene& scene, const Device& device = shared_device());

  /// ShownTracer::intersect. Adds up lost rays and answers that are not finite: a hit whose t is not finite or
  /// whose normal is not of unit length within 1e-3.
  [[nodiscard]] std::vector<RayHit> intersect(std::span<const RayQuery> rays, Settings settings = {});
  /// ShownTracer::render; lost rays and non-finite samples and pixels are added up.
  [[nodiscard]] Image render(const View& view, Settings settings, const Environment& environment);

  /// A row with the lost rays and non-finite answers since the last call of row().
  [[nodiscard]] CaseRow row(const std::string& compared);
  /// One of the counters of the last call.
  [[nodiscard]] std::uint64_t counter(std::uint32_t index) const { return tracer_.stats().counters[index]; }

 private:
  ShownTracer tracer_;
  std::uint64_t lost_ = 0;
  std::uint64_t non_finite_ = 0;
};

/// A primary ray, root space; `dir` of any length > 0.
[[nodiscard]] RayQuery primary_ray(const glm::dvec3& origin, const glm::dvec3& dir);

/// What of the answers must be as brute force says.
enum class Compared {
  hits,   ///< hit or miss, and the first splat
  blends  ///< also the size of the cluster and, within 0.01 degree, the blended normal
};

/// Compares answers of the device with brute force. Exceptions are rays that differ; where two splats are met
/// at the same t, to 2^-44 of the distances involved, either may be the first.
[[nodiscard]] CaseRow compare_answers(CaseRow row, const BruteForce& brute, const std::vector<RayQuery>& rays,
                                      const std::vector<TrueHit>& truth, const std::vector<RayHit>& answers,
                                      Compared compared = Compared::blends);

/// Traces the rays on the device and by brute force and compares.
[[nodiscard]] CaseRow compare_with_brute_force(DeviceScene& device, const BruteForce& brute,
                                               const std::vector<RayQuery>& rays, const std::string& what,
                                               Compared compared = Compared::blends);

}  // namespace splatray::testing
