/// The classes of rays on the spheres of the report of scale.
#pragma once
#include <functional>
#include <memory>

#include "engine/device/device.h"
#include "tests/bench/measure/race.h"

namespace splatray::testing {

/// Makes a peer of the course's sphere.
struct PeerMaker {
  std::uint32_t blend;  ///< of splatray in the race against it
  bool secondary;       ///< whether shadow and mirrored rays are raced too
  std::function<std::unique_ptr<Racer>(const Course& course)> make;
};

/// Called with the scene while it is in memory; returns the peers to be raced one after the other, each alone in memory
/// with splatray. None: splatray runs alone, with both blendings.
using PeerMakers = std::function<std::vector<PeerMaker>(const Scene& scene)>;

/// Records (race.h) of a case of scale_spheres() from what splatray-bench prepare --scale left in `folder`.
[[nodiscard]] std::vector<Json> measure_rays(const Device& device, const Case& one,
                                             const std::filesystem::path& folder, const PeerMakers& makers);

}  // namespace splatray::testing
