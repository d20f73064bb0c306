#include "preprocess/scan/smooth/smooth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "engine/base/release.h"
#include "engine/base/vector_clones.h"
#include "preprocess/base/lanes.h"
#include "preprocess/base/select.h"
#include "preprocess/scan/smooth/layers.h"
#include "preprocess/scan/smooth/reproject.h"
#include "preprocess/scan/smooth/surroundings.h"
#include "preprocess/surface/neighbours.h"

namespace splatray {
namespace {

constexpr std::size_t MOST_PLACES = Surroundings::MOST;
constexpr float ENOUGH = Surroundings::ENOUGH;
constexpr std::size_t LEAST_AROUND = 6;  // of them, that have any weight
constexpr int REWEIGHTINGS = 2;
// Deviation of the places around a point from their plane, over the noise's, up to which they are flat (MOVES_WHERE_FLAT). A plane's own
// is one; three leave room for noise that is larger there, and relief between points that are far apart is mostly higher.
constexpr float FLAT_NOISES = 3.0F;
constexpr float WIDE = 4.0F;  // of the heights' standard deviation: what is farther off has little weight

/// The point that is moved and its neighbours, component by component; without weight up to whole vectors.
struct PlacesAround {
  static constexpr std::size_t ROOM = (MOST_PLACES + 1 + LANES - 1) / LANES * LANES;

  std::size_t count = 0;                                 ///< a multiple of LANES
  float x[ROOM], y[ROOM], z[ROOM];                       ///< places relative to the point
  float normal_x[ROOM], normal_y[ROOM], normal_z[ROOM];  ///< on the side of the point's own
  float weight[ROOM];
};

/// A plane by weighted means.
struct MeanPlane {
  glm::vec3 mean{0.0F}, normal{0.0F};
  float deviation = 0.0F;  ///< of the heights over it
};

/// Heights of LANES places over a plane.
[[gnu::always_inline]] inline void heights_over(const MeanPlane& plane, const PlacesAround& around,
                                                std::size_t j, Lanes& heights) {
  Lanes x, y, z;
  load_lanes(around.x + j, x), load_lanes(around.y + j, y), load_lanes(around.z + j, z);
  heights = (x - plane.mean.x) * plane.normal.x + (y - plane.mean.y) * plane.normal.y +
            (z - plane.mean.z) * plane.normal.z;
}

/// Sums, and from them means, of vectors.
struct VectorSum {
  Lanes x{}, y{}, z{};

  [[gnu::always_inline]] void add(const Lanes& weight, const float* at_x, const float* at_y,
                                  const float* at_z) {
    Lanes here;
    load_lanes(at_x, here), x += weight * here;
    load_lanes(at_y, here), y += weight * here;
    load_lanes(at_z, here), z += weight * here;
  }
  [[nodiscard, gnu::always_inline]] glm::vec3 over(float weight) const {
    return glm::vec3(sum_lanes(x), sum_lanes(y), sum_lanes(z)) / weight;
  }
};

[[gnu::always_inline]] inline MeanPlane fit_plane(const PlacesAround& around, const float* weights) {
  VectorSum mean, normal;
  Lanes sum{}, squares{}, weight, heights;
  for (std::size_t j = 0; j < around.count; j += LANES) {
    load_lanes(weights + j, weight);
    mean.add(weight, around.x + j, around.y + j, around.z + j);
    normal.add(weight, around.normal_x + j, around.normal_y + j, around.normal_z + j);
    sum += weight;
  }
  const float all = sum_lanes(sum);
  MeanPlane plane{mean.over(all), glm::normalize(normal.over(all)), 0.0F};
  for (std::size_t j = 0; j < around.count; j += LANES) {
    load_lanes(weights + j, weight);
    heights_over(plane, around, j, heights);
    squares += weight * heights * heights;
  }
  plane.deviation = std::sqrt(sum_lanes(squares) / all);
  return plane;
}

SPLATRAY_VECTOR_CLONES MeanPlane fit_robust_plane(const PlacesAround& around) {
  MeanPlane plane = fit_plane(around, around.weight);
  float weights[PlacesAround::ROOM];
  for (int round = 0; round < REWEIGHTINGS && plane.deviation > 0.0F; ++round) {
    const float unit = 1.0F / (WIDE * plane.deviation);
    for (std::size_t j = 0; j < around.count; j += LANES) {
      Lanes heights, weight;
      heights_over(plane, around, j, heights);
      load_lanes(around.weight + j, weight);
      const Lanes off = 1.0F + (heights * unit) * (heights * unit);
      store_lanes(weight / (off * off), weights + j);
    }
    plane = fit_plane(around, weights);
  }
  return plane;
}

/// Weights by distance and by the cosine to the point's own normal, to whose side normals are turned where sides are not
/// known. Returns how many places have any weight. `distance_squared` is of the places.
SPLATRAY_VECTOR_CLONES std::size_t weigh(PlacesAround& around, const float* distance_squared,
                                         float widest_squared, const glm::vec3& own, bool sided) {
  LaneInts used{};
  const float by = 1.0F / widest_squared;
  for (std::size_t j = 0; j < around.count; j += LANES) {
    Lanes x, y, z, squared;
    load_lanes(around.normal_x + j, x), load_lanes(around.normal_y + j, y),
        load_lanes(around.normal_z + j, z);
    load_lanes(distance_squared + j, squared);
    Lanes cosine = x * own.x + y * own.y + z * own.z;
    if (!sided) {
      const Lanes side = cosine < 0.0F ? Lanes{} - 1.0F : Lanes{} + 1.0F;
      x *= side, y *= side, z *= side, cosine *= side;
      store_lanes(x, around.normal_x + j), store_lanes(y, around.normal_y + j),
          store_lanes(z, around.normal_z + j);
    }
    const Lanes share = 1.0F - squared * by;
    const LaneInts has = (cosine > 0.0F) & (share > 0.0F);
    const Lanes weight = has ? share * share * cosine : Lanes{};
    used -= has;
    store_lanes(weight, around.weight + j);
  }
  std::size_t count = 0;
  for (std::size_t k = 0; k < LANES; ++k) count += static_cast<std::size_t>(used[k]);
  return count;
}

/// Where points go: along their new normals.
struct Moved {
  std::vector<float> lift;  ///< cloud coordinates
  std::vector<glm::vec3> normal;
  std::vector<std::uint8_t> moves;      ///< SmoothParams::moves, 0 where the point stays after all
  std::vector<std::uint8_t> supported;  ///< has enough neighbours, or stays without
};

/// Moves points by their neighbours.
class SmoothProjection {
 public:
  SmoothProjection(const Cloud& cloud, const Survey& survey, const SmoothParams& params)
      : cloud_(cloud),
        survey_(survey),
        params_(params),
        surroundings_(survey),
        radius_(static_cast<float>(params.radius)) {}

