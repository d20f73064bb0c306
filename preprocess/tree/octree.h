/// The full octree over splat centres (Goradia et al. 2010, sec. III).
#pragma once
#include <cmath>
#include <compare>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/scene/scene.h"
#include "engine/scene/splat.h"
#include "engine/scene/tree.h"

namespace splatray {

/// Different splats with their centres' Morton keys. Ascending by key, then words, colour, normal field, clip lines and point.
struct SplatList {
  std::vector<std::uint64_t> key;
  std::vector<uvec4> words;
  std::vector<std::uint32_t> color;  ///< pack_color, or empty: no colours
  std::vector<std::uint32_t> field;  ///< pack_field, or empty: all discs are flat
  std::vector<std::uint32_t> clip;   ///< pack_clip, or empty: all discs are whole
  std::vector<std::uint32_t> point;  ///< which of the build's points each is, or empty: not asked for

  [[nodiscard]] std::size_t size() const { return words.size(); }
};

/// Orders splats given in any order and keeps at most `copies` of equal words. Returns how many it dropped.
std::uint64_t order_splats(SplatList& splats, std::uint32_t copies);

/// A leaf and the splats whose centres it holds.
struct Leaf {
  std::uint64_t key;    ///< Morton key of its lowest lattice point
  std::uint32_t node;   ///< index of its word in the node pool
  std::uint32_t level;  ///< its cell is 2^(LATTICE_BITS - level) lattice units wide
  std::uint32_t begin;  ///< first splat with its centre in the cell
  std::uint32_t end;    ///< one past the last

  [[nodiscard]] std::uint32_t cell_size() const { return 1U << (LATTICE_BITS - level); }
};

/// Nodes as in layout.h, depth first, but the address of a leaf's word is its index in `leaves`, for filled
/// and empty ones.
struct Octree {
  std::vector<std::uint32_t> node_pool;
  std::vector<Leaf> leaves;  ///< in Z-order, empty ones too
};

/// A node with up to CROWDED_MOST * leaf_size centres is not divided when the RMS radius of its splats exceeds WIDEST_SPLATS times
/// a child cell's width: the children would list mostly the same splats, each with copies of its own.
inline constexpr double CROWDED_MOST = 1.75;
inline constexpr double WIDEST_SPLATS = 0.36;

/// Whether `count` splats, each number_of(0), number_of(1) ..., are that large for the children of a cell of this size.
template <typename NumberOf>
[[nodiscard]] bool are_wide(const SplatList& splats, std::size_t count, const NumberOf& number_of,
                            std::uint32_t cell_size) {
  double sum_squared = 0.0;
  for (std::size_t i = 0; i < count; ++i) sum_squared += unpack_radius_squared(splats.words[number_of(i)]);
  return std::sqrt(sum_squared / static_cast<double>(count)) > WIDEST_SPLATS * (0.5 * cell_size);
}

/// A cell of the octree: the Morton key of its lowest lattice point and its level. Ascending: depth first.
struct CellName {
  std::uint64_t key;
  std::uint32_t level;
  friend auto operator<=>(const CellName&, const CellName&) = default;
};

/// Divides every node above MAX_DEPTH that holds more than `leaf_size` centres, but for those crowded ones; and those named,
/// ascending, whose parents must be divided.
[[nodiscard]] Octree build_octree(const SplatList& splats, std::uint32_t leaf_size,
                                  std::span<const CellName> divided = {});

/// The same but that nodes which overlap none of the boxes are not divided: the part of that octree in the boxes.
[[nodiscard]] Octree build_octree_in(const SplatList& splats, std::uint32_t leaf_size,
                                     const std::vector<OctreeBox>& boxes);

}  // namespace splatray
