/// How different two pictures look to a person who flips between them: LDR-FLIP (Andersson, Nilsson, Akenine-Moller,
/// Oskarsson, Astrom and Fairchild 2020, "FLIP: A Difference Evaluator for Alternating Images").
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace splatray::testing {

/// Mean over all pixels of FLIP's error, 0 (equal) to 1. Pictures of width x height >= 1 pixels, rows one after the
/// other, display-encoded sRGB in 0..1. `pixels_per_degree` > 0 of the viewer's field of view; the default is the
/// paper's: a 0.69 m wide display of 3840 pixels seen from 0.7 m.
[[nodiscard]] double flip_mean(const std::vector<glm::vec3>& a_srgb, const std::vector<glm::vec3>& b_srgb,
                               std::uint32_t width, std::uint32_t height, double pixels_per_degree = 67.02);

}  // namespace splatray::testing
