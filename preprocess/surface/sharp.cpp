#include "preprocess/surface/sharp.h"

#include <tbb/concurrent_vector.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "engine/scene/splat.h"
#include "preprocess/surface/edge_planes.h"

namespace splatray {
namespace {

constexpr std::size_t SPACING_RANK = 5;  // the sixth neighbour is one spacing away
constexpr std::size_t SEED_STEP =
    2;  // of the points that may be sharp: every fourth would lose half a percent of the creases
constexpr float ROOM = 1.3F;            // of a squared distance, for as many places as expected
constexpr double GIVEN_COSINE = 0.95;   // 18 degrees: a given normal agrees with its plane
constexpr double SAME_COSINE = 0.9945;  // 6 degrees: it is more exact than the plane, else interpolated, too
constexpr double SMOOTH_SHARE =
    1.0 / 3.0;                     // of the crease's angle: normals that differ less have none among them
constexpr std::size_t AGREED = 2;  // of the close neighbours, that must show the same
constexpr double ALIKE_COSINE = 0.978;       // 12 degrees: two planes agree
constexpr double BORDER_COSINE = 0.9;        // 26 degrees: two borders do
constexpr std::size_t TRIALS = 2000;         // points that show whether there is anything to find
constexpr std::size_t TRIAL_NEIGHBOURS = 4;  // beside each of them
constexpr std::size_t TRIAL_AGREED = 2;      // of which at least this many must agree
constexpr double NOISE_TRIALS = 0.5;   // of the trials, that lie where the surface bends: noise hides borders
constexpr double PROMISE = 0.06;       // of those that lie where the surface bends
constexpr double BORDER_TRIALS = 4.0;  // times the root of all points: as many as a square has at its border
constexpr std::size_t BENT_ENDS =
    8;  // of them at borders, where the surface bends: half of what a square has
constexpr double STRAIGHT_GAP = 160.0 * std::numbers::pi / 180.0;
constexpr double CORNER_GAP = 200.0 * std::numbers::pi / 180.0;
constexpr double ROUND_LEAST =
    0.1;  // least variance in the plane / largest: neighbours on a line show no border
constexpr double EMPTY_REACH = 3.0;  // of the neighbourhood's radius: how far it is empty behind a border

/// The direction into the widest gap between a point's neighbours, seen in a plane.
struct Gap {
  double width;   ///< radians
  double middle;  ///< angle
  double begin, end;
};

/// The bit of the octant that a direction in a plane lies in; the octants' bits are in their order around.
unsigned octant_bit(double x, double y) {
  constexpr std::array<unsigned, 8> AROUND{0, 1, 3, 2, 7, 6, 4, 5};  // by signs, and which is longer
  const unsigned below = y < 0.0 ? 4 : 0, left = x < 0.0 ? 2 : 0, steep = std::abs(y) > std::abs(x) ? 1 : 0;
  return 1U << AROUND[below + left + steep];
}

/// Whether two octants next to each other are empty, of those around.
bool has_empty_quarter(unsigned filled) {
  const unsigned empty = ~filled & 0xFFU;
  return (empty & (empty >> 1U | empty << 7U)) != 0;
}

/// Nothing where no gap is as wide as at a border: such a gap has two whole octants in it.
std::optional<Gap> widest_gap(const Around& around, const TangentFrame& frame) {
  static_assert(STRAIGHT_GAP > 0.75 * std::numbers::pi);
  std::array<glm::dvec2, Around::MOST> places;
  unsigned filled = 0;
  glm::dvec3 squares(0.0);
  for (std::size_t j = 0; j < around.count; ++j) {
    const double x = glm::dot(around.offset[j], frame.u), y = glm::dot(around.offset[j], frame.v);
    places[j] = {x, y};
    filled |= octant_bit(x, y);
    squares += glm::dvec3(x * x, x * y, y * y);
  }
  if (!has_empty_quarter(filled)) return {};
  std::array<double, Around::MOST> angles;
  for (std::size_t j = 0; j < around.count; ++j) angles[j] = std::atan2(places[j].y, places[j].x);
  const double mean = 0.5 * (squares.x + squares.z);
  const double apart = std::hypot(0.5 * (squares.x - squares.z), squares.y);
  if (mean - apart < ROUND_LEAST * (mean + apart)) return {};
  const auto end = angles.begin() + static_cast<std::ptrdiff_t>(around.count);
  std::sort(angles.begin(), end);
  Gap gap{};
  for (std::size_t j = 0; j < around.count; ++j) {
    const double from = angles[j];
    const double to = j + 1 < around.count ? angles[j + 1] : angles[0] + 2.0 * std::numbers::pi;
    if (to - from > gap.width) gap = {to - from, 0.5 * (from + to), from, to};
  }
  return gap;
}

/// What was found at a point.
struct Found {
  std::uint32_t point = 0;
  bool crease = false;        ///< else a border
  double spacing = 0.0;       ///< cloud coordinates
  double reach = 0.0;         ///< of the neighbourhood, spacings
  std::vector<Side> sides{};  ///< none where nothing is clear
};

bool alike(const glm::dvec3& a, const glm::dvec3& b) { return std::abs(glm::dot(a, b)) > ALIKE_COSINE; }

/// Whether two lines, each with the normal of its plane, are of one crease or border.
bool agree(const glm::dvec3& normal_a, const Line& a, const glm::dvec3& normal_b, const Line& b) {
  if (a.other == glm::dvec3(0.0)) return glm::dot(a.out, b.out) > BORDER_COSINE;
  return (alike(normal_a, normal_b) && alike(a.other, b.other)) ||
         (alike(normal_a, b.other) && alike(a.other, normal_b));
}

/// Whether two points show the same crease or border.
bool agree(const Found& a, const Found& b) {
  if (a.crease != b.crease) return false;
  for (const Side& one : a.sides)
    for (const Side& two : b.sides)
      for (std::size_t i = 0; i < one.count; ++i)
        for (std::size_t k = 0; k < two.count; ++k)
          if (agree(one.normal, one.lines[i], two.normal, two.lines[k])) return true;
  return false;
}

/// Finds creases and borders around the points of one cloud.
class SharpSearch {
 public:
  SharpSearch(const Cloud& cloud, const NearPlaces& near, double crease_degrees,
              std::span<const std::uint8_t> estimated)
      : cloud_(cloud),
        estimated_(estimated),
        crease_(crease_degrees * std::numbers::pi / 180.0),
        cos_smooth_(std::cos(SMOOTH_SHARE * crease_)),
        sin_smooth_(std::sin(SMOOTH_SHARE * crease_)),
        near_(near),
        search_(near.search()) {}

