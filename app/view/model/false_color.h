/// Auxiliary values as colours, and the scale that explains them.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "app/view/model/document.h"

namespace splatray {

/// "shaded", "normal", ...; for menus.
[[nodiscard]] const char* view_mode_name(ViewMode mode);
/// What the colours mean; empty for shaded.
[[nodiscard]] const char* view_mode_legend(ViewMode mode);
/// Whether they are those of a scale, whose ends color_range() finds.
[[nodiscard]] bool has_scale(ViewMode mode);

/// Values at the ends of a colour scale.
struct ColorRange {
  double low = 0.0;   ///< colour 0 of heat_color
  double high = 1.0;  ///< colour 1; > low
};

/// Range of what a mode with a scale shows: of the hits' values, or, of tests and steps, 0 to the count that one pixel in 200
/// exceeds. [0, 1] without hits and for the other modes.
[[nodiscard]] ColorRange color_range(std::span<const AovPixel> pixels, ViewMode mode);

/// Display-encoded (sRGB) 8-bit rgba of each pixel, r first; alpha 255. Misses are dark grey. `mode` is not shaded.
[[nodiscard]] std::vector<std::uint8_t> false_color(std::span<const AovPixel> pixels, ViewMode mode,
                                                    const ColorRange& range);

}  // namespace splatray
