#include "preprocess/mesh/edges/mesh_parts.h"

namespace splatray {

MeshParts find_parts(std::size_t triangles,
                     const std::function<std::uint32_t(std::uint32_t, std::uint32_t)>& across) {
  constexpr std::uint32_t NO_PART = 0xFFFFFFFF;
  MeshParts found{std::vector<std::uint32_t>(triangles, NO_PART), 0};
  std::vector<std::uint32_t> open;
  for (std::uint32_t first = 0; first < triangles; ++first) {
    if (found.of[first] != NO_PART) continue;
    found.of[first] = found.count;
    open.push_back(first);
    while (!open.empty()) {
      const std::uint32_t t = open.back();
      open.pop_back();
      for (std::uint32_t side = 0; side < 3; ++side) {
        const std::uint32_t other = across(t, side);
        if (other >= triangles || found.of[other] != NO_PART) continue;
        found.of[other] = found.count;
        open.push_back(other);
      }
    }
    ++found.count;
  }
  return found;
}

}  // namespace splatray
