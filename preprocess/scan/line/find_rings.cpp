#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <span>

#include "preprocess/base/select.h"
#include "preprocess/scan/line/lines.h"
#include "preprocess/scan/plane_fit.h"

namespace splatray {
namespace {

constexpr std::size_t FEWEST_RINGS_POINTS = 1000;
constexpr double SAME_RING = 0.5;    // of a step: directions on one ring differ less in elevation
constexpr int STEPS_BESIDE = 3;      // columns in which the next point of a ring may be
constexpr int HOPS = 3;              // along a ring, that its direction is taken from
constexpr float EVEN_STEPS = 2.5F;   // one step over the other, of steps that are alike
constexpr double USUAL_GAP = 0.6;    // rank of the angle between rings that bounds discs
constexpr float COVERS_GAP = 0.75F;  // half a disc over the way to the next ring
constexpr float SIGHT =
    0.25F;  // sine of the angle that a plane is seen at, of what noise along the line of sight makes

/// Directions that points are seen in.
struct Directions {
  std::vector<float> azimuth, elevation;  ///< radians
};

/// What a scanner sees that turns about an axis.
class ScannerFrame {
 public:
  ScannerFrame(const glm::dvec3& sensor, const glm::dvec3& axis) : sensor_(sensor), axis_(axis) {
    const glm::dvec3 side = std::abs(axis.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    u_ = glm::normalize(glm::cross(axis, side));
    v_ = glm::cross(axis, u_);
  }

  /// Azimuth and elevation of a place, radians.
  [[nodiscard]] glm::vec2 direction(const glm::vec3& place) const {
    const glm::dvec3 to = glm::dvec3(place) - sensor_;
    const double x = glm::dot(to, u_), y = glm::dot(to, v_);
    return {static_cast<float>(std::atan2(y, x) + std::numbers::pi),
            static_cast<float>(std::atan2(glm::dot(to, axis_), std::hypot(x, y)))};
  }

 private:
  glm::dvec3 sensor_, axis_, u_, v_;
};

Directions directions_of(const Cloud& cloud, const std::vector<std::uint32_t>& points,
                         const ScannerFrame& scanner) {
  Directions directions{std::vector<float>(points.size()), std::vector<float>(points.size())};
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t n) {
    const glm::vec2 direction = scanner.direction(cloud.coord[points[n]]);
    directions.azimuth[n] = direction.x;
    directions.elevation[n] = direction.y;
  });
  return directions;
}

float ranked(std::vector<float> values, double share) {
  if (values.empty()) return 0.0F;
  const auto rank = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1));
  select_nth(std::span(values), rank, std::identity());
  return values[rank];
}

/// From one angle to another, the shorter way round.
float turn_between(float from, float to) {
  constexpr auto ROUND = static_cast<float>(2.0 * std::numbers::pi);
  const float turn = to - from;
  return turn > 0.5F * ROUND ? turn - ROUND : turn < -0.5F * ROUND ? turn + ROUND : turn;
}

/// A sweep's points in columns as wide as a step, each ascending in elevation. Numbers are those of its points.
class SweepColumns {
 public:
  SweepColumns(const Directions& directions, float step)
      : directions_(directions),
        count_(static_cast<std::size_t>(2.0 * std::numbers::pi / step) + 1),
        step_(step) {
    const std::size_t size = directions.azimuth.size();
    std::vector<std::uint32_t> column(size);
    begin_.assign(count_ + 1, 0);
    for (std::size_t n = 0; n < size; ++n) {
      column[n] = std::min(static_cast<std::uint32_t>(directions.azimuth[n] / step),
                           static_cast<std::uint32_t>(count_ - 1));
      ++begin_[column[n] + 1];
    }
    for (std::size_t c = 0; c < count_; ++c) begin_[c + 1] += begin_[c];
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    order_.resize(size);
    for (std::uint32_t n = 0; n < size; ++n) order_[next[column[n]]++] = n;
    tbb::parallel_for(std::size_t{0}, count_, [&](std::size_t c) {
      std::sort(order_.begin() + begin_[c], order_.begin() + begin_[c + 1],
                [&](std::uint32_t a, std::uint32_t b) {
                  return directions.elevation[a] < directions.elevation[b] ||
                         (directions.elevation[a] == directions.elevation[b] && a < b);
                });
    });
  }

