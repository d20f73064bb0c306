/// Which of its two sides each estimated normal points to.
#pragma once
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "preprocess/base/parallel.h"
#include "preprocess/scan/survey.h"
#include "preprocess/surface/cloud.h"

namespace splatray {

/// What decided the sides, best first.
enum class SideRung : std::uint8_t {
  given,   ///< the input's own normals
  sensor,  ///< the scanner's place, given or found: by its rings, a camera's frame, how dense points are
  track,   ///< the aircraft's, from its pulses
  up,      ///< terrain and other sheets
  votes    ///< of rays: nothing is known
};
inline constexpr std::size_t SIDE_RUNGS = 5;
[[nodiscard]] std::string_view name_of(SideRung rung);

/// How the sides of a cloud were found.
struct SidesFound {
  SideRung rung = SideRung::given;
  std::uint64_t unsure = 0;  ///< points whose side had less than two thirds of the votes
  bool terrain = false;      ///< a sheet that is seen from above
};

/// The axis of a sheet, on the side of `up`, that has nothing above or below most of itself, as terrain and a wall have not and a cave or
/// a room has; nothing for what is no such sheet.
[[nodiscard]] std::optional<glm::dvec3> open_sheet_axis(const Cloud& cloud, const Survey& survey,
                                                        const glm::dvec3& up);

/// Turns the normals of the points of `estimated` numbers (ascending) by the first of the rungs that has data; with none of them it
/// is `given`.
SidesFound turn_to_sides(Cloud& cloud, const Survey& survey, const std::vector<std::uint32_t>& estimated,
                         const glm::dvec3& up, const Stage& stage);

/// Whether the cloud is of a room's inside. Much of it lies in walls, floors and ceilings, planes that all but few points are on one side
/// of, some of these look up, as floors do, and half of all is along or across them or three tenths upright or level: a plinth, a car or a
/// house from outside has tops and sides, and is not seen from below, and a bust is round. Or, whatever stands in it and however many rooms
/// there are, it encloses air, most of it is upright or level, and some of it is deep, without a side that sees out, as furniture and inner
/// walls are. Air is enclosed where, of an even choice of free cells, three tenths meet points in 85 % of the directions about
/// level, in 80 % of those up and of those down. `up` is unit. Normals must be known, but for their sides.
[[nodiscard]] bool is_room(const Cloud& cloud, const Survey& survey, const glm::dvec3& up);

/// Sides where nothing is known: parts of smooth surface, joined over the neighbours by how little their normals differ (Hoppe
/// et al. 1992, sec. 3.3, with Kruskal's tree), each turned to where rays find more room (Takayama et al. 2014,
/// "A simple method for correcting facet orientations in polygon meshes based on ray casting"). What lies beyond the cloud
/// counts as room, but for rooms, which are seen from within: there it counts as none. Returns the points whose parts had less
/// than two thirds of the votes and no neighbour that knew better. Points on no surface (Cloud::kind) take no part.
[[nodiscard]] std::uint64_t turn_by_votes(Cloud& cloud, const Survey& survey, const glm::dvec3& up,
                                          const Stage& stage);

}  // namespace splatray