  [[nodiscard]] NeighbourSearch::Query query(std::uint32_t i) const {
    if (radius_ > 0.0F) return {cloud_.coord[i], radius_ * radius_, radius_ * radius_};
    return surroundings_.query(cloud_, i);
  }

  /// Every how many points are looked at around a point: a power of 4, so that a radius that was asked for holds no more than
  /// ENOUGH of them.
  [[nodiscard]] std::size_t stride_of(std::size_t i) const {
    std::size_t stride = 1;
    if (radius_ > 0.0F) {
      const float count = survey_.expected_count(i, radius_ * radius_);
      while (count > ENOUGH * static_cast<float>(stride) && stride * MOST_PLACES < cloud_.size()) stride *= 4;
    }
    return stride;
  }

  /// Moves the points of these numbers by every `stride`-th point around them.
  void move(const std::vector<std::uint32_t>& movers, std::size_t stride, Moved& moved,
            const Stage& stage) const {
    if (movers.empty()) return;
    Cloud thin;
    std::vector<std::uint32_t> source;
    if (stride > 1) {
      source = numbers_where(cloud_.size(),
                             [&](std::size_t i) { return i % stride == 0 && cloud_.on_surface(i); });
      thin.coord = splatray::gather(cloud_.coord, source);
      thin.normal = splatray::gather(cloud_.normal, source);
    }
    const NeighbourSearch search(stride > 1 ? thin : cloud_, Sites::oriented_surface);
    search.find_each(
        movers.size(), [&](std::uint32_t n) { return query(movers[n]); }, MOST_PLACES, stage,
        [&](std::uint32_t n, std::span<Neighbour> nearest) {
          if (stride > 1)
            for (Neighbour& neighbour : nearest)
              neighbour = {neighbour.distance_squared(), source[neighbour.index()]};
          move(movers[n], nearest, moved);
        });
  }

 private:
  void move(std::uint32_t i, std::span<const Neighbour> nearest, Moved& moved) const {
    PlacesAround around;
    float distance_squared[PlacesAround::ROOM];
    const float widest = nearest.size() == MOST_PLACES ? farthest(nearest) : query(i).limit_squared;
    gather(i, nearest, around, distance_squared);
    const std::size_t used = weigh(around, distance_squared, widest, cloud_.normal[i], params_.sided);
    const bool stays_unless_flat = params_.moves[i] == MOVES_WHERE_FLAT;
    if (used <= LEAST_AROUND) {
      moved.supported[i] = stays_unless_flat ? 1 : 0;
      moved.moves[i] = 0;
      return;
    }
    const MeanPlane plane = fit_robust_plane(around);
    if (stays_unless_flat && plane.deviation > FLAT_NOISES * static_cast<float>(params_.noise_length)) {
      moved.moves[i] = 0;
      return;
    }
    moved.lift[i] = glm::dot(plane.normal, plane.mean);
    moved.normal[i] = plane.normal;
  }

