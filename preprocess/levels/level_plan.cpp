#include "preprocess/levels/level_plan.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "preprocess/base/bounds.h"
#include "preprocess/base/morton.h"

namespace splatray {
namespace {

constexpr std::size_t MOST_CELLS = std::size_t{1} << 20;  ///< some 80 MB
constexpr unsigned MOST_DEPTH = 20;                       ///< Morton keys have 21 bits an axis
constexpr double FIRST_CELLS = 256.0;                     ///< along the first points' longest side

/// A counted cell by its Morton key among those of the root.
using KeyedCount = std::pair<std::uint64_t, std::uint64_t>;

/// Divides cells, ascending, of one node into parts.
void divide(std::span<const KeyedCount> cells, std::uint32_t level, unsigned depth, std::uint64_t most,
            std::vector<LevelPart>& parts) {
  std::uint64_t points = 0;
  for (const KeyedCount& cell : cells) points += cell.second;
  if (points <= most || level == depth) {
    parts.push_back({level, morton_point(cells.front().first) >> (depth - level), points});
    return;
  }
  const unsigned shift = 3 * (depth - level - 1);
  while (!cells.empty()) {
    const std::uint64_t child = cells.front().first >> shift;
    const auto end = std::find_if(cells.begin(), cells.end(),
                                  [&](const KeyedCount& cell) { return cell.first >> shift != child; });
    const auto count = static_cast<std::size_t>(end - cells.begin());
    divide(cells.first(count), level + 1, depth, most, parts);
    cells = cells.subspan(count);
  }
}

}  // namespace

void LevelPlan::index() {
  begins_.clear();
  for (const LevelPart& part : parts) begins_.push_back(morton_key(part.cell << (depth - part.level)));
}

std::size_t LevelPlan::part_of(const glm::uvec3& place) const {
  const std::uint64_t key = morton_key(LevelLattice::cell(place, depth));
  const auto after = std::upper_bound(begins_.begin(), begins_.end(), key);
  if (after == begins_.begin()) return parts.size();
  const auto part = static_cast<std::size_t>(std::distance(begins_.begin(), after)) - 1;
  return LevelLattice::cell(place, parts[part].level) == parts[part].cell ? part : parts.size();
}

std::size_t CellCounts::Hash::operator()(const glm::i64vec3& cell) const {
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis)
    hash = (hash ^ static_cast<std::uint64_t>(cell[axis])) * 0x9E3779B97F4A7C15ULL;
  return static_cast<std::size_t>(hash ^ hash >> 32U);
}

void CellCounts::coarsen() {
  ++exponent_;
  Counts coarser;
  for (const auto& [cell, count] : counts_) coarser[cell >> std::int64_t{1}] += count;
  counts_ = std::move(coarser);
}

void CellCounts::add(std::span<const glm::dvec3> positions) {
  if (positions.empty()) return;
  Bounds box;
  for (const glm::dvec3& position : positions) box.add(position);
  const glm::dvec3 extent = box.high - box.low;
  const double longest = std::max({extent.x, extent.y, extent.z});
  // Indices of cells must fit 64 bits however far away they are.
  const double farthest = glm::length(glm::max(glm::abs(box.low), glm::abs(box.high)));
  const double least = std::max(longest / FIRST_CELLS, farthest * 0x1p-50);
  if (points_ == 0) exponent_ = least > 0.0 ? std::ilogb(least) : 0;
  while (std::ldexp(1.0, exponent_) < farthest * 0x1p-50) coarsen();
  for (const glm::dvec3& position : positions) {
    ++counts_[glm::i64vec3(glm::floor(position * std::ldexp(1.0, -exponent_)))];
    if (counts_.size() > MOST_CELLS) coarsen();
  }
  points_ += positions.size();
}

LevelPlan CellCounts::plan(std::uint64_t most) const {
  glm::i64vec3 low = counts_.begin()->first, high = low;
  for (const auto& [cell, count] : counts_) low = glm::min(low, cell), high = glm::max(high, cell);
  const auto across =
      static_cast<std::uint64_t>(std::max({high.x - low.x, high.y - low.y, high.z - low.z})) + 1;
  LevelPlan plan;
  unsigned shift = 0;  // of cells that are too many for keys
  while ((std::uint64_t{1} << plan.depth) < across) ++plan.depth;
  if (plan.depth > MOST_DEPTH) shift = plan.depth - MOST_DEPTH;
  plan.lattice = {glm::dvec3(low) * std::ldexp(1.0, exponent_),
                  std::ldexp(1.0, exponent_ + static_cast<int>(plan.depth))};
  plan.depth -= shift;
  std::vector<KeyedCount> cells;
  for (const auto& [cell, count] : counts_)
    cells.emplace_back(morton_key(glm::uvec3((cell - low) >> static_cast<std::int64_t>(shift))), count);
  std::sort(cells.begin(), cells.end());
  divide(cells, 0, plan.depth, most, plan.parts);
  plan.index();
  return plan;
}

}  // namespace splatray
