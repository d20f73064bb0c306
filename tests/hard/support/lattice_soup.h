/// A scene in which much lies exactly on cell planes, and origins that do too.
#pragma once
#include <glm/glm.hpp>
#include <random>

#include "engine/scene/scene.h"

namespace splatray::testing {

/// 1500 discs with centres on multiples of 2^16, a third of them parallel to cell planes, radii of 2^15 to
/// 2^16.9, two-sided.
[[nodiscard]] Scene lattice_soup(std::uint32_t leaf_size = 10);

/// A point in or around the root whose coordinates are multiples of the same power of two, 1 to 2^20: on cell
/// planes, often on edges and corners of cells.
[[nodiscard]] glm::dvec3 lattice_point(std::mt19937_64& random);

}  // namespace splatray::testing
