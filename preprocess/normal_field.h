/// How normals change across discs.
#pragma once
#include "preprocess/cloud.h"
#include "preprocess/parallel.h"

namespace splatray {

/// Fills cloud.field: a linear field of normals in each splat, as in Botsch et al. 2004, "Phong Splatting", sec. 3, and
/// Linsen et al. 2007. Symmetric least-squares fit to how the normals of the 12 nearest places of the same sheet lean,
/// weighted by the inverse squared distance, times the share of their variance that it explains: noise and creases
/// leave a disc flat. Normals and radii must be known.
void fit_normal_fields(Cloud& cloud, const Stage& stage);

}  // namespace splatray
