#include "preprocess/surface/neighbours.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "preprocess/base/select.h"

namespace splatray {
namespace {

constexpr std::size_t MAX_COINCIDENT = 8;
constexpr std::size_t PARALLEL_SIZE = 1U << 14;  // sites worth another task
constexpr std::size_t MOST_MEASURED = 64;        // of a part's sites, to find its longest axis
constexpr std::size_t GROUPS_PER_TASK = 8;
constexpr float REACH_GROWTH = 1.1F;  // of the squared distance searched, over what the block before needed
constexpr std::size_t MOST_NEAREST = 32;
constexpr float INFINITE = std::numeric_limits<float>::infinity();

/// max(below, above, 0), of which one at most is positive. Twice max(x, 0) is exactly x + |x|, which vectorises where max
/// does not.
float gap(float below, float above) { return 0.5F * ((below + std::abs(below)) + (above + std::abs(above))); }

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

NeighbourSearch::NeighbourSearch(const Cloud& cloud, Sites kind) : cloud_(cloud) {
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
  tbb::parallel_for(std::size_t{0}, cloud.size(), [&](std::size_t i) {
    if (!same_place(i)) choose(i);
  });
  copies_ = numbers_where(cloud.size(), [&](std::size_t i) { return is_site[i] == 0; });
  const auto chosen = numbers_where(cloud.size(), [&](std::size_t i) { return is_site[i] != 0; });
  std::vector<Site> sites(chosen.size());
  tbb::parallel_for(std::size_t{0}, sites.size(), [&](std::size_t n) {
    sites[n] = {cloud.coord[chosen[n]], chosen[n]};
  });
  return sites;
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

void NeighbourSearch::Block::measure(const glm::vec3& query, float* distance) const {
  for (std::uint32_t j = 0; j < WIDTH; ++j) {
    const float dx = x[j] - query.x;
    const float dy = y[j] - query.y;
    const float dz = z[j] - query.z;
    distance[j] = dx * dx + dy * dy + dz * dz;
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

/// The blocks that come within some distance of a box of queries, so that all sites near these are among theirs.
class NeighbourSearch::Ball {
 public:
  Ball(const NeighbourSearch& search, const glm::vec3& low, const glm::vec3& high, float reach_squared)
      : search_(search), low_(low), high_(high), reach_squared_(reach_squared) {
    nodes_[0] = 0;
    count_ = 1;
    for (std::size_t level = search.levels_.size(); level-- > 0 && count_ > 0;) descend(level);
  }

  /// Whether the blocks are all there are, and not too many.
  [[nodiscard]] bool complete() const { return complete_; }

  /// Finds the `nearest.size()` nearest sites of a query in the box, or returns false: they may be farther away, or
  /// there are too many.
  bool find(const glm::vec3& query, std::span<Neighbour> nearest) const {
    return collect(query, nearest) == nearest.size();
  }

  /// Finds as many of the nearest sites within reach as there are, at most nearest.size(), and returns how many;
  /// nothing where there are too many to tell.
  [[nodiscard]] std::optional<std::size_t> collect(const glm::vec3& query,
                                                   std::span<Neighbour> nearest) const {
    float distance[MOST_NODES * WIDTH];
    for (std::size_t i = 0; i < count_; ++i) search_.blocks_[nodes_[i]].measure(query, distance + i * WIDTH);
    double keys[MOST_SITES + WIDTH];
    std::size_t count = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      if (count > MOST_SITES - WIDTH) return {};
      count = add(search_.blocks_[nodes_[i]], distance + i * WIDTH, keys, count);
    }
    std::fill_n(keys + count, WIDTH, std::numeric_limits<double>::infinity());  // they come last
    double sorted[MOST_SITES + 1];
    for (std::size_t i = 0; i < count; i += WIDTH) place(keys + i, keys, count, sorted);
    const std::size_t found = std::min(count, nearest.size());
    for (std::size_t i = 0; i < found; ++i) nearest[i] = std::bit_cast<Neighbour>(sorted[i]);
    return found;
  }

 private:
  static constexpr std::size_t MOST_NODES = 128;
  static constexpr std::size_t MOST_SITES = 128;

  /// Replaces the nodes by those of their children that are near; by none when these are too many.
  void descend(std::size_t level) {
    std::uint32_t children[MOST_NODES];
    std::size_t count = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      if (count > MOST_NODES - WIDTH) {
        count = 0;
        complete_ = false;
        break;
      }
      const Boxes& boxes = search_.levels_[level][nodes_[i]];
      float distance[WIDTH];
      for (std::uint32_t j = 0; j < WIDTH; ++j) {
        const float x = apart(boxes, 0, j), y = apart(boxes, 1, j), z = apart(boxes, 2, j);
        distance[j] = x * x + y * y + z * z;  // NaN for boxes at infinity
      }
      for (std::uint32_t j = 0; j < WIDTH; ++j) {
        children[count] = nodes_[i] * WIDTH + j;
        count += static_cast<std::size_t>(distance[j] <= reach_squared_);
      }
    }
    std::copy_n(children, count_ = count, nodes_);
  }

  [[nodiscard]] float apart(const Boxes& boxes, int axis, std::uint32_t j) const {
    return gap(boxes.low[axis][j] - high_[axis], low_[axis] - boxes.high[axis][j]);
  }

  /// Puts WIDTH of the keys where they belong: as many keys are smaller. Two at a time, as every processor can.
  static void place(const double* some, const double* keys, std::size_t count, double* sorted) {
    using Pair = double __attribute__((vector_size(16)));
    using Count = std::int64_t __attribute__((vector_size(16)));
    Pair values[WIDTH / 2];
    std::memcpy(values, some, sizeof values);
    Count smaller[WIDTH / 2]{};
    for (std::size_t j = 0; j < count; ++j) {
      const Pair key{keys[j], keys[j]};
      for (std::size_t k = 0; k < WIDTH / 2; ++k) smaller[k] -= key < values[k];  // true is -1
    }
    for (std::size_t k = 0; k < WIDTH; ++k) sorted[smaller[k / 2][k % 2]] = some[k];
  }

  /// Adds the sites of a block that are near, but not at the query. Bits of floats >= 0 order like their values; less 1,
  /// zero is the largest.
  std::size_t add(const Block& block, const float* distance, double* keys, std::size_t count) const {
    const auto reach_bits = std::bit_cast<std::uint32_t>(reach_squared_);
    for (std::uint32_t j = 0; j < WIDTH; ++j) {
      keys[count] = std::bit_cast<double>(Neighbour(distance[j], block.index[j]));
      count += static_cast<std::size_t>(std::bit_cast<std::uint32_t>(distance[j]) - 1U < reach_bits);
    }
    return count;
  }

  const NeighbourSearch& search_;
  glm::vec3 low_, high_;
  float reach_squared_;
  std::uint32_t nodes_[MOST_NODES];
  std::size_t count_;
  bool complete_ = true;
};

std::size_t NeighbourSearch::find_within(const glm::vec3& query, std::span<Neighbour> nearest,
                                         float reach_squared) const {
  if (blocks_.empty()) return 0;
  const Ball ball(*this, query, query, reach_squared);
  if (ball.complete())
    if (const auto count = ball.collect(query, nearest)) return *count;
  std::size_t count = find(query, nearest);
  while (count > 0 && nearest[count - 1].distance_squared() > reach_squared) --count;
  return count;
}

std::size_t NeighbourSearch::find(const glm::vec3& query, std::span<Neighbour> nearest, float guess) const {
  if (!blocks_.empty() && Ball(*this, query, query, guess).find(query, nearest)) return nearest.size();
  return find(query, nearest);
}

float NeighbourSearch::find_block(std::uint32_t block, float reach_squared, std::size_t count,
                                  const Visit& visit) const {
  const Boxes& boxes = levels_[0][block / WIDTH];
  const auto corner = [&](const float(&planes)[3][WIDTH]) {
    return glm::vec3(planes[0][block % WIDTH], planes[1][block % WIDTH], planes[2][block % WIDTH]);
  };
  const Ball ball(*this, corner(boxes.low), corner(boxes.high), reach_squared);
  std::array<Neighbour, MOST_NEAREST> places;
  float widest = 0.0F;
  const Block& sites = blocks_[block];
  for (std::uint32_t j = 0; j < WIDTH && sites.x[j] < INFINITE; ++j) {
    const glm::vec3 query(sites.x[j], sites.y[j], sites.z[j]);
    std::span<Neighbour> nearest = std::span(places).first(count);
    if (!ball.find(query, nearest)) nearest = nearest.first(find(query, nearest));
    if (!nearest.empty()) widest = std::max(widest, nearest.back().distance_squared());
    visit(sites.index[j], nearest);
  }
  return REACH_GROWTH * widest;
}

void NeighbourSearch::find_all(std::size_t count, const Stage& stage, const Visit& visit) const {
  const auto group = [&](std::size_t g) {
    const std::size_t begin = g * WIDTH, end = std::min(begin + WIDTH, blocks_.size());
    const Block& first = blocks_[begin];
    std::array<Neighbour, MOST_NEAREST> places;
    const std::size_t found = find({first.x[0], first.y[0], first.z[0]}, std::span(places).first(count));
    float reach_squared = found > 0 ? REACH_GROWTH * places[found - 1].distance_squared() : 0.0F;
    for (std::size_t b = begin; b < end; ++b)
      reach_squared = find_block(static_cast<std::uint32_t>(b), reach_squared, count, visit);
  };
  parallel_each(stage, blocks_.empty() ? 0 : levels_[0].size(), group, GROUPS_PER_TASK);
  tbb::parallel_for(std::size_t{0}, copies_.size(), [&](std::size_t i) {
    std::array<Neighbour, MOST_NEAREST> places;
    const std::size_t found = find(cloud_.coord[copies_[i]], std::span(places).first(count));
    visit(copies_[i], std::span(places).first(found));
  });
}

}  // namespace splatray
