/// How many splats lie one behind the other on a sheet.
#pragma once
#include "app/library/shot/sheet.h"
#include "engine/gpu/tracer.h"

namespace splatray {

/// The image of a window of the sheet: by the ray through each pixel's centre, all splats that it hits (BLEND_COUNT), whole numbers
/// that depend on no tree and no order; light for few, black for many, by the logarithm. A grid of rays of the whole sheet decides what
/// is few and many, whatever the window. Throws Error as Tracer::intersect does.
[[nodiscard]] Image xray_image(Tracer& tracer, const RootTransform& root, const Look& look,
                               const Sheet& sheet, const PixelWindow& window, const Settings& settings,
                               const Tracer::Progress& progress);

}  // namespace splatray
