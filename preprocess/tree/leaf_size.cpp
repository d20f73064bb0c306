#include "preprocess/tree/leaf_size.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/scene/leaf/disc.h"
#include "engine/scene/splat.h"
#include "engine/scene/tree.h"
#include "preprocess/tree/insertion.h"

namespace splatray {
namespace {

/// Splats looked at, in pieces of neighbours in Z-order. A smaller list is looked at whole.
constexpr std::size_t SAMPLE = 1U << 15;
constexpr std::size_t LEAVES_PER_PIECE = 256;

struct Piece {
  std::size_t begin, end;
};

/// Evenly over the list.
std::vector<Piece> sampled_pieces(std::size_t splats) {
  const std::size_t pieces = (splats + LEAVES_PER_PIECE - 1) / LEAVES_PER_PIECE;
  const std::size_t taken = std::min(pieces, SAMPLE / LEAVES_PER_PIECE);
  std::vector<Piece> sample;
  for (std::size_t i = 0; i < taken; ++i) {
    const std::size_t begin = i * pieces / taken * LEAVES_PER_PIECE;
    sample.push_back({begin, std::min(begin + LEAVES_PER_PIECE, splats)});
  }
  return sample;
}

/// Boxes around the discs' bounding boxes, further out than insert_overlaps looks.
void add_boxes(const SplatList& splats, const Piece& piece, std::vector<OctreeBox>& boxes) {
  constexpr std::size_t TOGETHER = 16;  // neighbours share a box
  constexpr int MARGIN = static_cast<int>(LIST_INFLATION) + 2;
  for (std::size_t begin = piece.begin; begin < piece.end; begin += TOGETHER) {
    OctreeBox box{glm::ivec3(1 << LATTICE_BITS), glm::ivec3(0)};
    for (std::size_t i = begin; i < std::min(begin + TOGETHER, piece.end); ++i) {
      const Disc disc(unpack_splat(splats.words[i]));
      const glm::dvec3 center(disc.x.center, disc.y.center, disc.z.center);
      const glm::dvec3 half(disc.x.half_box, disc.y.half_box, disc.z.half_box);
      box.low = glm::min(box.low, glm::ivec3(glm::floor(center - half)) - MARGIN);
      box.high = glm::max(box.high, glm::ivec3(glm::ceil(center + half)) + MARGIN);
    }
    boxes.push_back(box);
  }
}

/// Leaves without a centre, of those listed once or more.
std::size_t centreless(const Octree& tree, std::vector<std::uint32_t> leaves) {
  std::sort(leaves.begin(), leaves.end());
  leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
  return static_cast<std::size_t>(std::count_if(leaves.begin(), leaves.end(), [&](std::uint32_t leaf) {
    return tree.leaves[leaf].begin == tree.leaves[leaf].end;
  }));
}

/// Leaves that hold a piece's centres; one that holds others' too counts by its share.
double centre_leaves(const Octree& tree, const Piece& piece) {
  const auto ends_before = [](const Leaf& leaf, std::size_t splat) { return leaf.end <= splat; };
  double count = 0.0;
  for (auto leaf = std::lower_bound(tree.leaves.begin(), tree.leaves.end(), piece.begin, ends_before);
       leaf != tree.leaves.end() && leaf->begin < piece.end; ++leaf) {
    const std::size_t begin = std::max<std::size_t>(leaf->begin, piece.begin);
    const std::size_t end = std::min<std::size_t>(leaf->end, piece.end);
    if (begin < end) count += static_cast<double>(end - begin) / (leaf->end - leaf->begin);
  }
  return count;
}

}  // namespace

PoolCounts estimate_counts(const SplatList& splats, std::uint32_t leaf_size) {
  const std::vector<Piece> pieces = sampled_pieces(splats.size());
  std::vector<OctreeBox> boxes;
  for (const Piece& piece : pieces) add_boxes(splats, piece, boxes);
  const Octree tree = build_octree_in(splats, leaf_size, boxes);
  std::vector<std::vector<std::uint32_t>> met(pieces.size());
  tbb::parallel_for(std::size_t{0}, pieces.size(), [&](std::size_t i) {
    met[i] = leaves_met(tree, splats, pieces[i].begin, pieces[i].end);
  });
  std::vector<std::uint32_t> all_met;
  std::size_t sampled = 0;
  double leaves = 0.0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    sampled += pieces[i].end - pieces[i].begin;
    leaves += centre_leaves(tree, pieces[i]);
    all_met.insert(all_met.end(), met[i].begin(), met[i].end());
  }
  const std::size_t references = all_met.size();
  leaves += static_cast<double>(centreless(tree, std::move(all_met)));
  const double factor = static_cast<double>(splats.size()) / static_cast<double>(sampled);
  const auto whole = [factor](double count) {
    return static_cast<std::size_t>(std::llround(factor * count));
  };
  constexpr double WORDS_PER_LEAF = 2.1;  // node words by filled leaf, on surfaces
  return {splats.size(), whole(static_cast<double>(references)),
          sampled == splats.size() ? tree.node_pool.size() : whole(WORDS_PER_LEAF * leaves), whole(leaves),
          (splats.color.empty() ? 0 : FEATURE_COLORS) | (splats.field.empty() ? 0 : FEATURE_FIELDS) |
              (splats.clip.empty() ? 0 : FEATURE_CLIPS)};
}

std::uint32_t choose_leaf_size(const SplatList& splats, Insertion insertion) {
  if (insertion == Insertion::centre) return 16;
  for (const std::uint32_t leaf_size : {16U, 24U})
    if (copies_fit(estimate_counts(splats, leaf_size))) return leaf_size;
  return 8;
}

}  // namespace splatray
