#include "app/library/cut/cut_trace.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace splatray {
namespace {

constexpr double STEP = 0.5;  ///< radii
/// Radii from splat to splat over which a curve goes on. Of points in squares whose discs just cover the plane it is at most 2.3.
constexpr double MOST_GAP = 2.6;
constexpr double LEAST_STEP = 0.06;     ///< of a step, with which a curve's end is found
constexpr double MOST_TURN_DEG = 20.0;  ///< of a step: what turns more is a corner
constexpr double DONE = 1.25;           ///< radii of a splat, from a curve that has taken it
constexpr double DONE_COSINE = 0.5;     ///< and of normals
constexpr std::uint32_t NOBODY = std::numeric_limits<std::uint32_t>::max();

class CurveTracer {
 public:
  CurveTracer(const CutSurface& surface, const std::function<bool(const glm::dvec2&)>& holds)
      : surface_(surface), holds_(holds), owners_(surface.splats().size(), NOBODY) {}

  std::vector<TracedCurve> run() {
    for (const Seed& seed : seeds()) {
      if (owners_[seed.splat] != NOBODY) continue;
      const std::uint32_t curve = static_cast<std::uint32_t>(curves_.size());
      take(seed.point, curve);
      TracedCurve traced = walk(seed.point, 1.0, curve);
      traced.points.insert(traced.points.begin(), seed.point);
      if (!traced.closed) {
        const TracedCurve before = walk(seed.point, -1.0, curve);
        traced.points.insert(traced.points.begin(), before.points.rbegin(), before.points.rend());
      }
      curves_.push_back(std::move(traced));
    }
    return std::move(curves_);
  }

 private:
  struct Seed {
    CutPoint point;
    std::size_t splat;
  };

  /// The splats that the plane crosses, those with the most around them first: a corner's, whose normals are none of its sides', come
  /// when the sides have taken them.
  std::vector<Seed> seeds() const {
    std::vector<Seed> seeds;
    for (std::size_t i = 0; i < surface_.splats().size(); ++i)
      if (const auto point = surface_.project(surface_.splats()[i]); point && is_inside(*point))
        seeds.push_back({*point, i});
    std::stable_sort(seeds.begin(), seeds.end(),
                     [](const Seed& a, const Seed& b) { return a.point.support > b.point.support; });
    return seeds;
  }

  bool is_inside(const CutPoint& point) const { return point.gap < MOST_GAP && holds_(point.place); }

  /// Points from there on, `sign` 1 along forward() and -1 against it.
  TracedCurve walk(const CutPoint& start, double sign, std::uint32_t curve) {
    TracedCurve traced;
    CutPoint at = start;
    while (const std::optional<CutPoint> next = step(at, sign)) {
      if (is_of_another(*next, curve)) break;
      const double length = glm::distance(next->place, at.place);
      traced.closed = traced.points.size() > 3 && glm::distance(next->place, start.place) < 0.75 * length &&
                      glm::dot(next->normal, start.normal) > 0.0;
      if (traced.closed) break;
      take(*next, curve);
      traced.points.push_back(*next);
      at = *next;
    }
    return traced;
  }

  /// The next point; the nearer ones where the surface ends or bends before the farthest.
  std::optional<CutPoint> step(const CutPoint& at, double sign) const {
    for (double part = 1.0; part > LEAST_STEP; part *= 0.5) {
      const glm::dvec2 way = sign * part * STEP * at.radius * at.forward();
      CutPoint guess = at;
      guess.place += way;
      const std::optional<CutPoint> next = surface_.project(guess);
      if (!next || !is_inside(*next)) continue;
      const double on = glm::dot(next->place - at.place, way) / glm::dot(way, way);
      const double most_turn = std::cos(glm::radians(part * MOST_TURN_DEG));
      if (on > 0.5 && on < 2.0 && glm::dot(next->normal, at.normal) > most_turn) return next;
    }
    return {};
  }

  void take(const CutPoint& point, std::uint32_t curve) {
    surface_.for_each_near(point.place, [&](std::uint32_t index, const glm::dvec3& to) {
      const CutSplat& splat = surface_.splats()[index];
      const bool is_like = splat.object == point.object && glm::dot(splat.normal, point.normal) > DONE_COSINE;
      if (is_like && glm::length(to) < DONE * splat.radius && owners_[index] == NOBODY)
        owners_[index] = curve;
    });
  }

  /// Whether the nearest splat of the point's side is an earlier curve's.
  bool is_of_another(const CutPoint& point, std::uint32_t curve) const {
    double least = std::numeric_limits<double>::infinity();
    std::uint32_t owner = NOBODY;
    surface_.for_each_near(point.place, [&](std::uint32_t index, const glm::dvec3& to) {
      const CutSplat& splat = surface_.splats()[index];
      const double away = glm::length(to);
      if (splat.object != point.object || glm::dot(splat.normal, point.normal) < DONE_COSINE || away >= least)
        return;
      least = away;
      owner = owners_[index];
    });
    return owner != NOBODY && owner != curve;
  }

  const CutSurface& surface_;
  const std::function<bool(const glm::dvec2&)>& holds_;
  std::vector<std::uint32_t> owners_;  ///< of each splat: the curve that has taken it
  std::vector<TracedCurve> curves_;
};

}  // namespace

std::vector<TracedCurve> trace_curves(const CutSurface& surface,
                                      const std::function<bool(const glm::dvec2&)>& holds) {
  return CurveTracer(surface, holds).run();
}

}  // namespace splatray
