#include <span>
#include <vector>

#include "engine/scene/splat.h"
#include "preprocess/base/morton.h"
#include "preprocess/tree/insertion.h"

namespace splatray {
namespace {

/// SplitMix64 (Steele, Lea, Flood 2014, "Fast splittable pseudorandom number generators").
class Random {
 public:
  explicit Random(std::uint64_t state) : state_(state) {}

  std::uint64_t bits() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15ULL;
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ z >> 27) * 0x94D049BB133111EBULL;
    return z ^ z >> 31;
  }
  /// Uniform in [0, 1).
  double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  /// Uniform in [0, bound), bound small.
  std::uint32_t below(std::uint32_t bound) {
    return static_cast<std::uint32_t>((bits() >> 32) * bound >> 32);
  }

 private:
  std::uint64_t state_;
};

struct Segment {
  glm::dvec3 from;
  glm::dvec3 along;  // to the segment's end
};

/// A random point on face 0..5 (axis, end) of a cell.
glm::dvec3 point_on_face(Random& random, std::uint32_t face, const glm::dvec3& cell_min, double cell_size) {
  glm::dvec3 point = cell_min + cell_size * glm::dvec3(random.unit(), random.unit(), random.unit());
  const auto axis = static_cast<glm::length_t>(face / 2);
  point[axis] = cell_min[axis] + (face % 2 == 0 ? 0.0 : cell_size);
  return point;
}

Segment probe_segment(Random& random, const Leaf& leaf) {
  const glm::dvec3 cell_min(morton_point(leaf.key));
  const std::uint32_t entry = random.below(6);
  const std::uint32_t exit = (entry + 1 + random.below(5)) % 6;
  const glm::dvec3 from = point_on_face(random, entry, cell_min, leaf.cell_size());
  return {from, point_on_face(random, exit, cell_min, leaf.cell_size()) - from};
}

bool is_hit(const Splat& splat, const Segment& segment) {
  const glm::dvec3 offset = splat.center - segment.from;
  const double t = glm::dot(splat.normal, offset) / glm::dot(splat.normal, segment.along);
  if (!(t >= 0.0 && t <= 1.0)) return false;
  const glm::dvec3 from_center = segment.along * t - offset;
  return glm::dot(from_center, from_center) <= splat.radius_squared;
}

/// Marks which of a leaf's listed splats stay: those whose centre it holds, and those that probes need.
class LeafProbe {
 public:
  LeafProbe(const Leaf& leaf, std::span<const std::uint32_t> listed, const SplatList& splats,
            std::span<std::uint8_t> keep)
      : leaf_(leaf), keep_(keep) {
    decoded_.reserve(listed.size());
    for (std::size_t i = 0; i < listed.size(); ++i) {
      decoded_.push_back(unpack_splat(splats.words[listed[i]]));
      keep_[i] = listed[i] >= leaf.begin && listed[i] < leaf.end;
      original_.push_back(keep_[i]);
    }
  }

  void send(std::uint32_t probes, std::uint64_t seed) {
    Random random(Random(leaf_.key ^ seed).bits() + leaf_.level);
    for (std::uint32_t probe = 0; probe < probes; ++probe) {
      const Segment segment = probe_segment(random, leaf_);
      if (hits_original(segment)) continue;
      for (std::size_t i = 0; i < decoded_.size(); ++i) {
        if (keep_[i] == 0 && is_hit(decoded_[i], segment)) keep_[i] = 1;
      }
    }
  }

 private:
  [[nodiscard]] bool hits_original(const Segment& segment) const {
    for (std::size_t i = 0; i < decoded_.size(); ++i) {
      if (original_[i] != 0 && is_hit(decoded_[i], segment)) return true;
    }
    return false;
  }

  const Leaf& leaf_;
  std::span<std::uint8_t> keep_;
  std::vector<Splat> decoded_;
  std::vector<std::uint8_t> original_;
};

}  // namespace

LeafLists keep_probed(const Octree& tree, const SplatList& splats, const LeafLists& overlaps,
                      std::uint32_t probes, std::uint64_t seed, const Stage& stage) {
  std::vector<std::uint8_t> keep(overlaps.splat.size());
  parallel_each(stage, tree.leaves.size(), [&](std::size_t i) {
    const std::size_t begin = overlaps.begin[i];
    const std::size_t count = overlaps.begin[i + 1] - begin;
    if (count == 0) return;
    const auto listed = std::span(overlaps.splat).subspan(begin, count);
    LeafProbe(tree.leaves[i], listed, splats, std::span(keep).subspan(begin, count)).send(probes, seed);
  });
  LeafLists lists;
  lists.begin.reserve(overlaps.begin.size());
  for (std::size_t i = 0; i < tree.leaves.size(); ++i) {
    lists.begin.push_back(static_cast<std::uint32_t>(lists.splat.size()));
    for (std::size_t j = overlaps.begin[i]; j < overlaps.begin[i + 1]; ++j) {
      if (keep[j] != 0) lists.splat.push_back(overlaps.splat[j]);
    }
  }
  lists.begin.push_back(static_cast<std::uint32_t>(lists.splat.size()));
  return lists;
}

}  // namespace splatray
