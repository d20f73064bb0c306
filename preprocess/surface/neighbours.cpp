#include "preprocess/surface/neighbours.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "preprocess/base/select.h"
#include "preprocess/surface/ball.h"

namespace splatray {
namespace {

constexpr std::size_t MAX_COINCIDENT = 8;
constexpr std::size_t PARALLEL_SIZE = 1U << 14;  // sites worth another task
constexpr std::size_t MOST_MEASURED = 64;        // of a part's sites, to find its longest axis
constexpr float INFINITE = std::numeric_limits<float>::infinity();

/// max(below, above, 0), of which one at most is positive. Twice max(x, 0) is exactly x + |x|, which vectorises where max
/// does not.
float gap(float below, float above) { return 0.5F * ((below + std::abs(below)) + (above + std::abs(above))); }

}  // namespace

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
  std::vector<std::uint8_t> is_site(cloud.size());
  const auto same_place = [&](std::size_t i) { return i > 0 && cloud.coord[i] == cloud.coord[i - 1]; };
  const auto choose = [&](std::size_t first) {  // among the points at one place
    std::size_t coincident = 0;
    for (std::size_t i = first; i == first || (i < cloud.size() && same_place(i)); ++i) {
      const bool copy = i > first && (kind == Sites::positions || cloud.normal[i] == cloud.normal[i - 1]);
      is_site[i] = !copy && ++coincident <= MAX_COINCIDENT;
    }
  };
  const auto counts = [&](std::size_t i) { return kind != Sites::oriented_surface || cloud.on_surface(i); };
  tbb::parallel_for(std::size_t{0}, cloud.size(), [&](std::size_t i) {
    if (!same_place(i)) choose(i);
  });
  const auto sites_where = [&](bool chosen) {
    const auto numbers =
        numbers_where(cloud.size(), [&](std::size_t i) { return (is_site[i] != 0) == chosen && counts(i); });
    std::vector<Site> sites(numbers.size());
    tbb::parallel_for(std::size_t{0}, sites.size(), [&](std::size_t n) {
      sites[n] = {cloud.coord[numbers[n]], numbers[n]};
    });
    return sites;
  };
  copies_ = sites_where(false);
  return sites_where(true);
}

void NeighbourSearch::keep(const std::vector<std::uint32_t>& number) {
  tbb::parallel_for(std::size_t{0}, blocks_.size(), [&](std::size_t b) {
    Block& block = blocks_[b];
    for (std::uint32_t j = 0; j < WIDTH; ++j) {
      if (!block.has(j)) continue;
      block.index[j] = number[block.index[j]];
      if (block.index[j] == NO_CELL) block.x[j] = block.y[j] = block.z[j] = INFINITE;
    }
  });
}

/// Puts sites into the order of a k-d tree: halves of `capacity`, a power of two >= sites.size(), down to one
/// block.
void NeighbourSearch::arrange(std::span<Site> sites, std::size_t capacity) {
  if (capacity <= WIDTH) return;
  const std::size_t half = capacity / 2;
  if (sites.size() <= half) return arrange(sites, half);
  glm::vec3 low(INFINITE);
  glm::vec3 high(-INFINITE);
  const std::size_t step = (sites.size() + MOST_MEASURED - 1) / MOST_MEASURED;
  for (std::size_t i = 0; i < sites.size(); i += step) {
    low = glm::min(low, sites[i].coord);
    high = glm::max(high, sites[i].coord);
  }
  const glm::vec3 extent = high - low;
  const int axis = extent.x >= extent.y ? (extent.x >= extent.z ? 0 : 2) : (extent.y >= extent.z ? 1 : 2);
  if (axis == 0) select_nth(sites, half, [](const Site& site) { return site.coord.x; });
  if (axis == 1) select_nth(sites, half, [](const Site& site) { return site.coord.y; });
  if (axis == 2) select_nth(sites, half, [](const Site& site) { return site.coord.z; });
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
  tbb::parallel_for(std::size_t{0}, blocks_.size(), [&](std::size_t b) {
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
  });
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
    const float x = gap(boxes.low[0][j] - query.x, query.x - boxes.high[0][j]);
    const float y = gap(boxes.low[1][j] - query.y, query.y - boxes.high[1][j]);
    const float z = gap(boxes.low[2][j] - query.z, query.z - boxes.high[2][j]);
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
  block.measure(query, distance);
  const float bound = nearest.bound();
  for (std::uint32_t j = 0; j < WIDTH; ++j) {
    if (distance[j] > 0.0F && distance[j] <= bound && distance[j] < INFINITE) {
      nearest.add(Neighbour(distance[j], block.index[j]));
    }
  }
}

}  // namespace splatray
