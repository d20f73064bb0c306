#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/base/release.h"
#include "preprocess/scan/components.h"
#include "preprocess/scan/occupancy.h"
#include "preprocess/scan/sides.h"
#include "preprocess/surface/normals.h"

namespace splatray {
namespace {

/// Most that neighbours on one part may differ, in the rounds that join them: Kruskal's order, in steps.
constexpr std::array<float, 5> LIMITS{0.01F, 0.03F, 0.07F, 0.12F, 0.2F};
constexpr float NEAR_REACH =
    2.0F;  // of neighbours that are near, in units of both their distances to the 8th
constexpr std::size_t MOST_VOTERS = 1U << 17;
constexpr double RAY_START = 2.2;    // of a ray above its point, in cells: beyond the surface's own
constexpr double ROOM_SHARE = 0.15;  // of the points in planes that all others are on one side of: a room
constexpr float ONE_PLANE_COSINE = 0.99F;  // cosine of normals of one such plane
constexpr std::uint64_t LEAST_VOTES = 8;
constexpr double GROUND_RISE = 0.7;  // cosine of 45 degrees: more level than upright

/// How much two neighbours look like no one surface, 0..1: by the angle of their normals, and of the step between them to
/// both planes.
float difference(const Cloud& cloud, std::uint32_t i, std::uint32_t j) {
  const glm::vec3 step = cloud.coord[j] - cloud.coord[i];
  const float length = glm::length(step);
  const float lift =
      std::max(std::abs(glm::dot(cloud.normal[i], step)), std::abs(glm::dot(cloud.normal[j], step)));
  const float turn = 1.0F - std::abs(glm::dot(cloud.normal[i], cloud.normal[j]));
  return std::max(turn, length > 0.0F ? 0.3F * lift * lift / (length * length) : 0.0F);
}

bool are_near(const Cloud& cloud, const Survey& survey, std::uint32_t i, std::uint32_t j) {
  if (!cloud.on_surface(i) || !cloud.on_surface(j)) return false;
  const glm::vec3 step = cloud.coord[j] - cloud.coord[i];
  const float reach = NEAR_REACH * std::min(survey.reach[i], survey.reach[j]);
  return glm::dot(step, step) <= reach * reach;
}

/// Parts of the surface, and on which of its part's two sides each normal is.
struct Parts {
  std::vector<std::uint32_t> part;   ///< of each point: its least member
  std::vector<std::uint8_t> turned;  ///< against the part's least member
};

/// Disjoint sets whose members know their side against the set's least one.
class SignedSets {
 public:
  explicit SignedSets(std::size_t count) : parent_(count), turned_(count, 0) {
    for (std::uint32_t i = 0; i < count; ++i) parent_[i] = i;
  }

