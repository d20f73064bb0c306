#include "preprocess/neighbours.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace splatray {
namespace {

constexpr std::size_t MAX_COINCIDENT = 8;
constexpr std::size_t PARALLEL_SIZE = 1U << 14;  // sites worth another task
constexpr float INFINITE = std::numeric_limits<float>::infinity();

/// Distance of a value from an interval. Twice max(x, 0) is exactly x + |x|, which vectorises where max does
/// not.
float outside(float low, float value, float high) {
  const float below = low - value;
  const float above = value - high;
  return 0.5F * ((below + std::abs(below)) + (above + std::abs(above)));
}

}  // namespace

Neighbour::Neighbour(float distance_squared, std::uint32_t index)
    : key_(static_cast<std::uint64_t>(std::bit_cast<std::uint32_t>(distance_squared)) << 32 | index) {}

float Neighbour::distance_squared() const {
  return std::bit_cast<float>(static_cast<std::uint32_t>(key_ >> 32));
}

/// The best so far, ascending.
struct NeighbourSearch::Nearest {
  std::span<Neighbour> best;
  std::size_t count = 0;

  [[nodiscard]] float bound() const {
    return count < best.size() ? INFINITE : best[count - 1].distance_squared();
  }

  void add(Neighbour candidate) {
    if (count == best.size()) {
      if (best[count - 1] <= candidate) return;
      --count;
    }
    std::size_t place = count++;
    for (; place > 0 && candidate < best[place - 1]; --place) best[place] = best[place - 1];
    best[place] = candidate;
  }
};

NeighbourSearch::NeighbourSearch(const Cloud& cloud, Sites kind) {
  std::vector<Site> sites = choose_sites(cloud, kind);
  arrange(sites, std::bit_ceil(std::max<std::size_t>(sites.size(), WIDTH)));
  add_blocks(sites);
  add_levels();
}

/// The points that stand for their position (and normal). Coincident points are next to each other in
/// canonical order, those of equal normals among them too.
std::vector<NeighbourSearch::Site> NeighbourSearch::choose_sites(const Cloud& cloud, Sites kind) {
  std::vector<Site> chosen;
  chosen.reserve(cloud.size());
  std::size_t coincident = 0;
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    const bool same_place = i > 0 && cloud.coord[i] == cloud.coord[i - 1];
    if (!same_place) coincident = 0;
    if (same_place && (kind == Sites::positions || cloud.normal[i] == cloud.normal[i - 1])) continue;
    if (++coincident <= MAX_COINCIDENT) chosen.push_back({cloud.coord[i], i});
  }
  return chosen;
}

/// Puts sites into the order of a k-d tree: halves of `capacity`, a power of two >= sites.size(), down to one
/// block.
void NeighbourSearch::arrange(std::span<Site> sites, std::size_t capacity) {
  if (capacity <= WIDTH) return;
  const std::size_t half = capacity / 2;
  if (sites.size() <= half) return arrange(sites, half);
  glm::vec3 low(INFINITE);
  glm::vec3 high(-INFINITE);
  for (const Site& site : sites) low = glm::min(low, site.coord), high = glm::max(high, site.coord);
  const glm::vec3 extent = high - low;
  const int axis = extent.x >= extent.y ? (extent.x >= extent.z ? 0 : 2) : (extent.y >= extent.z ? 1 : 2);
  std::nth_element(sites.begin(), sites.begin() + static_cast<std::ptrdiff_t>(half), sites.end(),
                   [axis](const Site& a, const Site& b) { return a.coord[axis] < b.coord[axis]; });
  if (capacity > PARALLEL_SIZE) {
    tbb::parallel_invoke([&] { arrange(sites.first(half), half); },
                         [&] { arrange(sites.subspan(half), half); });
  } else {
    arrange(sites.first(half), half);
    arrange(sites.subspan(half), half);
  }
}

