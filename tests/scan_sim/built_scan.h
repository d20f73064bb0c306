/// A scan as preprocess builds it, whose splats can still be matched to its points.
#pragma once
#include <string_view>

#include "preprocess/build.h"

namespace splatray::testing {

/// The attribute that holds the number of each splat's point.
inline constexpr std::string_view POINT_NUMBER = "number";

struct BuiltScan {
  Scene scene;  ///< with POINT_NUMBER
  BuildStats stats;
};

/// Builds measured points alone, z up.
[[nodiscard]] BuiltScan build_scan(const Points& points, const BuildParams& params = {},
                                   unsigned threads = 0);

/// The number of the point that a splat is.
[[nodiscard]] std::size_t number_of(const Scene& scene, std::size_t splat);

}  // namespace splatray::testing