  struct Root {
    std::uint32_t root;
    std::uint8_t turned;
  };
  [[nodiscard]] Root find(std::uint32_t i) {
    std::uint8_t turned = 0;
    while (parent_[i] != i) {  // paths are halved; the turns of both links add, a root has none
      const std::uint32_t up = parent_[i];
      turned_[i] = static_cast<std::uint8_t>(turned_[i] ^ turned_[up]);
      parent_[i] = parent_[up];
      turned = static_cast<std::uint8_t>(turned ^ turned_[i]);
      i = parent_[i];
    }
    return {i, turned};
  }
  void join(std::uint32_t i, std::uint32_t j, bool opposite) {
    Root a = find(i), b = find(j);
    if (a.root == b.root) return;
    if (a.root > b.root) std::swap(a, b);
    parent_[b.root] = a.root;
    turned_[b.root] = static_cast<std::uint8_t>(a.turned ^ b.turned ^ (opposite ? 1 : 0));
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<std::uint8_t> turned_;  ///< against the parent
};

/// In which round each of a point's listed neighbours may join it; LIMITS.size() = in none.
std::vector<std::uint8_t> find_rounds(const Cloud& cloud, const Survey& survey) {
  std::vector<std::uint8_t> rounds(cloud.size() * Survey::LISTED);
  tbb::parallel_for(std::size_t{0}, cloud.size(), [&](std::size_t n) {
    const auto i = static_cast<std::uint32_t>(n);
    const auto listed = survey.around(i);
    for (std::size_t k = 0; k < Survey::LISTED; ++k) {
      const std::uint32_t j = listed[k];
      const bool linked = j != i && are_near(cloud, survey, i, j);
      const auto limit =
          linked ? std::lower_bound(LIMITS.begin(), LIMITS.end(), difference(cloud, i, j)) : LIMITS.end();
      rounds[n * Survey::LISTED + k] = static_cast<std::uint8_t>(limit - LIMITS.begin());
    }
  });
  return rounds;
}

Parts find_turned_parts(const Cloud& cloud, const Survey& survey) {
  SignedSets sets(cloud.size());
  std::vector<std::uint8_t> rounds = find_rounds(cloud, survey);
  for (std::size_t round = 0; round < LIMITS.size(); ++round) {
    for (std::size_t link = 0; link < rounds.size(); ++link) {
      if (rounds[link] != round) continue;
      const auto i = static_cast<std::uint32_t>(link / Survey::LISTED);
      const std::uint32_t j = survey.around(i, link % Survey::LISTED);
      sets.join(i, j, glm::dot(cloud.normal[i], cloud.normal[j]) < 0.0F);
    }
  }
  release(rounds);
  Parts parts;
  parts.part.resize(cloud.size());
  parts.turned.resize(cloud.size());
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    const auto [root, turned] = sets.find(i);
    parts.part[i] = root;
    parts.turned[i] = turned;
  }
  return parts;
}

/// A direction about +z, the same for the same number, cosine-weighted: a Halton sequence's members (bases 2 and 3).
glm::dvec3 direction(std::uint32_t number) {
  const auto inverse = [](std::uint32_t n, std::uint32_t base) {
    double value = 0.0, digit = 1.0 / base;
    for (; n > 0; n /= base, digit /= base) value += digit * (n % base);
    return value;
  };
  const double along = inverse(number, 2), angle = 2.0 * std::numbers::pi * inverse(number, 3);
  const double ring = std::sqrt(along);
  return {ring * std::cos(angle), ring * std::sin(angle), std::sqrt(1.0 - along)};
}

/// Votes of a part for its least member's side as it is, and for the opposite.
struct Votes {
  std::uint32_t same = 0, opposite = 0;

  [[nodiscard]] bool sure() const {
    return same + opposite >= LEAST_VOTES && std::max(same, opposite) >= 2 * std::min(same, opposite);
  }
};

/// Rays from a point's surface, to either side of it.
class PointRays {
 public:
  PointRays(const Cloud& cloud, std::size_t point)
      : place_(cloud.coord[point]), normal_(cloud.normal[point]) {
    const glm::dvec3 side = std::abs(normal_.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    u_ = glm::normalize(glm::cross(normal_, side)), v_ = glm::cross(normal_, u_);
  }

  /// Occupancy::free_path of the `number`-th direction on the side of the normal (`sign` 1) or behind (-1).
  [[nodiscard]] std::optional<double> cast(const Occupancy& space, std::uint32_t number, double sign) const {
    const glm::dvec3 local = direction(number);
    return space.free_path(place_ + sign * RAY_START * space.edge() * normal_,
                           local.x * u_ + local.y * v_ + sign * local.z * normal_);
  }

 private:
  glm::dvec3 place_, normal_, u_, v_;
};

/// Finds layers so close to a point's that PointRays begins beyond them: the other face of a thin wall.
class CloseLayers {
 public:
  CloseLayers(const Cloud& cloud, double edge)
      : cloud_(cloud), fine_(cloud, FINE_EDGE * edge, FINE_ALONG), reach_(RAY_START * edge) {}

  /// Whether one lies on that side of a point.
  [[nodiscard]] bool has(std::size_t point, double sign) const {
    const glm::dvec3 dir = sign * glm::dvec3(cloud_.normal[point]);
    const double start = BEYOND_OWN * fine_.edge();
    if (!(start < reach_)) return false;
    const auto free = fine_.free_path(glm::dvec3(cloud_.coord[point]) + start * dir, dir);
    return free && *free < reach_ - start;
  }

 private:
  static constexpr double FINE_EDGE = 0.4;  // of the coarse cells' edge: the distance to the 8th place
  static constexpr double FINE_ALONG = 512.0;
  static constexpr double BEYOND_OWN = 1.8;  // edges: more than a cell's diagonal