  /// Whether a few points, spread over the cloud, show that there is something to find: noise bends surfaces everywhere, and
  /// where nothing bends, or less than noise would where normals are given, there may be borders.
  [[nodiscard]] bool promises() const {
    std::atomic<std::size_t> bent = 0, agreed = 0;
    const std::size_t tried = try_points(TRIALS, [&](const Found& found, std::span<const Neighbour> nearest) {
      if (!found.crease) return;
      ++bent;
      if (found.sides.empty()) return;
      std::size_t alike = 0;
      for (std::size_t j = 0; j < TRIAL_NEIGHBOURS; ++j) {
        std::array<Neighbour, Around::MOST> its;
        alike += agree(found, look_at(nearest[j].index(), its)) ? 1 : 0;
      }
      agreed += alike >= TRIAL_AGREED ? 1 : 0;
    });
    if (bent > 0 && static_cast<double>(agreed) >= PROMISE * static_cast<double>(bent)) return true;
    const bool given = std::find(estimated_.begin(), estimated_.end(), 0) != estimated_.end();
    if (bent > 0 && (!given || static_cast<double>(bent) > NOISE_TRIALS * static_cast<double>(tried)))
      return false;
    std::atomic<std::size_t> ends = 0;
    const auto trials =
        static_cast<std::size_t>(BORDER_TRIALS * std::sqrt(static_cast<double>(cloud_.size())));
    try_points(trials, [&](const Found& found, std::span<const Neighbour>) {
      if ((bent == 0 || !found.crease) && !found.sides.empty()) ++ends;
    });
    return ends >= (bent > 0 ? BENT_ENDS : 1);
  }

