/// Captures of 3D Gaussians (Kerbl et al. 2023, "3D Gaussian Splatting for Real-Time Radiance Field Rendering") as points of the surface that
/// they show.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "preprocess/base/parallel.h"
#include "preprocess/points.h"
#include "preprocess/read/scan/gaussian_cloud.h"

namespace splatray {

/// Gaussians are clouds that hide each other by shares; their colours make sense only when blended. So each is looked at from outside on
/// both of its sides, in its middle and at three places around it: where a ray has lost half of its light stands a point, with the colour
/// that the ray sees and the normal against it. What lies deeper than three tenths of the light come gives none. Left out are Gaussians
/// that reach farther than the diagonal of the box of all centres, and those whose numbers are none.
class GaussianSurface {
 public:
  void reserve(std::size_t count) { gaussians_.reserve(count); }
  void add(const Gaussian& one);
  /// Points with normals outwards and colours; up is -y, as the cameras of such captures mostly have it.
  [[nodiscard]] Points take(const Stage& stage);
  /// What became of them, a sentence; behind take().
  [[nodiscard]] std::string note() const;

 private:
  void leave_out_vast();

  std::vector<Gaussian> gaussians_;
  std::uint64_t count_ = 0;
  std::uint64_t points_ = 0;
  std::uint64_t vast_ = 0;
  std::uint64_t invalid_ = 0;
};

}  // namespace splatray
