/// What the report of scale (tests/bench/scale) is measured on.
#pragma once
#include <vector>

#include "tests/bench/cases/cases.h"

namespace splatray::testing {

/// Even spheres of 10 k to 30 M splats, as high as their picture of 512x512 pixels; with `quick` up to 100 k at 128x128.
[[nodiscard]] std::vector<Case> scale_spheres(bool quick);

/// The cases of Goradia et al. 2010, Table I; with `quick` none.
[[nodiscard]] std::vector<Case> scale_scenes(bool quick);

/// What these spheres are made of: matte, grey and two-sided.
[[nodiscard]] Material scale_material();

/// The sphere of features and coverage: of 1 M splats, with `quick` of 100 k.
[[nodiscard]] Case scale_sphere(bool quick);

}  // namespace splatray::testing
