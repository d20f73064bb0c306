/// Which nodes of files in levels a picture takes: closed forms, and what must hold for any view.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "app/library/shot/level_cut.h"
#include "app/library/shot/scene_levels.h"

namespace splatray {
namespace {

/// The ground of a square of edge 1024: a full tree of nodes of `points` each, to this depth.
Levels ground(std::uint32_t depth, std::uint64_t points) {
  Levels levels{glm::dvec3(0.0), 1024.0, {{0, {0, 0, 0}, LevelNode::NO_PARENT, points, 0, 0}}};
  for (std::uint32_t i = 0; levels.nodes[i].level + 1 < depth; ++i)
    for (std::uint32_t child = 0; child < 4; ++child) {
      const glm::uvec3 cell = 2U * levels.nodes[i].cell + glm::uvec3(child & 1U, child >> 1U, 0);
      levels.nodes.push_back({levels.nodes[i].level + 1, cell, i, points, 0, 0});
    }
  return levels;
}

View from_above(double height, double ortho_height = 0.0) {
  Camera camera;
  camera.eye = {512.0, 512.0, height};
  camera.target = {512.0, 512.0, 0.0};
  camera.up = {0.0, 1.0, 0.0};
  camera.fov_y_deg = 53.13;
  camera.ortho_height = ortho_height;
  return {camera, 512, 512};
}

std::vector<std::uint32_t> cut(const Levels& levels, const LevelCut& how) {
  return cut_levels({levels}, how).nodes.front();
}

std::uint64_t points_of(const Levels& levels, const std::vector<std::uint32_t>& nodes) {
  std::uint64_t sum = 0;
  for (const std::uint32_t i : nodes) sum += levels.nodes[i].points;
  return sum;
}

/// Pixels of 2 units; above level l lie 100 (1/4 + ... + 1/4^l) points in a node's square.
TEST(LevelCut, OrthographicPicturesTakeWholeLevels) {
  const Levels levels = ground(7, 100);
  for (const double spacing : {0.5, 1.0, 2.0, 4.0, 8.0}) {
    std::size_t expected = 0;
    double above = 0.0;
    for (int level = 0; level < 7; ++level) {
      const double spacing_px = std::ldexp(1024.0, -level) / std::sqrt(above) / 2.0;
      if (!(spacing_px > spacing)) break;
      expected += std::size_t{1} << (2 * level);
      above = (above + 100.0) / 4.0;
    }
    EXPECT_GT(expected, 4U);
    EXPECT_EQ(cut(levels, {{from_above(500.0, 1024.0)}, spacing}).size(), expected) << spacing;
  }
}

TEST(LevelCut, WhatNoPictureSeesIsCoarser) {
  const Levels levels = ground(7, 100);
  View view = from_above(500.0, 1024.0);
  view.camera.eye.x = view.camera.target.x = 0.0;  // sees half of it
  const auto deepest = [&](const std::vector<std::uint32_t>& nodes, bool seen) {
    std::uint32_t level = 0;
    for (const std::uint32_t i : nodes) {
      const LevelNode& node = levels.nodes[i];
      const double low = std::ldexp(1024.0, -static_cast<int>(node.level)) * node.cell.x;
      if ((low <= 512.0) == seen) level = std::max(level, node.level);
    }
    return level;
  };
  const std::vector<std::uint32_t> nodes = cut(levels, {{view}, 2.0});
  EXPECT_EQ(deepest(nodes, true), deepest(nodes, false) + 3U);  // 8 times
  LevelCut mirrored{{view}, 2.0};
  mirrored.unseen_factor = 1.0;
  EXPECT_EQ(cut(levels, mirrored).size(), cut(levels, {{from_above(500.0, 1024.0)}, 2.0}).size());
}

TEST(LevelCut, PanoramasSeeAllAround) {
  const Levels levels = ground(7, 100);
  View view = from_above(20.0);
  view.camera.panorama = true;
  LevelCut all{{view}, 2.0};
  all.unseen_factor = 1.0;
  EXPECT_EQ(cut(levels, {{view}, 2.0}), cut(levels, all));
}

/// Each node taken has its parent; finer spacings, more pictures and more points take more.
TEST(LevelCut, CutsAreNested) {
  const Levels levels = ground(8, 50);
  std::mt19937 dice(7);
  std::uniform_real_distribution<double> place(-200.0, 1224.0), height(1.0, 600.0);
  for (int round = 0; round < 20; ++round) {
    View view = from_above(height(dice));
    view.camera.eye.x = place(dice);
    view.camera.eye.y = place(dice);
    const std::vector<std::uint32_t> some = cut(levels, {{view}, 4.0}), finer = cut(levels, {{view}, 2.0});
    const std::vector<std::uint32_t> both = cut(levels, {{view, from_above(100.0)}, 4.0});
    EXPECT_TRUE(std::includes(finer.begin(), finer.end(), some.begin(), some.end()));
    EXPECT_TRUE(std::includes(both.begin(), both.end(), some.begin(), some.end()));
    for (const std::uint32_t i : finer)
      EXPECT_TRUE(i == 0 || std::binary_search(finer.begin(), finer.end(), levels.nodes[i].parent));
    LevelCut less{{view}, 2.0};
    less.most_points = points_of(levels, finer) / 2;
    const std::vector<std::uint32_t> fewer = cut(levels, less);
    EXPECT_TRUE(std::includes(finer.begin(), finer.end(), fewer.begin(), fewer.end()));
    EXPECT_LE(points_of(levels, fewer), less.most_points);
    const double spacing = cut_levels({levels}, less).spacing_px;
    EXPECT_EQ(cut(levels, {{view}, spacing}), fewer) << "as by a wider spacing";
    EXPECT_GT(points_of(levels, cut(levels, {{view}, std::nextafter(spacing, 0.0)})), less.most_points);
    less.most_points = points_of(levels, finer);
    EXPECT_EQ(cut(levels, less), finer);
  }
}

/// Means stand for nodes that are not taken: they take memory, too.
TEST(LevelCut, MemoryHoldsPointsAndMeans) {
  Levels levels = ground(6, 100);
  LevelCut how{{from_above(500.0, 1024.0)}, 2.0};
  how.most_points = 10'000;
  const std::vector<std::uint32_t> points_alone = cut(levels, how);
  ASSERT_EQ(points_alone.size(), 85U) << "four levels of 100, 400, 1600 and 6400";
  for (LevelNode& node : levels.nodes)
    if (node.level > 0) node.means = 30;
  const auto loaded = [&](const std::vector<std::uint32_t>& nodes) {
    LoadCount count(levels);
    for (const std::uint32_t i : nodes) count.add(i);
    return count.sum();
  };
  // Means of the 256 nodes below the fourth level for its points; those of the first three levels are at its places.
  EXPECT_EQ(loaded(points_alone), 2100U + 256U * 30U);
  EXPECT_EQ(cut(levels, how), points_alone);
  how.most_points = 2100 + 256 * 30 - 1;
  const std::vector<std::uint32_t> fewer = cut(levels, how);
  EXPECT_EQ(fewer.size(), 21U);
  EXPECT_EQ(loaded(fewer), 500U + 64U * 30U);
  const std::uint64_t all = points_of(levels, cut(levels, {{from_above(500.0, 1024.0)}, 0.0}));
  std::vector<std::uint32_t> every(levels.nodes.size());
  for (std::uint32_t i = 0; i < every.size(); ++i) every[i] = i;
  EXPECT_EQ(loaded(every), all) << "no means where all is read";
}

TEST(ReadNote, SaysWhatDecidesHowMuchIsRead) {
  const InLevels files{{"ground"}, {ground(6, 1000)}};
  const std::vector<View> views = {from_above(600.0)};
  const auto note = [&](std::uint64_t memory) {
    Request request;
    request.source.lod = 4.0;
    request.source.memory_bytes = memory;
    return read_note(request, files, needed_nodes(request, views, files));
  };
  EXPECT_NE(note(0).find("as the pictures need"), std::string::npos) << note(0);
  EXPECT_NE(note(6'000'000).find("as memory holds"), std::string::npos) << note(6'000'000);
  EXPECT_NE(
      note(100).find("read 1000 of 1365000 points in levels, the coarsest level, which takes more memory"),
      std::string::npos)
      << note(100);
}

/// By rays through all pixels: where one meets the ground, the nodes there that are not taken have their points near enough above.
TEST(LevelCut, EveryPixelHasItsPoints) {
  const Levels levels = ground(9, 64);
  View view = from_above(80.0);
  view.camera.target += glm::dvec3(300.0, 100.0, 0.0);
  const std::vector<std::uint32_t> taken = cut(levels, {{view}, 1.0});
  ASSERT_LT(taken.size(), levels.nodes.size() / 4);
  const ImagePlane plane = image_plane(RootTransform{}, view);
  std::size_t met = 0;
  for (std::uint32_t y = 0; y < view.height; y += 7)
    for (std::uint32_t x = 0; x < view.width; x += 7) {
      const glm::dvec3 dir = plane.forward + plane.corner + (x + 0.5) * plane.dx + (y + 0.5) * plane.dy;
      const glm::dvec3 hit = plane.eye - plane.eye.z / dir.z * dir;
      if (!(dir.z < 0.0) || std::min(hit.x, hit.y) < 0.0 || std::max(hit.x, hit.y) >= 1024.0) continue;
      ++met;
      double per_area = 0.0;
      bool all = true;
      for (const std::uint32_t i : taken) {
        const LevelNode& node = levels.nodes[i];
        const double edge = std::ldexp(1024.0, -static_cast<int>(node.level));
        const glm::dvec2 low = edge * glm::dvec2(node.cell);
        if (hit.x < low.x || hit.y < low.y || hit.x >= low.x + edge || hit.y >= low.y + edge) continue;
        per_area += static_cast<double>(node.points) / (edge * edge);
        all = all && node.level + 1 < 9;
      }
      const double pixel = glm::length(plane.dy) * glm::distance(plane.eye, hit);
      EXPECT_TRUE(!all || 1.0 / std::sqrt(per_area) <= pixel) << x << " " << y;
    }
  EXPECT_GT(met, 1000U);
}

/// A window takes all nodes that its rays meet, down to the deepest, and none that lies beside it.
TEST(LevelCut, WindowsTakeAllTheyShow) {
  const Levels levels = ground(8, 64);
  View view = from_above(200.0);
  view.camera.target += glm::dvec3(90.0, 40.0, 0.0);
  view.window = {300, 120, 32, 24};
  LevelCut all{{view}, 0.0};
  all.unseen_factor = std::numeric_limits<double>::infinity();
  const std::vector<std::uint32_t> taken = cut(levels, all);
  const ImagePlane plane = image_plane(RootTransform{}, view);
  glm::dvec2 low(1024.0), high(0.0);
  for (const double y : {120.0, 144.0})
    for (const double x : {300.0, 332.0}) {
      const glm::dvec3 dir = plane.forward + plane.corner + x * plane.dx + y * plane.dy;
      const glm::dvec2 place = glm::dvec2(plane.eye - dir * (plane.eye.z / dir.z));
      low = glm::min(low, place);
      high = glm::max(high, place);
    }
  std::size_t deepest = 0;
  for (std::uint32_t i = 0; i < levels.nodes.size(); ++i) {
    const LevelNode& node = levels.nodes[i];
    const double edge = std::ldexp(1024.0, -static_cast<int>(node.level));
    const glm::dvec2 corner = edge * glm::dvec2(node.cell);
    const bool is_taken = std::binary_search(taken.begin(), taken.end(), i);
    // The ground's nodes are cubes: some that stand beside the window reach into it above the ground.
    const bool meets =
        corner.x < high.x && corner.y < high.y && corner.x + edge > low.x && corner.y + edge > low.y;
    const bool is_far = corner.x > high.x + 2.0 * edge || corner.y > high.y + 2.0 * edge ||
                        corner.x + 3.0 * edge < low.x || corner.y + 3.0 * edge < low.y;
    const glm::dvec2 middle = 0.5 * (low + high);
    const bool has_middle = corner.x < middle.x && middle.x < corner.x + edge && corner.y < middle.y &&
                            middle.y < corner.y + edge;
    EXPECT_TRUE(is_taken || !has_middle) << i;
    EXPECT_FALSE(is_taken && is_far) << i;
    if (is_taken && meets && node.level == 7) ++deepest;
  }
  EXPECT_GT(deepest, 1U);
  EXPECT_LT(taken.size(), levels.nodes.size() / 10);
}

}  // namespace
}  // namespace splatray