  /// All sides of all points that enough of their neighbours agree with.
  [[nodiscard]] SharpSides run(const Stage& stage) const {
    SharpSides result;
    const std::vector<Found> all = find_along(stage, result.looked_at);
    std::vector<std::uint8_t> agreed(all.size());
    tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t i) {
      std::size_t alike = 0;
      for (const std::uint32_t neighbour : near_.around(all[i].point)) {
        const Found key{.point = neighbour};
        const auto other = std::lower_bound(all.begin(), all.end(), key, by_point);
        alike += other != all.end() && other->point == neighbour && agree(all[i], *other) ? 1 : 0;
      }
      agreed[i] = alike >= AGREED ? 1 : 0;
    });
    for (std::size_t i = 0; i < all.size(); ++i)
      if (agreed[i] != 0) add_sides(all[i], result.sides);
    return result;
  }

 private:
  static bool by_point(const Found& a, const Found& b) { return a.point < b.point; }

  /// What every SEED_STEP-th of the points that may be sharp shows, then the others beside what was found, and so on; by point.
  [[nodiscard]] std::vector<Found> find_along(const Stage& stage, std::size_t& looked_at) const {
    std::vector<std::uint8_t> may_be(cloud_.size());
    parallel_each(stage, may_be.size(), [&](std::size_t i) { may_be[i] = may_be_sharp(i) ? 1 : 0; });
    std::vector<std::uint32_t> batch =
        numbers_where(may_be.size(), [&](std::size_t i) { return may_be[i] != 0; });
    for (std::size_t n = 0; SEED_STEP * n < batch.size(); ++n) batch[n] = batch[SEED_STEP * n];
    batch.resize((batch.size() + SEED_STEP - 1) / SEED_STEP);
    std::vector<std::uint8_t> waits(cloud_.size(), 1);
    tbb::concurrent_vector<Found> found;
    while (!batch.empty()) {
      looked_at += batch.size();
      for (const std::uint32_t i : batch) waits[i] = 0;
      const std::size_t before = found.size();
      look_at_all(batch, stage, found);
      batch.clear();
      for (std::size_t n = before; n < found.size(); ++n)
        for (const std::uint32_t j : near_.around(found[n].point))
          if (std::exchange(waits[j], std::uint8_t{0}) != 0) batch.push_back(j);
      std::sort(batch.begin(), batch.end());
    }
    std::vector<Found> all(found.begin(), found.end());
    std::sort(all.begin(), all.end(), by_point);
    return all;
  }

  /// Whether the nearest few show a bend or a gap: where they do not, neither has a crease or a border anything to say.
  [[nodiscard]] bool may_be_sharp(std::size_t point) const {
    const glm::dvec3 place(cloud_.coord[point]), normal(cloud_.normal[point]);
    const TangentFrame frame(normal);
    unsigned filled = 0;
    for (const std::uint32_t j : near_.around(point)) {
      const glm::dvec3 offset = glm::dvec3(cloud_.coord[j]) - place;
      if (bends(point, normal, j, offset)) return true;
      filled |= octant_bit(glm::dot(offset, frame.u), glm::dot(offset, frame.v));
    }
    return has_empty_quarter(filled);
  }

  /// Whether a point and a neighbour at `offset` lie on a surface that bends between them.
  [[nodiscard]] bool bends(std::size_t point, const glm::dvec3& normal, std::uint32_t other,
                           const glm::dvec3& offset) const {
    const bool steep =
        estimated_[point] == 0 && std::abs(glm::dot(offset, normal)) > sin_smooth_ * glm::length(offset);
    return steep || !(std::abs(glm::dot(glm::dvec3(cloud_.normal[other]), normal)) > cos_smooth_);
  }

