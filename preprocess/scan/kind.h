/// What the points of a scan are part of, and how those are shown that are of no surface.
#pragma once
#include <vector>

#include "preprocess/scan/survey.h"
#include "preprocess/surface/cloud.h"

namespace splatray {

/// Sorts points by their neighbourhoods (Survey::flatness), as dimensionality features do (Demantke et al. 2011): those that
/// lie along a line at every size are lines; those of which more than half are not flat, counting a point and its LISTED
/// nearest places, are scatter, and in two rounds points do as most around them; all others, and all whose normals were given,
/// are surface. Empty where all are surface, and for clouds of fewer than 1000 points, which are too few.
/// Where the file's classes (COLUMN_CLASS) tell ground or buildings from medium and high vegetation, these say it of their points in
/// place of neighbourhoods, which seem flatter the fewer points a crown has: vegetation is scatter, unless it is a line.
[[nodiscard]] std::vector<ScanKind> find_kinds(const Cloud& cloud, const Survey& survey);

/// Gives points that are of no surface small round discs: `share` of the distance to the 6th place, at most twice what is usual
/// around them, that face their scanner, which is known to have seen them, or, where its place is not known, lie across the density's
/// gradient (minus the sum of the offsets to the places around and to theirs) turned towards `up` (unit), so that a crown has a form
/// and is lit from above. The mean of several points (Points::mean_of) covers as much as their discs, and is darker, as they shade each
/// other. Other points' radii are left unknown; those next to such
/// points will be at most the usual distance (Cloud::radius_most), so that no disc of a surface covers what is none.
void make_scatter_discs(Cloud& cloud, const Survey& survey, const glm::dvec3& up, float share);

}  // namespace splatray
