/// splatray in a race, on a device.
#pragma once
#include "engine/device/device.h"
#include "tests/bench/measure/racer.h"
#include "tests/gpu/shown_tracer.h"

namespace splatray::testing {

/// Times are those of the dispatches and include shading.
class SplatrayRacer : public Racer {
 public:
  /// `tracer` holds the course's sphere and its surroundings; both must outlive the racer.
  SplatrayRacer(const Device& device, ShownTracer& tracer, const Course& course, std::uint32_t blend);

  void warm() override;
  double run(Frame frame) override;
  [[nodiscard]] std::uint64_t count_rays(Frame frame) override;
  [[nodiscard]] Image picture() override;
  [[nodiscard]] std::vector<RayHit> intersect(std::span<const RayQuery> rays) override;
  [[nodiscard]] std::uint64_t false_shadows() override;
  void describe(Json& record) override;

 private:
  [[nodiscard]] Settings settings_of(Frame frame) const;
  void trace(Frame frame, const Settings& settings);
  [[nodiscard]] Image render(Frame frame, const Settings& settings);

  const Device& device_;
  ShownTracer& tracer_;
  const Course& course_;
  std::uint32_t blend_;
};

}  // namespace splatray::testing