  /// Adds what is found at these points, ascending.
  void look_at_all(const std::vector<std::uint32_t>& points, const Stage& stage,
                   tbb::concurrent_vector<Found>& all) const {
    const auto query = [&](std::uint32_t n) -> NeighbourSearch::Query {
      const std::uint32_t point = points[n];
      const glm::vec3 apart = cloud_.coord[near_.around(point, NearPlaces::LISTED - 1)] - cloud_.coord[point];
      const float listed = std::max(glm::dot(apart, apart), COORD_STEP * COORD_STEP);
      return {cloud_.coord[point], ROOM * static_cast<float>(Around::MOST / NearPlaces::LISTED) * listed,
              std::numeric_limits<float>::infinity()};
    };
    search_.find_each(points.size(), query, Around::MOST, stage,
                      [&](std::uint32_t n, std::span<Neighbour> nearest) {
                        std::sort(nearest.begin(), nearest.end());
                        Found found = look_at(points[n], nearest);
                        if (!found.sides.empty()) all.push_back(std::move(found));
                      });
  }

  /// Calls use(what was found at a point, its nearest sites) for about `trials` points, spread over the cloud; for how many.
  template <typename Use>
  std::size_t try_points(std::size_t trials, const Use& use) const {
    if (trials == 0) return 0;  // a cloud of which no point is left
    const std::size_t step = cloud_.size() / trials + 1;
    tbb::parallel_for(std::size_t{0}, cloud_.size() / step, [&](std::size_t trial) {
      std::array<Neighbour, Around::MOST> nearest;
      use(look_at(static_cast<std::uint32_t>(trial * step), nearest), nearest);
    });
    return cloud_.size() / step;
  }

  /// What a point's nearest sites show; `nearest` has them then, ascending.
  [[nodiscard]] Found look_at(std::uint32_t point, std::array<Neighbour, Around::MOST>& nearest) const {
    const std::size_t count = search_.find(cloud_.coord[point], nearest);
    return look_at(point, std::span(nearest).first(count));
  }
  [[nodiscard]] Found look_at(std::uint32_t point, std::span<const Neighbour> nearest) const {
    Found found{.point = point};
    if (nearest.size() < Around::MOST) return found;
    Around around;
    around.count = nearest.size();
    found.spacing = std::sqrt(double(nearest[SPACING_RANK].distance_squared()));
    const glm::dvec3 place(cloud_.coord[point]), normal(cloud_.normal[point]);
    const bool given = estimated_[point] == 0;
    for (std::size_t j = 0; j < around.count; ++j) {
      const std::uint32_t other = nearest[j].index();
      const glm::dvec3& offset = around.offset[j] = (glm::dvec3(cloud_.coord[other]) - place) / found.spacing;
      found.crease = found.crease || bends(point, normal, other, offset);
    }
    // Normals that were interpolated bend where the surface does not.
    if (given && found.crease && is_flat(around)) found.crease = false;
    if (!found.crease) found.sides = border_at(around, found.spacing, place, normal);
    if (found.crease) found.sides = find_sides(around, crease_);
    if (given && found.crease && found.sides.empty()) {  // a bent surface may end, too
      around.count = nearest.size();
      found.sides = border_at(around, found.spacing, place, normal);
      found.crease = found.sides.empty();
    }
    found.reach = around.reach();
    if (given) keep_given(found.sides, normal);
    return found;
  }

  void add_sides(const Found& found, std::vector<SharpSide>& sides) const {
    const glm::dvec3 normal(cloud_.normal[found.point]);
    std::uint32_t number = 0;
    for (const Side& side : found.sides) {
      const glm::dvec3 facing = glm::dot(side.normal, normal) < 0.0 ? -side.normal : side.normal;
      SharpSide& sharp =
          sides.emplace_back(SharpSide{found.point, number++, found.crease, glm::vec3(facing), {}});
      sharp.clip.reach = static_cast<float>(found.reach * found.spacing);
      for (std::size_t i = 0; i < side.count; ++i) {
        sharp.clip.dir[i] = glm::vec3(side.lines[i].out);
        sharp.clip.distance[i] = static_cast<float>(side.lines[i].distance * found.spacing);
      }
    }
  }