  /// The points on the same ring to the left and right, on the next rings below and above; NO_CELL where there is none.
  struct Beside {
    std::uint32_t left = NO_CELL, right = NO_CELL, below = NO_CELL, above = NO_CELL;
  };
  [[nodiscard]] Beside beside(std::uint32_t n) const {
    Beside found;
    float left = -STEPS_BESIDE * step_, right = STEPS_BESIDE * step_;
    float below = -std::numeric_limits<float>::infinity(), above = -below;
    const float same = static_cast<float>(SAME_RING) * step_;
    for (int by = -STEPS_BESIDE; by <= STEPS_BESIDE; ++by) {
      const auto [from, to] = column_at(n, by);
      const auto middle = std::lower_bound(
          from, to, directions_.elevation[n] - same,
          [&](std::uint32_t a, float elevation) { return directions_.elevation[a] < elevation; });
      auto at = middle;
      for (; at != to && directions_.elevation[*at] <= directions_.elevation[n] + same; ++at) {
        const float turn = turn_between(directions_.azimuth[n], directions_.azimuth[*at]);
        if (*at == n) continue;
        if (turn < 0.0F && turn > left) left = turn, found.left = *at;
        if (turn > 0.0F && turn < right) right = turn, found.right = *at;
      }
      if (std::abs(by) > 1) continue;
      if (at != to && directions_.elevation[*at] < above)
        above = directions_.elevation[*at], found.above = *at;
      if (middle != from && directions_.elevation[*(middle - 1)] > below)
        below = directions_.elevation[*(middle - 1)], found.below = *(middle - 1);
    }
    return found;
  }

 private:
  using Iterator = std::vector<std::uint32_t>::const_iterator;
  [[nodiscard]] std::pair<Iterator, Iterator> column_at(std::uint32_t n, int by) const {
    const auto own = std::min(static_cast<std::size_t>(directions_.azimuth[n] / step_), count_ - 1);
    const std::size_t c =
        (own + count_ + static_cast<std::size_t>(by + STEPS_BESIDE) - STEPS_BESIDE) % count_;
    return {order_.begin() + begin_[c], order_.begin() + begin_[c + 1]};
  }
  const Directions& directions_;
  std::size_t count_;
  float step_;
  std::vector<std::uint32_t> begin_, order_;
};

/// The median turn of steps along lines that are rings.
float step_angle(const Cloud& cloud, const std::vector<std::uint32_t>& points, const ScannerFrame& scanner,
                 const std::vector<LinePlace>& places) {
  std::vector<float> turns;
  for (const std::uint32_t i : points) {
    if (!(places[i].step > 0.0F)) continue;
    const glm::vec2 from = scanner.direction(cloud.coord[i]),
                    to = scanner.direction(cloud.coord[places[i].next]);
    const float turn = std::abs(turn_between(from.x, to.x));
    if (turn > std::abs(to.y - from.y)) turns.push_back(turn);
  }
  return ranked(std::move(turns), 0.5);
}

/// Steps to the neighbours on two sides: the longer one where both are of one surface, and 0 where there is none.
float usual_step(float a, float b) {
  const float less = std::min(a, b), more = std::max(a, b);
  return less == 0.0F ? more : more <= EVEN_STEPS * less ? more : less;
}

/// Makes places of a sweep's neighbours.
class RingPlaces {
 public:
  RingPlaces(const Cloud& cloud, const std::vector<std::uint32_t>& points, const glm::dvec3& sensor,
             const Directions& directions, const std::vector<SweepColumns::Beside>& beside)
      : cloud_(cloud), points_(points), sensor_(sensor), directions_(directions), beside_(beside) {}

  [[nodiscard]] LinePlace place(std::uint32_t n) const {
    const SweepColumns::Beside& beside = beside_[n];
    const float along = usual_step(length(n, beside.left), length(n, beside.right));
    const float across = usual_step(length(n, beside.below), length(n, beside.above));
    if (along == 0.0F || across == 0.0F) return {};
    // Else columns are the closer lines, as on walls that are seen at a slant.
    const bool on_ring = along <= across;
    const std::vector<float>& angle = on_ring ? directions_.azimuth : directions_.elevation;
    const std::uint32_t from =
        hop(n, on_ring ? &SweepColumns::Beside::left : &SweepColumns::Beside::below, std::min(along, across));
    const std::uint32_t to = hop(n, on_ring ? &SweepColumns::Beside::right : &SweepColumns::Beside::above,
                                 std::min(along, across));
    const float turned = turn_between(angle[from], angle[to]);
    if (turned == 0.0F) return {};
    const glm::vec3 by_turn = offset_to(from, to) / turned;
    LinePlace place;
    place.along = glm::normalize(by_turn);
    place.step = std::min(along, across);
    const std::uint32_t ahead = on_ring ? beside.right : beside.above,
                        back = on_ring ? beside.left : beside.below;
    place.next = points_[length(n, ahead) > 0.0F &&
                                 (length(n, back) == 0.0F || length(n, ahead) <= EVEN_STEPS * place.step)
                             ? ahead
                             : back];
    std::size_t side = 0;
    for (const std::uint32_t m :
         {on_ring ? beside.below : beside.left, on_ring ? beside.above : beside.right}) {
      if (length(n, m) == 0.0F) continue;
      place.beside[side] =
          offset_to(n, m) - by_turn * (turn_between(angle[n], angle[m]) * range_of(m) / range_of(n));
      place.other[side++] = points_[m];
    }
    return place;
  }

