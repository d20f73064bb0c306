/// Leaf lists against an exact disc-box test over all pairs of leaf and splat, and the order of the three
/// policies.
#include "preprocess/tree/insertion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <span>

#include "engine/base/error.h"
#include "engine/scene/clip.h"
#include "engine/scene/splat.h"
#include "preprocess/base/morton.h"
#include "preprocess/tree/long_lists.h"
#include "tests/preprocess/shapes.h"

namespace splatray {
namespace {

const Stage STAGE{"insertion", test::SILENT};

/// Keeps the part of a convex polygon where sign * p[axis] <= limit.
std::vector<glm::dvec3> clipped(const std::vector<glm::dvec3>& polygon, int axis, double sign, double limit) {
  std::vector<glm::dvec3> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3& here = polygon[i];
    const glm::dvec3& next = polygon[(i + 1) % polygon.size()];
    const double a = sign * here[axis] - limit;
    const double b = sign * next[axis] - limit;
    if (a <= 0.0) kept.push_back(here);
    if ((a <= 0.0) != (b <= 0.0)) kept.push_back(here + (next - here) * (a / (a - b)));
  }
  return kept;
}

double distance_to_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const double length_squared = glm::dot(b - a, b - a);
  const double t = length_squared > 0.0 ? std::clamp(glm::dot(p - a, b - a) / length_squared, 0.0, 1.0) : 0.0;
  return glm::length(p - a - (b - a) * t);
}

/// Whether a disc, or one that is `aspect` times less wide along `narrow`, meets a box: the part of its plane in the box is
/// a polygon; its distance from the centre, measured as the ellipse has it, decides.
bool disc_meets_box(const Splat& splat, const glm::dvec3& low, const glm::dvec3& high,
                    const glm::dvec3& narrow = glm::dvec3(0.0), double aspect = 1.0) {
  const glm::dvec3& c = splat.center;
  if (glm::all(glm::lessThanEqual(low, c)) && glm::all(glm::lessThanEqual(c, high))) return true;
  const double radius = std::sqrt(splat.radius_squared);
  const glm::dvec3 side = std::abs(splat.normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = radius * glm::normalize(glm::cross(splat.normal, side));
  const glm::dvec3 v = glm::cross(splat.normal, u);
  std::vector<glm::dvec3> polygon{c + u + v, c - u + v, c - u - v, c + u - v};
  for (int axis = 0; axis < 3; ++axis) {
    polygon = clipped(polygon, axis, 1.0, high[axis]);
    polygon = clipped(polygon, axis, -1.0, -low[axis]);
  }
  for (glm::dvec3& corner : polygon) corner += narrow * ((aspect - 1.0) * glm::dot(narrow, corner - c));
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    if (distance_to_segment(c, polygon[i], polygon[(i + 1) % polygon.size()]) <= radius) return true;
  }
  return false;
}

/// Splats of a bumpy closed surface, of radii between `least` and `most` lattice units.
SplatList surface_splats(std::size_t count, double least, double most) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  SplatList splats;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = gauss(random), y = gauss(random),
                 x = gauss(random);  // in this order with every compiler
    const glm::dvec3 normal = glm::normalize(glm::dvec3(x, y, z));
    const double radius = least * std::pow(most / least, unit(random));
    const glm::dvec3 center =
        glm::round(1048576.0 + normal * (700000.0 + 20000.0 * std::sin(9.0 * normal.x)));
    splats.words.push_back(
        pack_splat({center, i % 7 == 0 ? glm::dvec3(0, 0, 1) : normal, radius * radius, 0}));
    splats.key.push_back(morton_key(glm::uvec3(center)));
  }
  order_splats(splats, 10);
  return splats;
}

std::span<const std::uint32_t> list_of(const LeafLists& lists, std::size_t leaf) {
  return std::span(lists.splat).subspan(lists.begin[leaf], lists.begin[leaf + 1] - lists.begin[leaf]);
}

/// No disc is missing from a leaf's list that comes clearly within LIST_INFLATION of its cell, and none listed that clearly
/// does not.
void check_against_exact(const SplatList& splats) {
  constexpr double CLEARLY = 1e-6;
  const Octree tree = build_octree(splats, 4);
  const LeafLists lists = insert_overlaps(tree, splats, STAGE);
  std::size_t missing = 0;
  std::size_t needless = 0;
  for (std::size_t leaf = 0; leaf < tree.leaves.size(); ++leaf) {
    const glm::dvec3 low(morton_point(tree.leaves[leaf].key));
    const glm::dvec3 high = low + static_cast<double>(tree.leaves[leaf].cell_size());
    const auto list = list_of(lists, leaf);
    EXPECT_TRUE(std::is_sorted(list.begin(), list.end()));
    for (std::uint32_t i = 0; i < splats.size(); ++i) {
      const auto meets = [&](double inflation) {
        return disc_meets_box(unpack_splat(splats.words[i]), low - inflation, high + inflation);
      };
      const bool is_listed = std::binary_search(list.begin(), list.end(), i);
      missing += !is_listed && meets(LIST_INFLATION - CLEARLY) ? 1 : 0;
      needless += is_listed && !meets(LIST_INFLATION + CLEARLY) ? 1 : 0;
    }
  }
  EXPECT_EQ(missing, 0U);
  EXPECT_EQ(needless, 0U);
}