  const Cloud& cloud_;
  const Occupancy fine_;
  const double reach_;
};

/// The room that rays find on either side of a point, summed, and whether one of them leaves the cloud.
struct SideRoom {
  double room = 0.0;
  bool sees_out = false;
};

SideRoom room_beside(const PointRays& rays, const Occupancy& space, std::uint32_t first, double sign,
                     double beyond) {
  constexpr double MOST = 4.0;  // more than any way through the cloud
  SideRoom side;
  for (std::uint32_t ray = first; ray < first + 4; ++ray) {
    const std::optional<double> path = rays.cast(space, ray, sign);
    side.room += std::min(path.value_or(beyond), MOST);
    side.sees_out = side.sees_out || !path;
  }
  return side;
}

/// For each point the room in front of its normal against that behind: 1, -1, or 0 where both are the same or it has no vote. In what is
/// lower than wide and no room, such as a town with its walls, level surfaces that see out both above and below face up.
std::vector<std::int8_t> cast_votes(const Cloud& cloud, const Survey& survey, const glm::dvec3& up,
                                    const Stage& stage) {
  const Occupancy space(cloud, cell_edge(survey));
  const CloseLayers layers(cloud, space.edge());
  const bool in_room = is_room(cloud, survey, up);
  const double beyond = in_room ? 0.0 : 4.0;  // more than any way through the cloud
  const std::optional<glm::dvec3> sky = in_room ? std::nullopt : sheet_axis(cloud, up);
  const std::size_t stride = cloud.size() / MOST_VOTERS + 1;
  std::vector<std::int8_t> votes(cloud.size());
  parallel_each(stage, cloud.size() / stride, [&](std::size_t n) {
    const std::size_t i = n * stride;
    if (!cloud.on_surface(i)) return;
    const PointRays rays(cloud, i);
    const auto first = static_cast<std::uint32_t>(n % 1024) * 4 + 1;
    SideRoom front = room_beside(rays, space, first, 1.0, beyond),
             behind = room_beside(rays, space, first, -1.0, beyond);
    // Behind the other face of a thin wall there is room too, which is none of this one's. Two bodies that nearly touch see no way out
    // on their other sides.
    if ((in_room || behind.sees_out) && layers.has(i, 1.0)) front.room = 0.0;
    if ((in_room || front.sees_out) && layers.has(i, -1.0)) behind.room = 0.0;
    // Ground among walls and trees finds more room below, where nothing was to be scanned, than above.
    const double rise = sky ? glm::dot(glm::dvec3(cloud.normal[i]), *sky) : 0.0;
    const bool open = std::abs(rise) > GROUND_RISE && front.sees_out && behind.sees_out;
    const double room = open ? rise : front.room - behind.room;
    votes[i] = static_cast<std::int8_t>(room > 0.0 ? 1 : room < 0.0 ? -1 : 0);
  });
  return votes;
}

/// Parts that are not sure do as their neighbours in parts that are: by the sum of cosines over all steps from one to the
/// other. The ring of what is sure grows by one part a round.
void ask_neighbours(const Cloud& cloud, const Survey& survey, const Parts& parts,
                    std::vector<std::int8_t>& side) {
  constexpr int ROUNDS = 8;
  constexpr float LEAST = 1.0F;
  for (int round = 0; round < ROUNDS; ++round) {
    std::vector<float> sum(cloud.size(), 0.0F);
    for (std::uint32_t i = 0; i < cloud.size(); ++i) {
      if (side[parts.part[i]] != 0) continue;
      for (const std::uint32_t j : survey.around(i)) {
        const std::int8_t known = side[parts.part[j]];
        if (known == 0 || !are_near(cloud, survey, i, j)) continue;
        const bool turned = (parts.turned[i] ^ parts.turned[j]) != 0;
        sum[parts.part[i]] +=
            static_cast<float>(known) * (turned ? -1.0F : 1.0F) * glm::dot(cloud.normal[i], cloud.normal[j]);
      }
    }
    bool grown = false;
    for (std::uint32_t i = 0; i < cloud.size(); ++i) {
      if (parts.part[i] != i || side[i] != 0 || std::abs(sum[i]) < LEAST) continue;
      side[i] = sum[i] > 0.0F ? 1 : -1;
      grown = true;
    }
    if (!grown) return;
  }
}

/// The share of an even choice of points on surfaces whose normals are within 10 degrees of an axis or across it: of a round thing a fifth.
double built_share(const Cloud& cloud, const glm::dvec3& axis) {
  constexpr std::size_t ASKED = 2048;
  constexpr double ALONG = 0.985, ACROSS = 0.17;
  const std::size_t asked = std::min(ASKED, cloud.size());
  std::size_t built = 0;
  for (std::size_t n = 0; n < asked; ++n) {
    const std::size_t i = n * cloud.size() / asked;
    const double along = std::abs(glm::dot(glm::dvec3(cloud.normal[i]), axis));
    built += cloud.on_surface(i) && (along > ALONG || along < ACROSS) ? 1 : 0;
  }
  return static_cast<double>(built) / static_cast<double>(asked);
}

/// Whether much of the cloud lies in planes that all but few points are on one side of, there is a floor among these, and the rest is built
/// as they are: a bust whose base and crown are flat is round between them. In what is lower than wide there are others beside the floor,
/// which the flat ground of a town is not.
bool is_bounded(const Cloud& cloud, const Survey& survey, const glm::dvec3& up) {
  constexpr std::size_t PLANES = 512, POINTS = 2000;
  constexpr double FLOOR_SHARE =
      0.03;  // of the planes' squared normals, of those that look up: noise leaves 0.01
  constexpr double BESIDE_SHARE = 0.2;  // of walls and ceilings, of what is lower than wide
  constexpr double AS_PLANES = 0.5,
                   UPRIGHT = 0.3;  // rooms have 0.65 and more, a cave 0.39; a bust 0.38, 0.26
  const std::size_t planes = std::min(PLANES, cloud.size()), points = std::min(POINTS, cloud.size());
  std::vector<std::int8_t> inwards(
      planes);  // of planes that bound: the sign that turns their normals to the others
  tbb::parallel_for(std::size_t{0}, planes, [&](std::size_t p) {
    const std::size_t i = p * cloud.size() / planes;
    const double near = 2.0 * survey.reach[i] + 0.002;
    std::size_t above = 0, below = 0, within = 0;
    for (std::size_t q = 0; q < points; ++q) {
      const std::size_t j = q * cloud.size() / points;
      const double height =
          glm::dot(glm::dvec3(cloud.normal[i]), glm::dvec3(cloud.coord[j] - cloud.coord[i]));
      above += height > near ? 1 : 0;
      below += height < -near ? 1 : 0;
      const bool alike = std::abs(glm::dot(cloud.normal[i], cloud.normal[j])) > ONE_PLANE_COSINE;
      within += alike && std::abs(height) <= near ? 1 : 0;
    }
    const bool bounds = std::min(above, below) < points / 50 && within > points / 25;
    inwards[p] = static_cast<std::int8_t>(!bounds ? 0 : above > below ? 1 : -1);
  });
  const auto count = static_cast<double>(planes) -
                     static_cast<double>(std::count(inwards.begin(), inwards.end(), std::int8_t{0}));
  if (!(count > ROOM_SHARE * static_cast<double>(planes))) return false;
  double floor = 0.0, built = 0.0, beside = 0.0;
  for (std::size_t p = 0; p < planes; ++p) {
    if (inwards[p] == 0) continue;
    const glm::dvec3 normal(cloud.normal[p * cloud.size() / planes]);
    const double along = inwards[p] * glm::dot(normal, up);
    floor += along > 0.0 ? along * along : 0.0;
    beside += along < GROUND_RISE ? 1.0 : 0.0;
    built += built_share(cloud, normal);
  }
  const bool walled = beside > BESIDE_SHARE * count || !sheet_axis(cloud, up);
  return floor > FLOOR_SHARE * count && walled &&
         (built > AS_PLANES * count || built_share(cloud, up) > UPRIGHT);
}

/// The share of the free cells that are enclosed: is_room has the rule.
double enclosed_share(const Occupancy& space, const glm::dvec3& up) {
  constexpr std::size_t PLACES = 2048;
  constexpr std::uint32_t RAYS = 96;
  constexpr double LEVEL = 0.5, OVER = 0.7, BELOW = -0.5;  // heights of directions, which overlap a little
  constexpr double LEVEL_MET = 0.85, UPRIGHT_MET = 0.8;
  const glm::dvec3 side = std::abs(up.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(up, side)), v = glm::cross(up, u);
  const std::vector<glm::dvec3> places = space.free_places(PLACES);
  std::vector<std::uint8_t> enclosed(places.size());
  tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t n) {
    std::array<double, 3> cast{}, met{};
    for (std::uint32_t ray = 0; ray < RAYS; ++ray) {
      const double height = 1.0 - (2.0 * ray + 1.0) / RAYS, ring = std::sqrt(1.0 - height * height);
      const double turn =
          std::numbers::pi * (1.0 + std::sqrt(5.0)) * (ray + 0.5);  // a spiral by the golden angle
      const glm::dvec3 dir = ring * (std::cos(turn) * u + std::sin(turn) * v) + height * up;
      const double meets = space.free_path(places[n], dir) ? 1.0 : 0.0;
      const std::array<bool, 3> part{std::abs(height) < LEVEL, height > OVER, height < BELOW};
      for (std::size_t k = 0; k < part.size(); ++k)
        if (part[k]) cast[k] += 1.0, met[k] += meets;
    }
    enclosed[n] =
        met[0] > LEVEL_MET * cast[0] && met[1] > UPRIGHT_MET * cast[1] && met[2] > UPRIGHT_MET * cast[2];
  });
  return static_cast<double>(std::count(enclosed.begin(), enclosed.end(), 1)) /
         std::max(1.0, static_cast<double>(places.size()));
}

/// Whether some surfaces see out on neither side.
bool is_furnished(const Cloud& cloud, const Occupancy& space) {
  constexpr std::size_t ASKED = 2048;
  constexpr std::uint32_t RAYS = 12, SEES_OUT = 4;  // to one side
  constexpr double DEEP = 0.015;
  const std::size_t asked = std::min(ASKED, cloud.size());
  std::vector<std::uint8_t> deep(asked);
  tbb::parallel_for(std::size_t{0}, asked, [&](std::size_t n) {
    const std::size_t i = n * cloud.size() / asked;
    if (!cloud.on_surface(i)) return;
    const PointRays rays(cloud, i);
    deep[n] = 1;
    for (const double sign : {1.0, -1.0}) {
      std::uint32_t out = 0;
      for (std::uint32_t ray = 1; ray <= RAYS; ++ray) out += rays.cast(space, ray, sign) ? 0 : 1;
      if (out >= SEES_OUT) deep[n] = 0;
    }
  });
  return static_cast<double>(std::count(deep.begin(), deep.end(), 1)) > DEEP * static_cast<double>(asked);
}

}  // namespace

