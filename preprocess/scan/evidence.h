/// Discs of scans that are larger than what was seen around them shows a surface to be.
#pragma once
#include <cstdint>
#include <vector>

#include "preprocess/base/parallel.h"
#include "preprocess/surface/cloud.h"

namespace splatray {

/// Makes small dots of the discs of a sparse scan that close over what nobody saw. Of the points `computed`, whose radii were not given,
/// discs on surfaces that are larger than twice their median radius must be shown by their neighbours on surfaces: one of the 12, 20 and
/// 32 nearest of these reaches as far as the disc, is flat (its least deviation under a fifth of the second, that over a quarter of the first)
/// about the disc's normal, and lies in half of the sectors around it; or most other large discs next to it are shown, as beside a
/// wall's end. Where those that are not, and as large ones on no surface, have a quarter of the area of all discs, the first
/// get the median radius, the others twice that. Discs that end at clip lines, which were found by planes of their own, and
/// ellipses, whose evidence is the next line, stay as they are, and so does all of a scan that is closed, or has fewer than 1000
/// discs on surfaces, too few for a usual radius. Returns how many discs became smaller.
std::uint64_t make_dots(Cloud& cloud, const std::vector<std::uint32_t>& computed, const Stage& stage);

}  // namespace splatray