void NeighbourSearch::add_blocks(std::span<const Site> sites) {
  blocks_.resize((sites.size() + WIDTH - 1) / WIDTH);
  levels_.emplace_back((blocks_.size() + WIDTH - 1) / WIDTH);
  std::fill_n(reinterpret_cast<float*>(levels_[0].data()), levels_[0].size() * sizeof(Boxes) / sizeof(float),
              INFINITE);
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    Block& block = blocks_[b];
    Boxes& boxes = levels_[0][b / WIDTH];
    glm::vec3 low(INFINITE);
    glm::vec3 high(-INFINITE);
    for (std::size_t j = 0; j < WIDTH; ++j) {
      const std::size_t site = b * WIDTH + j;
      const bool used = site < sites.size();
      const glm::vec3 p = used ? sites[site].coord : glm::vec3(INFINITE);
      block.x[j] = p.x;
      block.y[j] = p.y;
      block.z[j] = p.z;
      block.index[j] = used ? sites[site].index : 0U;
      if (used) low = glm::min(low, p), high = glm::max(high, p);
    }
    for (int axis = 0; axis < 3; ++axis) {
      boxes.low[axis][b % WIDTH] = low[axis];
      boxes.high[axis][b % WIDTH] = high[axis];
    }
  }
}

void NeighbourSearch::add_levels() {
  while (levels_.back().size() > 1) {
    const std::vector<Boxes>& below = levels_.back();
    std::vector<Boxes> level((below.size() + WIDTH - 1) / WIDTH);
    for (std::size_t i = 0; i < level.size() * WIDTH; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        float& low = level[i / WIDTH].low[axis][i % WIDTH];
        float& high = level[i / WIDTH].high[axis][i % WIDTH];
        low = high = INFINITE;
        if (i >= below.size()) continue;
        low = *std::min_element(below[i].low[axis], below[i].low[axis] + WIDTH);
        high = -INFINITE;
        for (const float h : below[i].high[axis]) high = h < INFINITE ? std::max(high, h) : high;
      }
    }
    levels_.push_back(std::move(level));
  }
}

std::size_t NeighbourSearch::find(const glm::vec3& query, std::span<Neighbour> nearest) const {
  if (blocks_.empty() || nearest.empty()) return 0;
  Nearest state{nearest};
  visit(levels_.size() - 1, 0, query, state);
  return state.count;
}

void NeighbourSearch::visit(std::size_t level, std::uint32_t node, const glm::vec3& query,
                            Nearest& nearest) const {
  const Boxes& boxes = levels_[level][node];
  float distance[WIDTH];
  for (std::uint32_t j = 0; j < WIDTH; ++j) {
    const float x = outside(boxes.low[0][j], query.x, boxes.high[0][j]);
    const float y = outside(boxes.low[1][j], query.y, boxes.high[1][j]);
    const float z = outside(boxes.low[2][j], query.z, boxes.high[2][j]);
    distance[j] = x * x + y * y + z * z;  // NaN for boxes at infinity
  }
  Neighbour order[WIDTH];  // children that may matter, nearest first
  std::uint32_t count = 0;
  const float bound = nearest.bound();
  for (std::uint32_t j = 0; j < WIDTH; ++j) {
    if (!(distance[j] <= bound)) continue;
    const Neighbour child(distance[j], node * WIDTH + j);
    std::uint32_t place = count++;
    for (; place > 0 && child < order[place - 1]; --place) order[place] = order[place - 1];
    order[place] = child;
  }
  for (std::uint32_t i = 0; i < count && order[i].distance_squared() <= nearest.bound(); ++i) {
    if (level == 0) {
      visit_block(blocks_[order[i].index()], query, nearest);
    } else {
      visit(level - 1, order[i].index(), query, nearest);
    }
  }
}

void NeighbourSearch::visit_block(const Block& block, const glm::vec3& query, Nearest& nearest) const {
  float distance[WIDTH];
  for (std::uint32_t j = 0; j < WIDTH; ++j) {
    const float x = block.x[j] - query.x;
    const float y = block.y[j] - query.y;
    const float z = block.z[j] - query.z;
    distance[j] = x * x + y * y + z * z;
  }
  const float bound = nearest.bound();
  for (std::uint32_t j = 0; j < WIDTH; ++j) {
    if (distance[j] > 0.0F && distance[j] <= bound && distance[j] < INFINITE) {
      nearest.add(Neighbour(distance[j], block.index[j]));
    }
  }
}

}  // namespace splatray
