/// The material that comes closest to the paper's numbers.
#pragma once
#include "shaders/layout.h"

namespace splatray {

/// Gives a material the numbers that come closest to its `phong`, all but flags, mask_bit and ior: a dielectric of the tint of both
/// its sides; a smooth metal of the mirror's tint where at least half of the light is mirrored; else a diffuse base below
/// a smooth layer that mirrors as much face on, or, where nothing is mirrored but there is a highlight, below a layer of index
/// 1.5 as rough as the highlight's exponent says (GGX's alpha^2 = 2 / (shininess + 2); Walter et al. 2007, "Microfacet Models for
/// Refraction through Rough Surfaces", sec. 5.1).
void follow_phong(Material& material);

/// Does so where `material` was `before` until its phong or its flags changed; numbers that have keys (material_fields.h) and were
/// not those that followed from its phong before stay. Nothing changes where the numbers that follow are the same as before.
void follow_change(const Material& before, Material& material);

}  // namespace splatray
