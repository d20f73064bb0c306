#include "app/library/cut/cut_join.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "engine/base/rank.h"

namespace splatray {
namespace {

// Radii of the splats at an end.
constexpr double BEYOND = 1.5;    ///< that an end may lie behind the corner
constexpr double BEFORE = 3.0;    ///< and before it
constexpr double GAP = 4.0;       ///< that is bridged in a line
constexpr double ASIDE = 0.5;     ///< between the two parts of one line
constexpr double SHORTEST = 4.0;  ///< of a curve
constexpr double BENT = 1.25;     ///< of a thin wall's side before its end
/// The least sine between the sides of a corner: where a curve turns back more sharply, a side is missing.
constexpr double LEAST_CORNER_SINE = 0.26;
constexpr double IN_LINE = 0.966;  ///< cosine of 15 degrees, below which two ends make a corner

/// An end of an open curve, its last point or its first. Which side is a surface's front is not always known, so either may be met
/// by either.
struct End {
  std::size_t curve;
  bool is_last;
};
constexpr std::size_t index_of(const End& end) { return 2 * end.curve + (end.is_last ? 1 : 0); }
constexpr End end_of(std::size_t index) { return {index / 2, index % 2 == 1}; }

/// Two ends that may be joined, by their indices.
struct Joint {
  std::size_t a, b;
  double cost;  ///< how far both are prolonged or cut
  /// Where the curve at `a` ends and that at `b` begins, for a corner the same; none where both lie in one line.
  std::optional<std::array<glm::dvec2, 2>> corners{};
  double dropped = 0.0;  ///< length of both curves at their ends that is not drawn
};

double length_of(const std::vector<glm::dvec2>& points) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += glm::distance(points[i - 1], points[i]);
  return length;
}

std::vector<glm::dvec2> places_of(const TracedCurve& curve) {
  std::vector<glm::dvec2> places;
  for (const CutPoint& point : curve.points) places.push_back(point.place);
  return places;
}

bool is_short(const std::vector<glm::dvec2>& points, double radius) {
  return length_of(points) <= SHORTEST * radius;
}

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

const CutPoint& point_of(const std::vector<TracedCurve>& curves, std::size_t index) {
  const End end = end_of(index);
  return end.is_last ? curves[end.curve].points.back() : curves[end.curve].points.front();
}

/// Unit direction in which the curve would go on beyond its end.
glm::dvec2 way_out(const std::vector<TracedCurve>& curves, std::size_t index) {
  const glm::dvec2 forward = point_of(curves, index).forward();
  return end_of(index).is_last ? forward : -forward;
}

/// How far ahead of the first end of two the face lies that ends a thin wall between them: where the splats in the middle of its
/// thickness are, on the median. Nothing where there are too few.
std::optional<double> end_face(const CutSurface& surface, const CutPoint& first, const CutPoint& second,
                               const glm::dvec2& out) {
  constexpr std::size_t LEAST_SPLATS = 6;
  constexpr double MIDDLE = 0.25;  // of the thickness, to either side
  const glm::dvec2 middle = 0.5 * (first.place + second.place), side(-out.y, out.x);
  const double thickness = glm::dot(second.place - first.place, side);
  std::vector<double> ahead;
  surface.for_each_near(middle, [&](std::uint32_t index, const glm::dvec3& to) {
    if (surface.splats()[index].object != first.object) return;
    if (std::abs(glm::dot(glm::dvec2(to), side)) > MIDDLE * std::abs(thickness)) return;
    ahead.push_back(glm::dot(middle + glm::dvec2(to) - first.place, out));
  });
  if (ahead.size() < LEAST_SPLATS) return {};
  return value_at(ahead, 0.5);
}

/// A side of a thin wall as a straight line that ends where the curve does, but for what bends there: normals of its end's splats are
/// between those of side and end. Nothing of a curve that is too short.
std::optional<CutPoint> straight_end(const std::vector<TracedCurve>& curves, std::size_t index) {
  constexpr double NEAREST = BENT, MIDDLE = 2.5, FARTHEST = 4.0;  // radii from the end
  const CutPoint& end = point_of(curves, index);
  std::array<glm::dvec2, 2> sums{glm::dvec2(0.0), glm::dvec2(0.0)};
  std::array<double, 2> counts{};
  for (const CutPoint& point : curves[index / 2].points) {
    const double away = glm::distance(point.place, end.place) / end.radius;
    if (away < NEAREST || away > FARTHEST) continue;
    const std::size_t part = away < MIDDLE ? 0 : 1;
    sums.at(part) += point.place;
    counts.at(part) += 1.0;
  }
  if (counts[0] < 1.0 || counts[1] < 1.0) return {};
  const glm::dvec2 near = sums[0] / counts[0], out = glm::normalize(near - sums[1] / counts[1]);
  CutPoint straight = end;
  straight.place = near + glm::dot(end.place - near, out) * out;
  const glm::dvec2 forward = end_of(index).is_last ? out : -out;
  straight.normal = glm::dvec3(-forward.y, forward.x, 0.0);
  return straight;
}

/// The end of a thin wall, whose face is too narrow to have a surface of its own: straight across where its splats are, else where the
/// longer side ends.
std::optional<Joint> cap(const CutSurface& surface, const std::vector<TracedCurve>& curves, std::size_t a,
                         std::size_t b) {
  const std::optional<CutPoint> straight_a = straight_end(curves, a), straight_b = straight_end(curves, b);
  const bool both = straight_a && straight_b;
  const CutPoint first = both ? *straight_a : point_of(curves, a),
                 second = both ? *straight_b : point_of(curves, b);
  const double radius = 0.5 * (first.radius + second.radius), most = BEFORE * radius;
  const auto out_of = [](const CutPoint& point, std::size_t index) {
    return end_of(index).is_last ? point.forward() : -point.forward();
  };
  const glm::dvec2 out = glm::normalize(out_of(first, a) + out_of(second, b));
  const glm::dvec2 between = second.place - first.place;
  const double along = glm::dot(between, out), aside = std::abs(cross(out, between));
  if (std::abs(along) > most || aside > most) return {};
  const double face = end_face(surface, first, second, out).value_or(std::max(along, 0.0));
  return Joint{a, b, std::abs(along) + aside,
               std::array{first.place + face * out, second.place + (face - along) * out},
               both ? BENT * radius : 0.0};
}

std::optional<Joint> joint(const CutSurface& surface, const std::vector<TracedCurve>& curves, std::size_t a,
                           std::size_t b) {
  const CutPoint &first = point_of(curves, a), &second = point_of(curves, b);
  const double radius = 0.5 * (first.radius + second.radius);
  if (first.object != second.object) return {};
  if (a / 2 == b / 2 && is_short(places_of(curves[a / 2]), radius)) return {};
  const glm::dvec2 out = way_out(curves, a), in = -way_out(curves, b), between = second.place - first.place;
  if (glm::dot(out, in) > IN_LINE) {
    const double along = glm::dot(between, out), aside = std::abs(cross(out, between));
    if (along < -radius || along > GAP * radius || aside > ASIDE * radius) return {};
    return Joint{a, b, std::abs(along) + aside};
  }
  if (glm::dot(out, in) < -IN_LINE) return cap(surface, curves, a, b);
  const double sine = cross(out, in);
  if (std::abs(sine) < LEAST_CORNER_SINE) return {};
  // The corner is first + on_first * out = second - on_second * in.
  const double on_first = cross(between, in) / sine, on_second = -cross(between, out) / sine;
  for (const double on : {on_first, on_second})
    if (on < -BEYOND * radius || on > BEFORE * radius) return {};
  const glm::dvec2 corner = first.place + on_first * out;
  return Joint{a, b, std::abs(on_first) + std::abs(on_second), std::array{corner, corner}};
}

/// All that may be, the cheapest first.
std::vector<Joint> possible_joints(const CutSurface& surface, const std::vector<TracedCurve>& curves) {
  std::vector<std::size_t> ends;
  double most_radius = 0.0;
  for (std::size_t i = 0; i < curves.size(); ++i)
    for (const bool is_last : {false, true}) {
      if (curves[i].closed) continue;
      ends.push_back(index_of({i, is_last}));
      most_radius = std::max(most_radius, point_of(curves, ends.back()).radius);
    }
  const auto x_of = [&curves](std::size_t end) { return point_of(curves, end).place.x; };
  std::sort(ends.begin(), ends.end(), [&](std::size_t a, std::size_t b) { return x_of(a) < x_of(b); });
  const double reach = (2.0 * BEFORE + GAP) * most_radius;
  std::vector<Joint> joints;
  for (auto a = ends.begin(); a != ends.end(); ++a)
    for (auto b = a + 1; b != ends.end() && x_of(*b) < x_of(*a) + reach; ++b)
      if (const std::optional<Joint> found = joint(surface, curves, *a, *b)) joints.push_back(*found);
  std::stable_sort(joints.begin(), joints.end(),
                   [](const Joint& a, const Joint& b) { return a.cost < b.cost; });
  return joints;
}

/// The joint of each end, by index.
using Joints = std::vector<std::optional<Joint>>;

Joints joints_of(const CutSurface& surface, const std::vector<TracedCurve>& curves) {
  Joints joints(2 * curves.size());
  for (const Joint& joint : possible_joints(surface, curves))
    if (!joints[joint.a] && !joints[joint.b]) joints[joint.a] = joints[joint.b] = joint;
  return joints;
}

/// The curve's places from one of its ends to the other, without what lies behind a place at either, and without a length at either.
std::vector<glm::dvec2> trimmed(const std::vector<TracedCurve>& curves, std::size_t from_end,
                                const std::optional<glm::dvec2>& from, const std::optional<glm::dvec2>& to,
                                const std::array<double, 2>& dropped) {
  const End begin = end_of(from_end);
  std::vector<glm::dvec2> places = places_of(curves[begin.curve]);
  if (begin.is_last) std::reverse(places.begin(), places.end());
  const glm::dvec2 back = way_out(curves, from_end), on = way_out(curves, from_end ^ 1U);
  auto first = places.begin(), last = places.end();
  const glm::dvec2 begin_place = places.front(), end_place = places.back();
  while (first != last && glm::distance(*first, begin_place) < dropped[0]) ++first;
  while (first != last && glm::distance(*(last - 1), end_place) < dropped[1]) --last;
  if (from)
    while (first != last && glm::dot(*first - *from, back) >= 0.0) ++first;
  if (to)
    while (first != last && glm::dot(*(last - 1) - *to, on) >= 0.0) --last;
  return {first, last};
}

/// The curves from an end on, as far as they are joined.
CutCurve chain_from(std::size_t start, const std::vector<TracedCurve>& curves, const Joints& joints,
                    std::vector<bool>& is_done) {
  CutCurve chain;
  double front_left = 0.0;  // length with the front to the left, less the other
  const auto turned_to_front = [&] {
    if (front_left < 0.0) std::reverse(chain.points.begin(), chain.points.end());
    return std::move(chain);
  };
  std::size_t end = start;
  while (!is_done[end / 2]) {
    is_done[end / 2] = true;
    const std::optional<Joint>&before = joints[end], &next = joints[end ^ 1U];
    std::optional<glm::dvec2> from, to;
    if (before && before->corners) from = (*before->corners)[before->a == end ? 0 : 1];
    if (before && !from && !chain.points.empty()) from = chain.points.back();
    const bool turned = next && next->b == (end ^ 1U);
    if (next && next->corners) to = (*next->corners)[turned ? 1 : 0];
    const std::vector<glm::dvec2> places =
        trimmed(curves, end, from, to, {before ? before->dropped : 0.0, next ? next->dropped : 0.0});
    for (const CutPoint& point : curves[end / 2].points) chain.radius = std::max(chain.radius, point.radius);
    front_left += (end_of(end).is_last ? -1.0 : 1.0) * length_of(places);
    chain.points.insert(chain.points.end(), places.begin(), places.end());
    if (to) chain.points.push_back(*to);
    if (!next) return turned_to_front();
    if (next->corners && (*next->corners)[0] != (*next->corners)[1])
      chain.points.push_back((*next->corners)[turned ? 0 : 1]);
    end = turned ? next->a : next->b;
  }
  chain.closed = true;
  return turned_to_front();
}

double distance_to_segment(const glm::dvec2& point, const glm::dvec2& from, const glm::dvec2& to) {
  const glm::dvec2 along = to - from;
  const double squared = glm::dot(along, along);
  const double part = squared > 0.0 ? std::clamp(glm::dot(point - from, along) / squared, 0.0, 1.0) : 0.0;
  return glm::distance(point, from + part * along);
}

/// Marks the points between two kept ones that must be kept, too.
void mark_kept(const std::vector<glm::dvec2>& points, std::size_t first, std::size_t last, double tolerance,
               std::vector<bool>& is_kept) {
  std::vector<std::array<std::size_t, 2>> ranges{{first, last}};
  while (!ranges.empty()) {
    const auto [from, to] = ranges.back();
    ranges.pop_back();
    double most = tolerance;
    std::size_t farthest = from;
    for (std::size_t i = from + 1; i < to; ++i)
      if (const double away = distance_to_segment(points[i], points[from], points[to]); away > most) {
        most = away;
        farthest = i;
      }
    if (farthest == from) continue;
    is_kept[farthest] = true;
    ranges.push_back({from, farthest});
    ranges.push_back({farthest, to});
  }
}

}  // namespace

