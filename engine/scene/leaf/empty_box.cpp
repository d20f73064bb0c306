#include "engine/scene/leaf/empty_box.h"

#include <bit>
#include <vector>

#include "engine/scene/tree.h"

namespace splatray {
namespace {

/// Children, a bit each, whose cells overlap a box that overlaps their parent's.
std::uint32_t children_in(const OctreeCell& cell, const OctreeBox& box) {
  const glm::ivec3 middle = glm::ivec3(cell.low) + static_cast<int>(cell.size / 2);
  const std::uint32_t x = (box.low.x < middle.x ? 0x55U : 0U) | (box.high.x > middle.x ? 0xAAU : 0U);
  const std::uint32_t y = (box.low.y < middle.y ? 0x33U : 0U) | (box.high.y > middle.y ? 0xCCU : 0U);
  const std::uint32_t z = (box.low.z < middle.z ? 0x0FU : 0U) | (box.high.z > middle.z ? 0xF0U : 0U);
  return x & y & z;
}

/// Looks at the boxes of the empty leaves below a node.
class BoxCheck {
 public:
  explicit BoxCheck(std::span<const std::uint32_t> nodes) : nodes_(nodes) {}

  /// As find_overreaching_leaf, at or below a node whose ancestors are on the path_.
  std::optional<std::uint32_t> first_wrong(std::uint32_t node, const OctreeCell& cell) {
    const std::uint32_t word = nodes_[node];
    if (word >> NODE_TAG_SHIFT == NODE_EMPTY)
      return is_right(word, cell) ? std::nullopt : std::optional(node);
    if (word >> NODE_TAG_SHIFT != NODE_INNER) return std::nullopt;
    path_.push_back({word, cell});
    std::optional<std::uint32_t> wrong;
    for (std::uint32_t child = 0; child < 8 && !wrong; ++child)
      wrong = first_wrong((word & NODE_ADDRESS_MASK) + child, child_cell(cell, child));
    path_.pop_back();
    return wrong;
  }

 private:
  [[nodiscard]] bool is_right(std::uint32_t word, const OctreeCell& cell) const {
    if ((word & EMPTY_STEPS_MASK) == 0) return true;
    const OctreeBox box = empty_box(word, cell);
    // The coordinates of the smallest cell that holds the box begin with the bits that the corners share.
    const glm::uvec3 differing = glm::uvec3(box.low) ^ glm::uvec3(box.high - 1);
    const auto bits = static_cast<std::uint32_t>(std::bit_width(differing.x | differing.y | differing.z));
    return bits <= LATTICE_BITS && is_empty(nodes_, path_[LATTICE_BITS - bits], box);
  }

  std::span<const std::uint32_t> nodes_;
  std::vector<InnerNode> path_;  ///< from the root on
};

}  // namespace

bool is_empty(std::span<const std::uint32_t> nodes, const InnerNode& node, const OctreeBox& box) {
  const std::uint32_t first = node.word & NODE_ADDRESS_MASK;
  std::uint32_t inner = 0;
  for (std::uint32_t left = children_in(node.cell, box); left != 0; left &= left - 1) {
    const auto child = static_cast<std::uint32_t>(std::countr_zero(left));
    const std::uint32_t tag = nodes[first + child] >> NODE_TAG_SHIFT;
    if (tag == NODE_FILLED) return false;
    if (tag == NODE_INNER) inner |= 1U << child;
  }
  for (; inner != 0; inner &= inner - 1) {
    const auto child = static_cast<std::uint32_t>(std::countr_zero(inner));
    if (!is_empty(nodes, {nodes[first + child], child_cell(node.cell, child)}, box)) return false;
  }
  return true;
}

std::optional<std::uint32_t> find_overreaching_leaf(std::span<const std::uint32_t> nodes) {
  BoxCheck check(nodes);
  return check.first_wrong(0, {glm::uvec3(0), 1U << LATTICE_BITS});
}

}  // namespace splatray
