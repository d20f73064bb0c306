/// A scan as preprocess builds it, whose splats can still be matched to its points.
#pragma once
#include <optional>
#include <string_view>

#include "preprocess/build.h"

namespace splatray::testing {

/// The attribute that holds the number of each splat's point.
inline constexpr std::string_view POINT_NUMBER = "number";

struct BuiltScan {
  Scene scene;  ///< with POINT_NUMBER
  BuildStats stats;
};

/// Builds measured points alone, of a format that promises `up`, or nothing.
[[nodiscard]] BuiltScan build_scan(const Points& points, const BuildParams& params = {}, unsigned threads = 0,
                                   const std::optional<glm::dvec3>& up = glm::dvec3(0.0, 0.0, 1.0));

/// The number of the point that a splat is.
[[nodiscard]] std::size_t number_of(const Scene& scene, std::size_t splat);

}  // namespace splatray::testing
