/// Searches for many queries at a time.
#include <array>

#include "engine/base/vector_clones.h"
#include "preprocess/surface/ball.h"

namespace splatray {
namespace {

constexpr std::size_t GROUPS_PER_TASK = 8;
constexpr std::size_t QUERIES_PER_TASK = 256;  // of find_each: these may share a walk
constexpr float REACH_GROWTH = 1.1F;  // of the squared distance searched, over what the block before needed
constexpr float WIDER = 1.3F;         // the next guess over what an even density asks for
constexpr float NARROWER = 0.4F;      // the next guess where there were too many
constexpr int MOST_GUESSES = 3;
constexpr float QUERIES_TOGETHER =
    0.7F;  // longest side of the box of queries that share a walk, in units of their reach

/// The next squared distance to search within where `count` sites were looked for and as many `found`.
float next_guess(float reach_squared, std::optional<std::size_t> found, std::size_t count) {
  if (!found) return NARROWER * reach_squared;
  return WIDER * static_cast<float>(count) / static_cast<float>(*found + 1) * reach_squared;
}

}  // namespace

SPLATRAY_VECTOR_CLONES float NeighbourSearch::find_block(std::uint32_t block, float reach_squared,
                                                         std::size_t count, const Visit& visit) const {
  const Boxes& boxes = levels_[0][block / WIDTH];
  const auto corner = [&](const float(&planes)[3][WIDTH]) {
    return glm::vec3(planes[0][block % WIDTH], planes[1][block % WIDTH], planes[2][block % WIDTH]);
  };
  Ball ball(*this, corner(boxes.low), corner(boxes.high), reach_squared);
  std::array<Neighbour, MOST_NEAREST> places;
  float widest = 0.0F;
  const Block& sites = blocks_[block];
  for (std::uint32_t j = 0; j < WIDTH; ++j) {
    if (!sites.has(j)) continue;
    const glm::vec3 query(sites.x[j], sites.y[j], sites.z[j]);
    std::span<Neighbour> nearest = std::span(places).first(count);
    std::optional<std::size_t> found;
    for (int guess = 0;; ++guess) {
      found = ball.collect(query, nearest, ball.reach_squared(), true);
      if (found == count || guess == MOST_GUESSES) break;
      ball =
          Ball(*this, corner(boxes.low), corner(boxes.high), next_guess(ball.reach_squared(), found, count));
    }
    if (found != count) nearest = nearest.first(find(query, nearest));
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
    const std::size_t found = find(copies_[i].coord, std::span(places).first(count));
    visit(copies_[i].index, std::span(places).first(found));
  });
}

/// Finds what a query asks for by itself, and returns how many sites there are.
SPLATRAY_VECTOR_CLONES std::size_t NeighbourSearch::find_one(const Query& query,
                                                             std::span<Neighbour> nearest) const {
  float reach_squared = query.guess_squared;
  for (int guess = 0; guess < MOST_GUESSES; ++guess) {
    const Ball ball(*this, query.place, query.place, reach_squared);
    const auto found = ball.collect(query.place, nearest, reach_squared, false);
    if (found && (*found == nearest.size() || reach_squared == query.limit_squared)) return *found;
    reach_squared = std::min(next_guess(reach_squared, found, nearest.size()), query.limit_squared);
  }
  std::size_t count = find(query.place, nearest);
  while (count > 0 && nearest[count - 1].distance_squared() > query.limit_squared) --count;
  return count;
}

/// Answers the first queries, as many as are near enough to each other to share a walk, and returns how many they are. Their
/// guesses hold with a `factor`, which becomes that of the next ones.
SPLATRAY_VECTOR_CLONES std::size_t NeighbourSearch::find_some(std::span<const Query> queries,
                                                              std::size_t first, std::size_t count,
                                                              float& factor, const Visit& visit) const {
  const auto guess = [factor](const Query& query) {
    return std::min(factor * query.guess_squared, query.limit_squared);
  };
  glm::vec3 low = queries[0].place, high = low;
  float widest = guess(queries[0]), narrowest = widest;
  std::size_t together = 1;
  for (; together < queries.size(); ++together) {
    const Query& query = queries[together];
    const glm::vec3 new_low = glm::min(low, query.place), new_high = glm::max(high, query.place);
    const float reach_squared = guess(query), least = std::min(narrowest, reach_squared);
    const glm::vec3 sides = new_high - new_low;
    const float side = std::max({sides.x, sides.y, sides.z});
    if (!(side * side <= QUERIES_TOGETHER * QUERIES_TOGETHER * least)) break;
    low = new_low, high = new_high, narrowest = least, widest = std::max(widest, reach_squared);
  }
  const Ball ball(*this, low, high, widest);
  std::array<Neighbour, MOST_EACH> places;
  float needed = 0.0F;
  for (std::size_t n = 0; n < together; ++n) {
    const Query& query = queries[n];
    std::span<Neighbour> nearest = std::span(places).first(count);
    auto found = ball.collect(query.place, nearest, guess(query), false);
    if (!found || (*found < count && guess(query) < query.limit_squared)) found = find_one(query, nearest);
    nearest = nearest.first(*found);
    if (*found == count)
      needed = std::max(
          needed, std::max_element(nearest.begin(), nearest.end())->distance_squared() / query.guess_squared);
    visit(static_cast<std::uint32_t>(first + n), nearest);
  }
  if (needed > 0.0F) factor = REACH_GROWTH * needed;
  return together;
}

void NeighbourSearch::find_each(std::size_t queries, const QueryOf& query_of, std::size_t count,
                                const Stage& stage, const Visit& visit) const {
  const auto some = [&](std::size_t task) {
    const std::size_t begin = task * QUERIES_PER_TASK, end = std::min(begin + QUERIES_PER_TASK, queries);
    std::array<Query, QUERIES_PER_TASK> asked;
    for (std::size_t n = begin; n < end; ++n) asked[n - begin] = query_of(static_cast<std::uint32_t>(n));
    const std::span<const Query> all = std::span(asked).first(end - begin);
    float factor = 1.0F;
    for (std::size_t done = 0; done < all.size();)
      done += find_some(all.subspan(done), begin + done, count, factor, visit);
  };
  parallel_each(stage, (queries + QUERIES_PER_TASK - 1) / QUERIES_PER_TASK, some, 4);
}

}  // namespace splatray
