/// How the normal changes across a disc.
#pragma once
#include <glm/glm.hpp>

#include "preprocess/surface/neighbourhood.h"

namespace splatray {

/// The linear field of normals around a point (Cloud::field), as in Botsch et al. 2004, "Phong Splatting", sec. 3, and
/// Linsen et al. 2007. Symmetric least-squares fit to how the normals of those of its nearest places that lie on the same
/// sheet lean, weighted by the inverse squared distance, times the share of their variance that it explains: noise and
/// creases leave a disc flat. Normals must be known.
[[nodiscard]] glm::vec3 fit_normal_field(const Neighbourhood& around);

}  // namespace splatray
