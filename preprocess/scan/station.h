/// Where a scanner stood, as its points show.
#pragma once
#include <glm/glm.hpp>
#include <optional>

#include "preprocess/scan/line/lines.h"
#include "preprocess/scan/survey.h"
#include "preprocess/surface/cloud.h"

namespace splatray {

/// A place from which a scan was made, as far as its points show it.
struct StationFound {
  glm::dvec3 sensor;  ///< cloud coordinates
  double explained;   ///< share of the surface, 0..1, whose density it explains and which it sees
  double even;        ///< the same of one density everywhere
};

/// The place that explains how dense the points of a scan from one place are. A scanner's pulses are as far apart in angle everywhere, so
/// that points per area fall with the squared distance and the cosine of incidence, and, where it turns about an axis, x, y or z, rise
/// with the inverse sine from that (Soudarissanane et al. 2011, "Scanning geometry: Influencing factor on the quality of terrestrial
/// laser scanning points", section 3). Of flat patches those are explained that lie within 0.35 of one constant, in natural logarithms,
/// and in free sight. It must explain half of them, and a fifth of all more than one density everywhere does: nothing is found of scans
/// from several places, of those that were thinned evenly, and where one density explains more than 0.6.
[[nodiscard]] std::optional<StationFound> find_scanner_place(const Cloud& cloud, const Survey& survey);

/// Gives a cloud of which no scanner's place is known a station at the origin, where all lies on rings around it (find_ring_axis), at the
/// place that its rings show (find_spinning_sensor), at the origin of
/// a depth camera's frame (is_seen_along_z) or, of rooms and of all that is no open sheet, where it explains how dense the points are.
/// Returns StationFound::explained of the latter, else 0.
double find_station(Cloud& cloud, const Survey& survey, const std::vector<LinePlace>& lines,
                    const glm::dvec3& up);

}  // namespace splatray