std::vector<CutCurve> joined(const CutSurface& surface, const std::vector<TracedCurve>& curves) {
  const Joints joints = joints_of(surface, curves);
  std::vector<bool> is_done(curves.size());
  std::vector<CutCurve> chains;
  // First the open chains from where they begin, then the closed ones from anywhere.
  for (const bool open : {true, false})
    for (std::size_t end = 0; end < joints.size(); ++end) {
      if (is_done[end / 2] || (open && joints[end])) continue;
      CutCurve chain = chain_from(end, curves, joints, is_done);
      chain.closed = chain.closed || curves[end / 2].closed;
      if (!is_short(chain.points, curves[end / 2].points.front().radius)) chains.push_back(std::move(chain));
    }
  return chains;
}

CutCurve simplified(const CutCurve& curve, double tolerance) {
  std::vector<glm::dvec2> points = curve.points;
  if (points.size() < 3) return curve;
  // A closed curve is two between its first point and the farthest from that, so that both are real corners or as good as any.
  if (curve.closed) {
    const auto farther = [&points](const glm::dvec2& a, const glm::dvec2& b) {
      return glm::distance(a, points.front()) < glm::distance(b, points.front());
    };
    std::rotate(points.begin(), std::max_element(points.begin(), points.end(), farther), points.end());
    points.push_back(points.front());
  }
  std::vector<bool> is_kept(points.size());
  is_kept.front() = is_kept.back() = true;
  std::size_t middle = 0;
  if (curve.closed) {
    for (std::size_t i = 1; i < points.size(); ++i)
      if (glm::distance(points[i], points[0]) > glm::distance(points[middle], points[0])) middle = i;
    is_kept[middle] = true;
    mark_kept(points, 0, middle, tolerance, is_kept);
  }
  mark_kept(points, middle, points.size() - 1, tolerance, is_kept);
  CutCurve simple{{}, curve.closed, curve.radius};
  for (std::size_t i = 0; i + (curve.closed ? 1 : 0) < points.size(); ++i)
    if (is_kept[i]) simple.points.push_back(points[i]);
  return simple;
}

}  // namespace splatray
