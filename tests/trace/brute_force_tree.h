/// Brute force for scenes of millions of splats: the same formulas on fewer of them.
#pragma once
#include "tests/trace/brute_force.h"

namespace splatray::testing {

/// Answers as BruteForce does, bit for bit, but finds the splats near a ray by a hierarchy of boxes in float64 around the balls
/// that hold the discs: halves of equal number along the longest side. Shares nothing with the octree. Splats that are moved or
/// turned are looked for where they were.
class BruteForceTree : public BruteForce {
 public:
  explicit BruteForceTree(const Scene& scene);

 protected:
  void find_near(const RayQuery& query, std::vector<std::uint32_t>& near) const override;

 private:
  /// A box and what it holds: splats_[begin, end) in the order of `order_`. Nodes lie depth first: one that is missed is passed
  /// over by going on at `next`; a node with next = its own index + 1 is a leaf.
  struct Node {
    glm::dvec3 low, high;
    std::uint32_t begin, end;
    std::uint32_t next;
  };
  void add_node(std::uint32_t begin, std::uint32_t end);

  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace splatray::testing