bool is_room(const Cloud& cloud, const Survey& survey, const glm::dvec3& up) {
  constexpr double BUILT = 0.5, ENCLOSED = 0.3;  // a ball in its box has half of it, on a plinth an eighth
  if (is_bounded(cloud, survey, up)) return true;
  const Occupancy space(cloud, cell_edge(survey));
  return built_share(cloud, up) > BUILT && enclosed_share(space, up) > ENCLOSED && is_furnished(cloud, space);
}

std::uint64_t turn_by_votes(Cloud& cloud, const Survey& survey, const glm::dvec3& up, const Stage& stage) {
  const Parts parts = find_turned_parts(cloud, survey);
  const std::vector<std::int8_t> cast = cast_votes(cloud, survey, up, stage);
  std::vector<Votes> votes(cloud.size());  // of parts, at their least members
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    if (cast[i] == 0) continue;
    Votes& of_part = votes[parts.part[i]];
    ++((cast[i] > 0) == (parts.turned[i] == 0) ? of_part.same : of_part.opposite);
  }
  std::vector<std::int8_t> side(cloud.size(), 0);
  for (std::uint32_t i = 0; i < cloud.size(); ++i)
    if (parts.part[i] == i && votes[i].sure()) side[i] = votes[i].same > votes[i].opposite ? 1 : -1;
  ask_neighbours(cloud, survey, parts, side);
  std::uint64_t unsure = 0;
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    if (!cloud.on_surface(i)) continue;
    const std::uint32_t part = parts.part[i];
    unsure += side[part] == 0 ? 1 : 0;
    const std::int8_t its = side[part] != 0 ? side[part] : votes[part].same >= votes[part].opposite ? 1 : -1;
    if ((its > 0) == (parts.turned[i] != 0)) cloud.normal[i] = -cloud.normal[i];
  }
  return unsure;
}

}  // namespace splatray
