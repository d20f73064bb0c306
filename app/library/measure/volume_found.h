/// What is found of volumes between a surface and a base.
#pragma once

namespace splatray {

/// Volumes, world units cubed, and half-widths of their 95 % intervals.
struct VolumeFound {
  double cut = 0.0, fill = 0.0;  ///< of what lies above the base, and of what is missing below it
  double cut_within = 0.0, fill_within = 0.0, net_within = 0.0;
  double area = 0.0;  ///< of the ground on which both are known or lie between what is, world units squared
  double uncovered = 0.0;  ///< of the rest of the outline, which the volumes do not hold

  [[nodiscard]] double net() const { return cut - fill; }
  bool operator==(const VolumeFound&) const = default;
};

}  // namespace splatray
