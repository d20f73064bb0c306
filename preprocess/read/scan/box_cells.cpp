#include "preprocess/read/scan/box_cells.h"

#include <tbb/parallel_sort.h>

#include "preprocess/base/sorted_order.h"

namespace splatray {

BoxCells::BoxCells(const std::vector<Bounds>& boxes, double finest_world) {
  if (boxes.empty()) return;
  Bounds all;
  for (const Bounds& box : boxes) all.add(box);
  origin_world_ = all.low;
  finest_world_ = std::max(finest_world, longest_side(all) / (CELLS - 1));
  std::vector<KeyedIndex> entries;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    int level = 0;
    while (std::ldexp(finest_world_, level) < 0.5 * longest_side(boxes[i])) ++level;
    levels_ = std::max(levels_, level + 1);
    const glm::ivec3 first = cell_of(boxes[i].low, level), last = cell_of(boxes[i].high, level);
    for (int x = first.x; x <= last.x; ++x)
      for (int y = first.y; y <= last.y; ++y)
        for (int z = first.z; z <= last.z; ++z) entries.push_back({key_of(level, {x, y, z}), i});
  }
  tbb::parallel_sort(entries.begin(), entries.end(), [](const KeyedIndex& a, const KeyedIndex& b) {
    return a.key != b.key ? a.key < b.key : a.index < b.index;
  });
  in_cells_.reserve(entries.size());
  for (const KeyedIndex& entry : entries) {
    const auto at = static_cast<std::uint32_t>(in_cells_.size());
    Range& cell = cells_.try_emplace(entry.key, Range{at, at}).first->second;
    if (cell.end - cell.begin == MOST_OF_CELL) continue;
    cell.end = at + 1;
    in_cells_.push_back(entry.index);
  }
}

}  // namespace splatray