  /// The side that a given normal belongs to, with that normal where it is the plane's. A normal between two planes was
  /// interpolated across their crease and says nothing of it.
  static void keep_given(std::vector<Side>& sides, const glm::dvec3& normal) {
    const auto cosine = [&](const Side& side) { return std::abs(glm::dot(side.normal, normal)); };
    const auto found = std::max_element(sides.begin(), sides.end(),
                                        [&](const Side& a, const Side& b) { return cosine(a) < cosine(b); });
    if (found == sides.end() || cosine(*found) < GIVEN_COSINE) return;
    Side side = *found;
    sides = {side};
    if (cosine(side) < SAME_COSINE) return;
    for (std::size_t i = 0; i < side.count; ++i) {
      glm::dvec3& out = side.lines[i].out;
      out = glm::normalize(out - normal * glm::dot(out, normal));
    }
    side.normal = normal;
    sides = {side};
  }

  [[nodiscard]] std::vector<Side> border_at(const Around& around, double spacing, const glm::dvec3& place,
                                            const glm::dvec3& normal) const {
    const TangentFrame frame(normal);
    const auto gap = widest_gap(around, frame);
    if (!gap || gap->width < STRAIGHT_GAP) return {};
    const auto direction = [&](double angle) {
      return std::cos(angle) * frame.u + std::sin(angle) * frame.v;
    };
    if (!empty_towards(around.reach() * spacing, place, direction(gap->middle))) return {};
    Side side{normal, {}, 0};
    const bool corner = gap->width > CORNER_GAP;
    const double quarter = 0.5 * std::numbers::pi;
    if (corner) {
      side.lines[side.count++].out = direction(gap->begin + quarter);
      side.lines[side.count++].out = direction(gap->end - quarter);
    } else {
      side.lines[side.count++].out = direction(gap->middle);
    }
    for (std::size_t i = 0; i < side.count; ++i) {
      Line& line = side.lines[i];
      line.distance = 0.0;
      for (std::size_t j = 0; j < around.count; ++j)
        line.distance = std::max(line.distance, glm::dot(around.offset[j], line.out));
    }
    return {side};
  }

  /// Whether no site is in a large ball behind the border.
  [[nodiscard]] bool empty_towards(double around, const glm::dvec3& place, const glm::dvec3& out) const {
    const double reach = EMPTY_REACH * around;
    std::array<Neighbour, 1> nearest;
    if (search_.find(glm::vec3(place + reach * out), nearest) == 0) return true;
    return std::sqrt(double(nearest[0].distance_squared())) > 0.9 * reach;
  }

  const Cloud& cloud_;
  std::span<const std::uint8_t> estimated_;
  const double crease_, cos_smooth_, sin_smooth_;
  const NearPlaces& near_;
  const NeighbourSearch& search_;
};

}  // namespace

SharpSides find_sharp(const Cloud& cloud, const NearPlaces& near, double crease_degrees,
                      std::span<const std::uint8_t> estimated, const Stage& stage) {
  const SharpSearch sharp(cloud, near, crease_degrees, estimated);
  return sharp.promises() ? sharp.run(stage) : SharpSides{};
}

void take_normals(Cloud& cloud, std::span<const SharpSide> sides) {
  for (const SharpSide& side : sides)
    if (side.number == 0) cloud.normal[side.point] = side.normal;
}

void take_sides(Cloud& cloud, std::span<const SharpSide> sides) {
  if (sides.empty()) return;
  std::vector<std::uint32_t> copied;
  for (const SharpSide& side : sides)
    if (side.number > 0) copied.push_back(side.point);
  std::size_t next = cloud.size();
  add_copies(cloud, copied);
  cloud.clip.resize(cloud.size());
  for (const SharpSide& side : sides) {
    const std::size_t point = side.number > 0 ? next++ : side.point;
    cloud.normal[point] = side.normal;
    cloud.clip[point] = side.clip;
  }
  put_in_order(cloud);
}

}  // namespace splatray
