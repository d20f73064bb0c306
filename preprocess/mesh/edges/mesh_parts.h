/// The parts of a mesh, the triangles that hang together.
#pragma once
#include <cstdint>
#include <functional>
#include <vector>

namespace splatray {

struct MeshParts {
  std::vector<std::uint32_t> of;  ///< the number of each triangle's part
  std::uint32_t count = 0;
};

/// `across`, asked of a triangle and a side of it: the triangle there; what is no triangle's number means none.
[[nodiscard]] MeshParts find_parts(std::size_t triangles,
                                   const std::function<std::uint32_t(std::uint32_t, std::uint32_t)>& across);

}  // namespace splatray
