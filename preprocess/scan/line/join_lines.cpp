#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/release.h"
#include "preprocess/scan/components.h"
#include "preprocess/scan/line/lines.h"

namespace splatray {
namespace {

constexpr float STRAIGHT_ON = 0.966F;  // cosine of the turn between ways that one surface goes: 15 degrees
constexpr float STRAIGHTER =
    3.0F;  // of turns: one side alone decides where its surface turns by this factor less
constexpr float SLIGHT = 0.05F;   // turn, radians: below, lines on both sides are of one surface
constexpr float MISFIT = 0.35F;   // sine of the angle between a normal's plane and the way to the next line
constexpr float SURVEYED = 0.7F;  // of the survey's reach: lines that near had their part in its normal
constexpr float COVERS =
    0.8F;  // half an ellipse's length over the way to the next line, with room for lines that bend
constexpr float COVERS_ALONG = 1.0F;  // half its width over the step along the line
constexpr float COVERS_OPEN = 0.5F;   // of the usual way, where no surface is known beyond a line
constexpr float ROUND_TURN = 1.4F;    // of the ways on both sides: from here on the shorter has a clip line
constexpr float HOLE = 4.0F;          // of the other side's way
constexpr float LEAST_LINE_ASPECT = 3.0F;   // of ways over steps, below which discs do
constexpr float EVEN_RUN = 2.5F;            // of a step, to the next point of a run
constexpr float MOST_SLIM = 2.0F;           // length of what joins lines over the width of the run: no spokes
constexpr float ONE_SURFACE_COSINE = 0.9F;  // cosine of normals of one surface

/// The turn between ways that a surface goes, by its cosine, radians.
float turn_of(float cosine) { return std::acos(std::clamp(cosine, -1.0F, 1.0F)); }

/// A surface through a line and those beside it.
struct LinePlane {
  glm::vec3 across{0.0F};             ///< in it, from the line on; zero = none
  std::array<float, 2> ways{};        ///< how far it is known on either side, `across` first; 0 = it is not
  std::array<std::uint32_t, 2> to{};  ///< the points there
};

/// How much the surface turns at the next line on one side, on its way to the one after; a half turn where that is not known.
float turn_beyond(const std::vector<LinePlace>& places, const LinePlace& place, std::size_t side) {
  const glm::vec3& way = place.beside[side];
  float least = turn_of(-1.0F);
  for (const glm::vec3& beyond : places[place.other[side]].beside) {
    const float lengths = glm::length(way) * glm::length(beyond);
    if (lengths > 0.0F) least = std::min(least, turn_of(glm::dot(way, beyond) / lengths));
  }
  return least;
}

/// The surface on one side.
LinePlane on_side(const LinePlace& place, std::size_t side) {
  return {place.beside[side], {glm::length(place.beside[side]), 0.0F}, {place.other[side], 0}};
}

/// The surface on both sides; a gap that is far wider than the other one is a hole.
LinePlane on_both_sides(const LinePlace& place) {
  const std::array<float, 2> gap{glm::length(place.beside[0]), glm::length(place.beside[1])};
  if (gap[1] > HOLE * gap[0]) return on_side(place, 0);
  if (gap[0] > HOLE * gap[1]) return on_side(place, 1);
  return {place.beside[0] - place.beside[1], gap, place.other};
}

/// The surface that ways to the lines beside a point suggest, if any. `normal` is the point's, of a neighbourhood of reach `surveyed`.
LinePlane plane_of(const std::vector<LinePlace>& places, const LinePlace& place, const glm::vec3& normal,
                   float surveyed) {
  const std::array<float, 2> gap{glm::length(place.beside[0]), glm::length(place.beside[1])};
  if (!(gap[0] > 0.0F)) return {};
  const float half_turn = turn_of(-1.0F), straight = turn_of(STRAIGHT_ON);
  const bool both = gap[1] > 0.0F;
  const float through =
      both ? turn_of(-glm::dot(place.beside[0], place.beside[1]) / (gap[0] * gap[1])) : half_turn;
  const std::array<float, 2> beyond{turn_beyond(places, place, 0),
                                    both ? turn_beyond(places, place, 1) : half_turn};
  const std::size_t side = beyond[1] < beyond[0] ? 1 : 0;
  if (through < straight && (through < SLIGHT || through < STRAIGHTER * beyond[side]))
    return on_both_sides(place);
  const bool agrees =
      gap[side] < surveyed && std::abs(glm::dot(normal, place.beside[side])) <= MISFIT * gap[side];
  return beyond[side] < straight || agrees ? on_side(place, side) : LinePlane{};
}

/// The surface's normal there, on the side of the one before.
glm::vec3 normal_of(const LinePlace& place, const LinePlane& plane, const glm::vec3& before) {
  const glm::vec3 normal = glm::normalize(glm::cross(place.along, plane.across));
  return glm::dot(normal, before) < 0.0F ? -normal : normal;
}

/// The splat of a point on a line: long across to the next lines, however those are turned; a disc where these are near.
PointEllipse ellipse_of(const LinePlace& place, const LinePlane& plane, const glm::vec3& normal) {
  const float way = std::max(plane.ways[0], plane.ways[1]);
  const glm::vec3 short_axis = glm::normalize(glm::cross(normal, plane.across));
  const float step = place.step * std::abs(glm::dot(short_axis, place.along));
  if (!(way >= LEAST_LINE_ASPECT * step) || step == 0.0F) return {};
  return {short_axis, COVERS * way / (COVERS_ALONG * step), COVERS * way};
}

/// Where it ends on the side where the surface is not known, or known by a line that is much nearer.
PointClip end_of(const LinePlane& plane, const glm::vec3& normal) {
  const float more = std::max(plane.ways[0], plane.ways[1]), less = std::min(plane.ways[0], plane.ways[1]);
  if (more <= ROUND_TURN * less) return {};
  const glm::vec3 out = plane.ways[0] > plane.ways[1] ? -plane.across : plane.across;
  PointClip clip;
  clip.dir[0] = glm::normalize(out - normal * glm::dot(normal, out));
  clip.distance[0] = less > 0.0F ? COVERS * less : COVERS_OPEN * more;
  clip.reach = std::numeric_limits<float>::max();
  return clip;
}

/// Normals of neighbours on one surface, averaged.
std::vector<glm::vec3> averaged_normals(const Cloud& cloud, const Survey& survey,
                                        const std::vector<LinePlace>& places) {
  std::vector<glm::vec3> normals = cloud.normal;
  tbb::parallel_for(std::size_t{0}, cloud.size(), [&](std::size_t i) {
    if (survey.estimated[i] == 0 || !places[i].plane) return;
    glm::vec3 sum = cloud.normal[i];
    for (const std::uint32_t j : survey.around(i)) {
      const float cosine = glm::dot(cloud.normal[i], cloud.normal[j]);
      if (j != i && places[j].plane && std::abs(cosine) > ONE_SURFACE_COSINE)
        sum += std::copysign(1.0F, cosine) * cloud.normal[j];
    }
    normals[i] = glm::normalize(sum);
  });
  return normals;
}

/// Leaves the sides of a plane on which the next lines' planes are like it, as those of one surface are.
void keep_agreed(const std::vector<LinePlace>& places, const std::vector<glm::vec3>& normals,
                 const glm::vec3& normal, LinePlane& plane) {
  const auto agreed = [&](std::size_t side) {
    const std::uint32_t other = plane.to[side];
    return plane.ways[side] > 0.0F && places[other].plane &&
           std::abs(glm::dot(normals[other], normal)) > ONE_SURFACE_COSINE;
  };
  const bool first = agreed(0), second = agreed(1);
  if (!first && !second) plane = {};
  if (first == second) return;
  plane = first ? LinePlane{plane.across, {plane.ways[0], 0.0F}, plane.to}
                : LinePlane{-plane.across, {plane.ways[1], 0.0F}, {plane.to[1], 0}};
}

/// How wide the runs of points are, along lines, that one surface goes through.
std::vector<float> run_widths(const Cloud& cloud, const std::vector<LinePlace>& places) {
  Components runs(cloud.size());
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    const std::uint32_t next = places[i].next;
    if (!places[i].plane || !places[next].plane) continue;
    const bool close = glm::distance(cloud.coord[i], cloud.coord[next]) <= EVEN_RUN * places[i].step;
    if (close && std::abs(glm::dot(cloud.normal[i], cloud.normal[next])) > ONE_SURFACE_COSINE)
      runs.join(i, next);
  }
  std::vector<float> sums(cloud.size(), 0.0F), widths(cloud.size(), 0.0F);
  for (std::uint32_t i = 0; i < cloud.size(); ++i)
    if (places[i].plane) sums[runs.find(i)] += places[i].step;
  for (std::uint32_t i = 0; i < cloud.size(); ++i) widths[i] = sums[runs.find(i)];
  return widths;
}

}  // namespace

