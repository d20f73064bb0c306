/// What path tracing sees of an object.
#pragma once
#include <vector>

#include "engine/scene/scene.h"
#include "shaders/layout.h"

namespace splatray {

/// The surface that comes closest to a material of the paper's kind: a dielectric of the same index of refraction and of the tint
/// of both its sides; a smooth metal of the mirror's tint where at least half of the light is mirrored; else a diffuse base below
/// a smooth layer that mirrors as much face on, or, where nothing is mirrored but there is a highlight, below a layer of index
/// 1.5 as rough as the highlight's exponent says (GGX's alpha^2 = 2 / (shininess + 2); Walter et al. 2007, "Microfacet Models for
/// Refraction through Rough Surfaces", sec. 5.1).
[[nodiscard]] Surface surface_of(const Material& material);

/// The surface of each object: the scene's, or surface_of its materials.
[[nodiscard]] std::vector<Surface> surfaces_of(const Scene& scene);

}  // namespace splatray
