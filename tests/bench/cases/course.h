/// The rays of every class that the ray tracers of one sphere are timed on.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "engine/image/view.h"
#include "engine/scene/scene.h"
#include "tests/bench/cases/case_file.h"
#include "tests/bench/cases/cases.h"
#include "tests/bench/cases/probes.h"
#include "tests/bench/truth/truth.h"

namespace splatray::testing {

/// What is timed. A class of rays is the time of one of these, less that of another without them (race.h).
enum class Frame {
  primary,  ///< one ray through each pixel's centre, from outside
  shadow,   ///< and one to the light from each hit that faces it
  inside,   ///< one ray through each pixel's centre, from inside the sphere
  mirror,   ///< and MIRRORED rays after it, mirrored by the sphere
  random,   ///< rays from all around, in no order, that meet the sphere: Probes
};

/// Mirrored rays of a path inside the sphere.
inline constexpr std::uint32_t MIRRORED = 4;

struct Course {
  std::uint64_t splats = 0;
  RootTransform root;
  double diagonal_world = 0.0;  ///< of the splats' bounding box
  double radius_world = 0.0;    ///< median, of the discs
  View outside, inside;
  FrameParams outside_frame{}, inside_frame{};  ///< the views in root space
  SceneLight light;                             ///< directional
  Truth truth;                                  ///< of `outside`
  Probes probes;

  /// Of a case of scale_spheres() that was prepared. Reads no file.
  Course(const Case& one, const PreparedCase& prepared, const Scene& scene);
};

}  // namespace splatray::testing