 private:
  [[nodiscard]] glm::vec3 offset_to(std::uint32_t n, std::uint32_t m) const {
    return cloud_.coord[points_[m]] - cloud_.coord[points_[n]];
  }
  [[nodiscard]] float range_of(std::uint32_t n) const {
    return glm::length(cloud_.coord[points_[n]] - sensor_);
  }
  /// What is further than the sensor is of another surface.
  [[nodiscard]] float length(std::uint32_t n, std::uint32_t m) const {
    const float length = m == NO_CELL ? 0.0F : glm::length(offset_to(n, m));
    return length < range_of(n) ? length : 0.0F;
  }
  /// The point a few steps further, as long as these are alike.
  [[nodiscard]] std::uint32_t hop(std::uint32_t n, std::uint32_t SweepColumns::Beside::*next,
                                  float step) const {
    for (int hops = 0; hops < HOPS; ++hops) {
      const std::uint32_t m = beside_[n].*next;
      if (m == NO_CELL || length(n, m) > EVEN_STEPS * step) break;
      n = m;
    }
    return n;
  }

  const Cloud& cloud_;
  const std::vector<std::uint32_t>& points_;
  const glm::vec3 sensor_;
  const Directions& directions_;
  const std::vector<SweepColumns::Beside>& beside_;
};

}  // namespace

glm::dvec3 axis_of_lines(const std::vector<LinePlace>& places) {
  Covariance sums{};
  for (const LinePlace& place : places) {
    const glm::dvec3 along(place.along);
    sums.xx += along.x * along.x, sums.yy += along.y * along.y, sums.zz += along.z * along.z;
    sums.xy += along.x * along.y, sums.xz += along.x * along.z, sums.yz += along.y * along.z;
  }
  return least_axis_of(sums, variances_of(sums));
}

std::optional<Sweep> find_rings(const Cloud& cloud, const std::vector<std::uint32_t>& points,
                                const glm::dvec3& sensor, std::vector<LinePlace>& places) {
  if (places.empty() || points.size() < FEWEST_RINGS_POINTS) return {};
  const glm::dvec3 axis = find_ring_axis(cloud, points, sensor).value_or(axis_of_lines(places));
  if (axis == glm::dvec3(0.0)) return {};
  const ScannerFrame scanner(sensor, axis);
  const float step = step_angle(cloud, points, scanner, places);
  if (!(step > 0.0F)) return {};
  const Directions directions = directions_of(cloud, points, scanner);
  const SweepColumns columns(directions, step);
  std::vector<SweepColumns::Beside> beside(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(),
                    [&](std::size_t n) { beside[n] = columns.beside(static_cast<std::uint32_t>(n)); });
  const RingPlaces rings(cloud, points, sensor, directions, beside);
  tbb::parallel_for(std::size_t{0}, points.size(),
                    [&](std::size_t n) { places[points[n]] = rings.place(static_cast<std::uint32_t>(n)); });
  std::vector<float> gaps;
  for (std::size_t n = 0; n < points.size(); ++n)
    if (beside[n].above != NO_CELL)
      gaps.push_back(directions.elevation[beside[n].above] - directions.elevation[n]);
  return Sweep{sensor, std::max(step, ranked(std::move(gaps), USUAL_GAP))};
}

void settle_rest(Cloud& cloud, const Survey& survey, const std::vector<std::uint32_t>& points,
                 const Sweep& sweep, bool bound, std::vector<LinePlace>& places) {
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t n) {
    const std::uint32_t i = points[n];
    const glm::vec3 to_sensor(sweep.sensor - glm::dvec3(cloud.coord[i]));
    const float range = glm::length(to_sensor);
    if (!(range > 0.0F)) return;
    const glm::vec3 sight = to_sensor / range;
    glm::vec3& normal = cloud.normal[i];
    const bool plane = places[i].plane;
    if (!plane && survey.estimated[i] != 0 && std::abs(glm::dot(normal, sight)) < SIGHT) normal = sight;
    if (!bound || cloud.is_ellipse(i)) return;
    const float sine = plane ? std::max(std::abs(glm::dot(normal, sight)), SIGHT) : 1.0F;
    const float most = COVERS_GAP * static_cast<float>(sweep.gap) * range / sine;
    cloud.radius_most[i] = std::min(most, cloud.radius_most[i]);
  });
}

}  // namespace splatray
