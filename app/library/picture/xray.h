/// How much surface lies one behind the other on a sheet.
#pragma once
#include <functional>

#include "app/library/shot/sheet.h"
#include "engine/image/image.h"
#include "engine/image/region.h"

namespace splatray {

/// The image of a window of the sheet: at each pixel the area of the surface that the region holds there, for an area of paper: 1 for a
/// surface that lies across the view, 10 for one that leans by 84 degrees, many for walls seen along them. Each splat counts by the
/// area that it stands for, spread over the projection of a disc by a kernel that falls to 0 at the rim, so that no rim and no pattern of
/// discs is seen. Light for what much of the sheet has, black for 32 times that, by the logarithm; transparent where nothing is. A coarse
/// image of the whole sheet decides what is light, whatever the window. Objects with MATERIAL_HIDDEN count nothing. The scene has its pools. Throws Error (interrupted) where
/// `progress`, which may be empty and is told the part that is done, returns false.
[[nodiscard]] Image xray_image(const Scene& scene, const std::vector<Material>& materials, const Sheet& sheet,
                               const PixelWindow& window, const Region& region,
                               const std::function<bool(double)>& progress);

}  // namespace splatray
