/// A ray tracer in a race: splatray or a peer.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/image/image.h"
#include "tests/bench/cases/course.h"
#include "tests/bench/measure/record.h"

namespace splatray::testing {

class Racer {
 public:
  virtual ~Racer() = default;

  /// Has a card work until its clocks are what they are at work (warm_up.h).
  virtual void warm() {}
  /// Traces a frame of the course and returns its time in milliseconds.
  virtual double run(Frame frame) = 0;
  /// Secondary rays of a frame, as counted; of Frame::random all rays.
  [[nodiscard]] virtual std::uint64_t count_rays(Frame frame) = 0;

  /// Image::aov of the course's outside view.
  [[nodiscard]] virtual Image picture() = 0;
  /// Hits of arbitrary rays. Secondary ones are as mirrored_query() makes them inside the sphere.
  [[nodiscard]] virtual std::vector<RayHit> intersect(std::span<const RayQuery> rays) = 0;
  /// Shadow rays of Frame::shadow that are blocked. Truly none is, as a sphere casts no shadow on its lit side.
  [[nodiscard]] virtual std::uint64_t false_shadows() = 0;

  /// Adds method, settings, device and what else is known to a record (record.h).
  virtual void describe(Json& record) = 0;
};

}  // namespace splatray::testing