  static float farthest(std::span<const Neighbour> nearest) {
    float squared = 0.0F;
    for (const Neighbour& neighbour : nearest) squared = std::max(squared, neighbour.distance_squared());
    return squared;
  }

  /// The point itself and its neighbours.
  void gather(std::uint32_t i, std::span<const Neighbour> nearest, PlacesAround& around,
              float* distance_squared) const {
    const auto add = [&](const glm::vec3& offset, const glm::vec3& normal, float squared) {
      const std::size_t j = around.count++;
      around.x[j] = offset.x, around.y[j] = offset.y, around.z[j] = offset.z;
      around.normal_x[j] = normal.x, around.normal_y[j] = normal.y, around.normal_z[j] = normal.z;
      distance_squared[j] = squared;
    };
    add(glm::vec3(0.0F), cloud_.normal[i], 0.0F);
    for (const Neighbour& neighbour : nearest) {
      const std::uint32_t other = neighbour.index();
      const glm::vec3 offset = cloud_.coord[other] - cloud_.coord[i];
      if (is_same_sheet(params_.sheet_end, i, glm::dot(offset, cloud_.normal[i])))
        add(offset, cloud_.normal[other], neighbour.distance_squared());
    }
    while (around.count % LANES != 0) add(glm::vec3(0.0F), glm::vec3(0.0F), 0.0F);
  }

  const Cloud& cloud_;
  const Survey& survey_;
  const SmoothParams& params_;
  Surroundings surroundings_;
  float radius_;
};

/// Whether sizes of moves have their quartiles close together. Of normal noise the lower one is 0.28 of the upper one, of even noise
/// 1/3, of two layers with little noise 1.
bool lie_in_layers(std::vector<float>& sizes) {
  constexpr float CLOSE = 0.6F;
  const auto quartile = [&sizes](std::size_t quarters) {
    const auto at = sizes.begin() + static_cast<std::ptrdiff_t>(quarters * (sizes.size() - 1) / 4);
    std::nth_element(sizes.begin(), at, sizes.end());
    return *at;
  };
  return quartile(1) > CLOSE * quartile(3);
}

}  // namespace

Smoothed smooth_points(Cloud& cloud, Survey survey, const SmoothParams& params, const Stage& stage) {
  if (cloud.size() == 0) return {};
  const std::size_t size = cloud.size();
  const SmoothProjection projection(cloud, survey, params);
  Moved moved{std::vector<float>(size), cloud.normal, params.moves, std::vector<std::uint8_t>(size, 1)};
  for (std::size_t stride = 1; stride == 1 || (params.radius > 0.0 && stride < 4 * size); stride *= 4) {
    const auto movers = numbers_where(
        size, [&](std::size_t i) { return params.moves[i] != 0 && projection.stride_of(i) == stride; });
    projection.move(movers, stride, moved, stage);
  }
  std::vector<std::uint32_t> supported =
      numbers_where(size, [&](std::size_t i) { return moved.supported[i] != 0; });
  if (supported.empty()) return {};  // nothing supports anything: the radius is too small for these points
  cloud.normal = std::move(moved.normal);
  keep_points(cloud, supported);
  const std::vector<std::uint8_t> moves = gather(moved.moves, supported);
  std::vector<float> lift = gather(moved.lift, supported);
  std::vector<float> sheet_end = gather(params.sheet_end, supported);
  for (std::size_t i = 0; i < sheet_end.size(); ++i) sheet_end[i] -= lift[i];
  release(moved.lift), release(moved.moves), release(moved.supported), release(supported);
  survey = {};
  move_points(cloud, lift);
  reproject_points(cloud, {moves, params.sided, params.noise, sheet_end}, lift, stage);
  put_in_order(cloud);
  std::vector<float> lifts;
  for (std::size_t i = 0; i < lift.size(); ++i)
    if (moves[i] != 0) lifts.push_back(std::abs(lift[i]));
  Smoothed smoothed{lifts.size(), size - lift.size(), 0.0};
  if (lifts.empty()) return smoothed;
  smoothed.moved_median_world = median_of(std::span(lifts)) * cloud.half_extent_world;
  smoothed.layered = lie_in_layers(lifts);
  return smoothed;
}

}  // namespace splatray
