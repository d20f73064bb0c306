/// Where an airborne scanner was, found from its pulses.
#pragma once
#include <glm/glm.hpp>
#include <vector>

#include "preprocess/surface/cloud.h"

namespace splatray {

/// A sensor's places over time.
class FlightTrack {
 public:
  /// The lines through the first and the last return of pulses meet at the sensor: least squares over bins of half a second
  /// with at least 15 of them, weighted by the squared distance between the returns (Roussel et al. 2020; Gatziolis and
  /// McGaughey 2019, "Reconstructing aircraft trajectories from multi-return airborne laser-scanning data"). Needs the columns
  /// return, returns and time. Bins whose sensor does not lie above its points along `up` (unit) are left out.
  /// Where the cloud has a track of its own, that is taken; its points' times are still needed.
  FlightTrack(const Cloud& cloud, const glm::dvec3& up);

  [[nodiscard]] bool empty() const { return places_.empty(); }
  /// World position at a time, between the bins' places; the first before them, the last after.
  [[nodiscard]] glm::dvec3 at(double time) const;

 private:
  std::vector<TrackPlace> places_;
};

}  // namespace splatray