void join_lines(Cloud& cloud, const Survey& survey, bool ellipses, std::vector<LinePlace>& places) {
  if (places.empty()) return;
  std::vector<LinePlane> planes(cloud.size());
  std::vector<glm::vec3> normals = cloud.normal;
  tbb::parallel_for(std::size_t{0}, cloud.size(), [&](std::size_t i) {
    LinePlace& place = places[i];
    if (!(place.step > 0.0F)) return;
    const float surveyed = SURVEYED * survey.wide[i];
    const LinePlane plane = plane_of(places, place, cloud.normal[i], surveyed);
    if (plane.across == glm::vec3(0.0F)) return;
    const bool agrees = std::abs(glm::dot(cloud.normal[i], glm::normalize(plane.across))) <= MISFIT;
    if (survey.estimated[i] == 0 && !agrees) return;
    if (survey.estimated[i] != 0 && !(agrees && plane.ways[0] < surveyed))
      normals[i] = normal_of(place, plane, cloud.normal[i]);
    place.plane = true;
    planes[i] = plane;
  });
  tbb::parallel_for(std::size_t{0}, cloud.size(), [&](std::size_t i) {
    if (places[i].plane) keep_agreed(places, normals, normals[i], planes[i]);
  });
  tbb::parallel_for(std::size_t{0}, cloud.size(), [&](std::size_t i) {
    places[i].plane = planes[i].across != glm::vec3(0.0F);
    if (places[i].plane) cloud.normal[i] = normals[i];
  });
  release(normals);
  cloud.normal = averaged_normals(cloud, survey, places);
  if (!ellipses) return;
  const std::vector<float> widths = run_widths(cloud, places);
  cloud.ellipse.resize(cloud.size());
  cloud.clip.resize(cloud.size());
  cloud.radius_most.resize(cloud.size(), std::numeric_limits<float>::infinity());
  tbb::parallel_for(std::size_t{0}, cloud.size(), [&](std::size_t i) {
    if (!places[i].plane) return;
    for (float& way : planes[i].ways) way = std::min(way, MOST_SLIM * widths[i]);
    cloud.ellipse[i] = ellipse_of(places[i], planes[i], cloud.normal[i]);
    if (cloud.is_ellipse(i))
      cloud.clip[i] = end_of(planes[i], cloud.normal[i]);
    else
      cloud.radius_most[i] = COVERS * std::max({planes[i].ways[0], planes[i].ways[1], places[i].step});
  });
}

}  // namespace splatray