TEST(Insertion, OverlapListsDiscsOfTypicalSize) {
  check_against_exact(surface_splats(800, 20000.0, 80000.0));
}

TEST(Insertion, OverlapListsTinyAndHugeDiscs) { check_against_exact(surface_splats(400, 1.5, 250000.0)); }

TEST(Insertion, GrowthThatNoOneWantsIsRefused) {
  SplatList splats;  // of a plane: each disc covers a fifth of it
  for (unsigned x = 0; x < 150; ++x)
    for (unsigned y = 0; y < 150; ++y) {
      const glm::dvec3 center(450000.0 + 7900.0 * x, 450000.0 + 7900.0 * y, 1048577.0);
      splats.words.push_back(pack_splat({center, {0, 0, 1}, 4e5 * 4e5, 0}));
      splats.key.push_back(morton_key(glm::uvec3(center)));
    }
  order_splats(splats, 10);
  try {
    static_cast<void>(insert_overlaps(build_octree(splats, 4), splats, STAGE));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find("--radius-scale"), std::string::npos);
  }
}

TEST(Insertion, OverlapListsDiscsAtTheDepthCap) {
  SplatList splats;
  std::mt19937_64 random(6);
  for (int i = 0; i < 300; ++i) {
    const glm::uvec3 center(1048570U + random() % 40, 1048570U + random() % 40, 1048570U + random() % 40);
    const glm::dvec3 normal = glm::normalize(glm::dvec3(random() % 7, random() % 7, 1 + random() % 7));
    splats.words.push_back(
        pack_splat({glm::dvec3(center), normal, 2.0 + static_cast<double>(random() % 50), 0}));
    splats.key.push_back(morton_key(center));
  }
  order_splats(splats, 10);
  check_against_exact(splats);
}

TEST(Insertion, OverlapListsEllipsesByTheirSides) {
  SplatList splats = surface_splats(800, 100000.0, 300000.0);
  const Octree tree = build_octree(splats, 4);
  const std::size_t of_discs = insert_overlaps(tree, splats, STAGE).splat.size();
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const uvec4& words : splats.words) {
    const double z = unit(random), y = unit(random), x = unit(random);  // in this order with every compiler
    const glm::dvec3 dir = glm::normalize(glm::cross(unpack_splat(words).normal, glm::dvec3(x, y, z)));
    splats.clip.push_back(pack_ellipse(words, dir, std::exp2(3.0 + 2.0 * unit(random))));
  }
  const LeafLists lists = insert_overlaps(tree, splats, STAGE);
  std::size_t missing = 0, needless = 0;
  for (std::size_t leaf = 0; leaf < tree.leaves.size(); ++leaf) {
    const glm::dvec3 low(morton_point(tree.leaves[leaf].key));
    const glm::dvec3 high = low + static_cast<double>(tree.leaves[leaf].cell_size());
    const auto list = list_of(lists, leaf);
    for (std::uint32_t i = 0; i < splats.size(); ++i) {
      const Splat splat = unpack_splat(splats.words[i]);
      const Ellipse ellipse = unpack_ellipse(splats.clip[i], splats.words[i]);
      const glm::dvec3 narrow = ellipse.across - splat.normal * glm::dot(splat.normal, ellipse.across);
      const double squared = glm::dot(narrow, narrow);
      const bool meets =
          disc_meets_box(splat, low - (LIST_INFLATION - 1e-6), high + (LIST_INFLATION - 1e-6),
                         narrow / std::sqrt(squared), std::sqrt(1.0 + ellipse.factor * squared));
      const bool is_listed = std::binary_search(list.begin(), list.end(), i);
      missing += meets && !is_listed ? 1 : 0;
      needless += is_listed && !meets ? 1 : 0;
    }
  }
  EXPECT_EQ(missing, 0U);
  EXPECT_LT(5 * needless, 2 * lists.splat.size()) << "of " << lists.splat.size();
  EXPECT_LT(3 * lists.splat.size(), 2 * of_discs) << "lists as long as those of whole discs";
}

