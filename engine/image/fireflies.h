/// Takes out single pixels that are bright by chance.
#pragma once
#include <array>
#include <vector>

#include "engine/image/image.h"

namespace splatray {

/// Two pictures of independent samples, rgb, top row first.
using Halves = std::array<std::vector<vec3>, 2>;

/// A pixel of a half that is much brighter (1.5 times) than all of the 3 x 3 around it in the other one has found light by rare
/// chance: it gets as much as that. What is bright in both stays. `width` pixels a row.
void limit_fireflies(Halves& halves, std::uint32_t width);

/// The image with limit_fireflies done to its Image::part and the other samples. It shows less light than there is where light is
/// found by few samples, and with more of them changes ever less. Asserts that it has a part.
[[nodiscard]] Image without_fireflies(Image image);

}  // namespace splatray
