#include "tests/bench/cases/course.h"

#include <cassert>

namespace splatray::testing {
namespace {

/// Off the centre, so that paths do not come back to where they were; the picture's corners look at grazing angles too.
constexpr glm::dvec3 INSIDE_EYE{0.35, 0.2, 0.1}, INSIDE_TARGET{-0.4, 0.3, -0.8};
constexpr double INSIDE_FOV_DEG = 75.0;

}  // namespace

Course::Course(const Case& one, const PreparedCase& prepared, const Scene& scene)
    : splats(scene.data_pool.size()),
      root(scene.root),
      diagonal_world(prepared.diagonal_world),
      radius_world(prepared.variants.at(file_name(one.runs.front().variant)).radius_median_world),
      outside{prepared.camera, one.width, one.height},
      inside{{INSIDE_EYE, INSIDE_TARGET, {0.0, 1.0, 0.0}, INSIDE_FOV_DEG, 0.0}, one.width, one.height},
      outside_frame(make_frame_params(scene, outside, one.runs.front().settings)),
      inside_frame(make_frame_params(scene, inside, one.runs.front().settings)),
      light(scene.lights.at(0)),
      truth(analytic_truth(*one.shape, outside)),
      probes(*one.shape, scene.root, one.rays, 1) {
  assert(light.kind == LIGHT_DIRECTIONAL);
}

}  // namespace splatray::testing