TEST(Insertion, PoliciesAreNested) {
  const SplatList splats = surface_splats(3000, 10000.0, 40000.0);
  const Octree tree = build_octree(splats, 10);
  const LeafLists centres = insert_centres(tree, splats);
  const LeafLists overlaps = insert_overlaps(tree, splats, STAGE);
  const LeafLists probed = keep_probed(tree, splats, overlaps, 32, 1, STAGE);
  for (std::size_t leaf = 0; leaf < tree.leaves.size(); ++leaf) {
    const auto centre = list_of(centres, leaf);
    const auto probe = list_of(probed, leaf);
    const auto overlap = list_of(overlaps, leaf);
    EXPECT_TRUE(std::includes(probe.begin(), probe.end(), centre.begin(), centre.end()));
    EXPECT_TRUE(std::includes(overlap.begin(), overlap.end(), probe.begin(), probe.end()));
  }
  EXPECT_GT(probed.splat.size(), centres.splat.size());
  EXPECT_LT(probed.splat.size(), overlaps.splat.size());
}

TEST(Insertion, ProbesDependOnTheSeedAndMoreOfThemKeepMore) {
  const SplatList splats = surface_splats(3000, 10000.0, 40000.0);
  const Octree tree = build_octree(splats, 10);
  const LeafLists overlaps = insert_overlaps(tree, splats, STAGE);
  const auto kept = [&](std::uint32_t probes, std::uint64_t seed) {
    return keep_probed(tree, splats, overlaps, probes, seed, STAGE).splat;
  };
  EXPECT_EQ(kept(32, 1), kept(32, 1));
  EXPECT_NE(kept(32, 1), kept(32, 2));
  EXPECT_LT(kept(4, 1).size(), kept(32, 1).size());
}

TEST(Insertion, ProbesFillALeafThatHoldsNoCentre) {
  SplatList splats;
  const glm::uvec3 center(1048576U + 2000U, 1048576U + 2000U, 1048576U + 300000U);
  for (int i = 0; i < 2;
       ++i) {  // two splats, one a leaf: the root is divided; the first disc reaches into empty cells
    const glm::uvec3 place = i == 0 ? center : glm::uvec3(100000, 100000, 100000);
    splats.words.push_back(pack_splat({glm::dvec3(place), {0.0, 0.0, 1.0}, i == 0 ? 4e11 : 4.0, 0}));
    splats.key.push_back(morton_key(place));
  }
  order_splats(splats, 10);
  const Octree tree = build_octree(splats, 1);
  const LeafLists probed = keep_probed(tree, splats, insert_overlaps(tree, splats, STAGE), 32, 1, STAGE);
  std::size_t filled = 0;
  for (std::size_t leaf = 0; leaf < tree.leaves.size(); ++leaf)
    filled += list_of(probed, leaf).empty() ? 0 : 1;
  EXPECT_EQ(filled, 5U);
}

/// A sheet whose discs touch a plane between cells, all centres on one side of it.
SplatList sheet_below(std::uint32_t height, std::size_t count) {
  std::mt19937_64 random(3);
  std::uniform_int_distribution<std::uint32_t> within(300000, 1800000);
  SplatList splats;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::uvec3 center(within(random), within(random), height);
    splats.words.push_back(pack_splat({glm::dvec3(center), {0.0, 0.0, 1.0}, 1e8, 0}));
    splats.key.push_back(morton_key(center));
  }
  order_splats(splats, 8);
  return splats;
}

std::size_t longest(const LeafLists& lists) {
  std::size_t most = 0;
  for (std::size_t leaf = 0; leaf + 1 < lists.begin.size(); ++leaf)
    most = std::max<std::size_t>(most, list_of(lists, leaf).size());
  return most;
}

TEST(LongLists, AreDividedOnTheOtherSideOfASheet) {
  const SplatList splats = sheet_below((1U << 20) - 2, 20000);
  const Octree tree = build_octree(splats, 16);
  const LeafLists lists = insert_overlaps(tree, splats, STAGE);
  ASSERT_GT(longest(lists), 1000U);
  const std::vector<CellName> divided = find_long_lists(tree, lists, splats, 16);
  EXPECT_TRUE(std::is_sorted(divided.begin(), divided.end()));
  const LeafLists after = insert_overlaps(build_octree(splats, 16, divided), splats, STAGE);
  EXPECT_LE(longest(after), 64U);
  EXPECT_LT(after.splat.size(), 2 * lists.splat.size());
}

TEST(LongLists, AreFewEnoughBesideNoSheet) {
  const SplatList splats = sheet_below((1U << 20) - 40000, 20000);
  const Octree tree = build_octree(splats, 16);
  EXPECT_TRUE(find_long_lists(tree, insert_overlaps(tree, splats, STAGE), splats, 16).empty());
}

TEST(LongLists, OfSplatsThatAreWideStay) {
  const SplatList splats = surface_splats(3000, 300000.0, 400000.0);
  const Octree tree = build_octree(splats, 16);
  const LeafLists lists = insert_overlaps(tree, splats, STAGE);
  ASSERT_GT(longest(lists), 128U);
  EXPECT_TRUE(find_long_lists(tree, lists, splats, 16).empty());
}

}  // namespace
}  // namespace splatray
