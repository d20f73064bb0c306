#include "preprocess/levels/level_nodes.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

#include "preprocess/base/morton.h"

namespace splatray {
namespace {

constexpr std::size_t MOST_UNDIVIDED = 50'000;  ///< of a node that is not divided

struct Candidate {
  std::uint64_t cell, chance;
  std::uint32_t record;

  bool operator<(const Candidate& other) const {
    return std::tie(cell, chance, record) < std::tie(other.cell, other.chance, other.record);
  }
};

/// Removes what is in `taken`, ascending, but keeps one.
void remove_taken(RecordNumbers& records, RecordNumbers& taken) {
  if (records.empty()) return;  // a node above points at one place, which those below it kept
  const auto is_taken = [&](std::uint32_t record) {
    return std::binary_search(taken.begin(), taken.end(), record);
  };
  if (std::all_of(records.begin(), records.end(), is_taken))
    taken.erase(std::lower_bound(taken.begin(), taken.end(), records.back()));
  std::erase_if(records, is_taken);
}

class Builder {
 public:
  Builder(std::span<const glm::uvec3> places, const NodeListener& listener)
      : places_(places), listener_(listener) {}

  /// Builds a node of these records and returns those that it has itself.
  RecordNumbers build(std::uint32_t level, const glm::uvec3& cell, RecordNumbers records) {
    if (records.size() <= MOST_UNDIVIDED || level == MOST_LEVEL) {
      listener_.whole({level, cell, records.size()}, records);
      return records;
    }
    std::array<RecordNumbers, 8> octants = divide(level, std::move(records));
    std::vector<RecordNumbers> sets;
    std::vector<glm::uvec3> cells;
    for (std::uint32_t octant = 0; octant < octants.size(); ++octant) {
      if (octants[octant].empty()) continue;
      cells.push_back((cell << 1U) + morton_point(octant));
      sets.push_back(build(level + 1, cells.back(), std::move(octants[octant])));
    }
    RecordNumbers own = take_sample(places_, level, sets);
    for (std::size_t i = 0; i < sets.size(); ++i)
      listener_.built({level + 1, cells[i], sets[i].size()}, sets[i]);
    return own;
  }

 private:
  [[nodiscard]] std::array<RecordNumbers, 8> divide(std::uint32_t level, RecordNumbers records) const {
    std::array<RecordNumbers, 8> octants;
    const unsigned bit = LevelLattice::BITS - level - 1;
    for (const std::uint32_t record : records)
      octants[morton_key((places_[record] >> bit) & 1U)].push_back(record);
    return octants;
  }

  std::span<const glm::uvec3> places_;
  const NodeListener& listener_;
};

}  // namespace

std::uint64_t chance_of(const glm::uvec3& place) {
  std::uint64_t mixed = (std::uint64_t{place.x} << 32U) ^ (std::uint64_t{place.y} << 17U) ^ place.z;
  mixed = (mixed ^ mixed >> 30U) * 0xBF58476D1CE4E5B9ULL;
  mixed = (mixed ^ mixed >> 27U) * 0x94D049BB133111EBULL;
  return mixed ^ mixed >> 31U;
}

RecordNumbers take_sample(std::span<const glm::uvec3> places, std::uint32_t level,
                          std::span<RecordNumbers> children) {
  std::vector<Candidate> candidates;
  for (const RecordNumbers& records : children)
    for (const std::uint32_t record : records) {
      const glm::uvec3 cell =
          (places[record] >> (LevelLattice::BITS - level - LEVEL_SPAN_BITS)) & ((1U << LEVEL_SPAN_BITS) - 1);
      candidates.push_back({morton_key(cell), chance_of(places[record]), record});
    }
  std::sort(candidates.begin(), candidates.end());
  const auto last = std::unique(candidates.begin(), candidates.end(),
                                [](const Candidate& a, const Candidate& b) { return a.cell == b.cell; });
  RecordNumbers taken;
  for (auto one = candidates.begin(); one != last; ++one) taken.push_back(one->record);
  std::sort(taken.begin(), taken.end());
  for (RecordNumbers& records : children) remove_taken(records, taken);
  return taken;
}

void build_level_nodes(std::span<const glm::uvec3> places, const LevelPart& top,
                       const NodeListener& listener) {
  RecordNumbers all(places.size());
  std::iota(all.begin(), all.end(), 0U);
  Builder builder(places, listener);
  const RecordNumbers own = builder.build(top.level, top.cell, std::move(all));
  listener.built({top.level, top.cell, own.size()}, own);
}

}  // namespace splatray
