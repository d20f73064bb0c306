/// Random scenes that look for trouble, and random ways to trace them.
#pragma once
#include <array>
#include <string>

#include "engine/image/view.h"
#include "preprocess/points.h"
#include "tests/property/dice.h"

namespace splatray::testing {

/// One round's scene before it is built, and how it is built and traced.
struct RandomScene {
  Input input;  ///< every point with normal and radius, on the lattice of a root that all rounds share
  std::array<std::uint32_t, 2> leaf_sizes{};  ///< of the two trees
  Settings settings;                          ///< window or nearest, both kernels, both side rules, kappa
  std::string description;                    ///< parts and settings, one line
};

/// One to four objects of a random kind each: soups with radii over six decades, shells, planes on cell boundaries,
/// coincident and copied splats, clusters far below a leaf's usual size, thin sheets, wedges; one-sided, two-sided, glass or
/// hidden; with or without colours; in a third of the scenes, discs end at lines.
[[nodiscard]] RandomScene random_scene(Dice& dice);

/// The scene with one of its two leaf sizes.
[[nodiscard]] Scene built(const RandomScene& random, std::uint32_t leaf_size);

}  // namespace splatray::testing
