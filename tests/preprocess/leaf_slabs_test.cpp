/// No leaf's slab or halves cut off anything that the leaf's discs have inside its cell.
#include "preprocess/tree/leaf_slabs.h"
#include "engine/scene/leaf/slab.h"
#include "engine/scene/leaf/slab_check.h"
#include "engine/scene/splat.h"
#include "engine/scene/tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/preprocess/shapes.h"

namespace splatray {
namespace {

/// Discs all over a sphere or a ball, as large as the object or a 1000th of it.
InputObject soup(bool ball, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::normal_distribution<float> gauss;
  InputObject object = test::random_sphere(1500, seed);
  for (std::size_t i = 0; i < object.points.size(); ++i) {
    if (ball) {
      object.points.position[i] *= unit(random);
      object.points.normal[i] = glm::normalize(glm::vec3(gauss(random), gauss(random), gauss(random)));
    }
    object.points.radius.push_back(static_cast<float>(std::pow(1000.0, -unit(random))));
  }
  return object;
}

Scene scene_of(InputObject object, std::uint32_t leaf_size, Insertion insertion) {
  BuildParams params;
  params.leaf_size = leaf_size;
  params.insertion = insertion;
  BuildStats stats;
  return build_scene(test::input_of(std::move(object)), params, 0, stats);
}

struct Tried {
  std::size_t inside = 0;    ///< points of discs inside their leaf's cell
  std::size_t cut_off = 0;   ///< of these, points that the leaf's slab leaves out
  std::size_t unlisted = 0;  ///< ... that lie in a half whose part of the list has not their splat
};

/// Random points of the inflated cell and of the disc's surroundings, dropped onto the disc's plane: those that lie on the
/// disc and in the inflated cell are tried. `place` is the splat's in the leaf's list.
void try_points(const Splat& splat, std::uint32_t place, const OctreeCell& cell, const Slab& slab,
                std::mt19937_64& random, Tried& tried) {
  const double half_size = 0.5 * cell.size;
  const double reach = half_size + LIST_INFLATION;
  const glm::dvec3 center = glm::dvec3(cell.low) + half_size;
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 16; ++i) {
    const glm::dvec3 offset(unit(random), unit(random), unit(random));
    glm::dvec3 point =
        i % 2 == 0 ? center + reach * offset : splat.center + std::sqrt(splat.radius_squared) * offset;
    point -= glm::dot(point - splat.center, splat.normal) * splat.normal;
    const glm::dvec3 from_disc = point - splat.center;
    if (glm::dot(from_disc, from_disc) > splat.radius_squared) continue;
    if (glm::any(glm::greaterThan(glm::abs(point - center), glm::dvec3(reach)))) continue;
    const double height = glm::dot(slab.axis, point - center);
    ++tried.inside;
    if (height < slab.low * half_size - LIST_INFLATION || height > slab.high * half_size + LIST_INFLATION)
      ++tried.cut_off;
    const double across = (point - center)[halved_axis(slab.axis)];
    if (across < 0.0 ? place >= slab.lower_end : place < slab.upper_begin) ++tried.unlisted;
  }
}

Tried tried_points(const Scene& scene) {
  std::mt19937_64 random(7);
  Tried tried;
  const std::vector<OctreeCell> cells = leaf_cells(scene);
  for (std::size_t leaf = 0; leaf < cells.size(); ++leaf) {
    const std::uint32_t begin = scene.begin_end[leaf], end = scene.begin_end[leaf + 1];
    const Slab slab = unpack_slab(scene.slab_pool[leaf], end - begin);
    for (std::uint32_t i = begin; i < end; ++i)
      try_points(unpack_splat(scene.data_pool[scene.reference_pool[i]]), i - begin, cells[leaf], slab, random,
                 tried);
  }
  return tried;
}

/// What find_slab_defect finds; empty where it finds nothing.
std::string found_in_slabs(const Scene& scene) {
  const auto defect = find_slab_defect(scene);
  return defect ? defect->found : "";
}

TEST(LeafSlabs, HoldWhatDiscsHaveInTheCell) {
  for (const Insertion insertion : {Insertion::overlap, Insertion::probe, Insertion::centre}) {
    for (const std::uint32_t leaf_size : {1U, 4U, 10U, 40U, 2000U}) {
      for (const bool ball : {false, true}) {
        const Scene scene = scene_of(soup(ball, leaf_size), leaf_size, insertion);
        const Tried tried = tried_points(scene);
        EXPECT_GT(tried.inside, scene.data_pool.size());
        EXPECT_EQ(found_in_slabs(scene), "");
        EXPECT_EQ(tried.cut_off, 0U) << "leaf size " << leaf_size << ", policy " << int(insertion);
        EXPECT_EQ(tried.unlisted, 0U) << "leaf size " << leaf_size << ", policy " << int(insertion);
      }
    }
  }
}

TEST(LeafSlabs, AThinnerSlabIsNoticed) {
  Scene scene = scene_of(soup(true, 1), 10, Insertion::overlap);
  for (std::uint32_t& word : scene.slab_pool.edit()) {
    Slab slab = unpack_slab(word, 1);
    slab.low = slab.high = std::min(0.5 * (slab.low + slab.high), 1.0);
    word = pack_slab(slab, 1);
  }
  EXPECT_GT(tried_points(scene).cut_off, 1000U);
  EXPECT_NE(found_in_slabs(scene).find("slab leaves out"), std::string::npos);
}

TEST(LeafSlabs, AShorterHalfIsNoticed) {
  const Scene scene = scene_of(soup(true, 1), 10, Insertion::overlap);
  EXPECT_EQ(tried_points(scene).unlisted, 0U);
  Scene lower = scene, upper = scene;
  for (std::uint32_t& word : lower.slab_pool.edit()) word &= ~0x0F000000U;
  for (std::uint32_t& word : upper.slab_pool.edit()) word |= 0xF0000000U;
  EXPECT_GT(tried_points(lower).unlisted, 1000U);
  EXPECT_GT(tried_points(upper).unlisted, 1000U);
  EXPECT_NE(found_in_slabs(lower).find("lower half leaves out"), std::string::npos);
  EXPECT_NE(found_in_slabs(upper).find("upper half leaves out"), std::string::npos);
}

TEST(LeafSlabs, HalvesShortenListsOnASmoothSurface) {
  const Scene scene = scene_of(test::even_sphere(20000), 10, Insertion::overlap);
  std::size_t listed = 0, halves = 0;
  for (std::size_t leaf = 0; leaf < scene.slab_pool.size(); ++leaf) {
    const std::uint32_t count = scene.begin_end[leaf + 1] - scene.begin_end[leaf];
    const Slab slab = unpack_slab(scene.slab_pool[leaf], count);
    listed += count;
    halves += slab.lower_end + count - slab.upper_begin;
  }
  EXPECT_LT(static_cast<double>(halves) / 2.0, 0.75 * static_cast<double>(listed));
}

TEST(LeafSlabs, AreThinOnASmoothSurface) {
  const Scene scene = scene_of(test::even_sphere(20000), 10, Insertion::overlap);
  double thickness = 0.0;
  for (const std::uint32_t word : scene.slab_pool) {
    const Slab slab = unpack_slab(word, 1);
    thickness += (slab.high - slab.low) / glm::length(slab.axis);
  }
  EXPECT_LT(thickness / static_cast<double>(scene.slab_pool.size()), 0.08) << "in units of half a cell";
}

TEST(LeafSlabs, PackingTurnsOutwards) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 1000; ++i) {
    const double a = unit(random), b = unit(random);
    const auto listed = static_cast<std::uint32_t>(1 + random() % 100);
    const auto p = static_cast<std::uint32_t>(random() % (listed + 1)), q = listed - p;
    const glm::dvec3 direction(unit(random), unit(random), unit(random));
    const Slab slab{nearest_slab_axis(direction), std::min(a, b), std::max(a, b), std::max(p, q),
                    std::min(p, q)};
    const Slab packed = unpack_slab(pack_slab(slab, listed), listed);
    EXPECT_EQ(packed.axis, slab.axis);
    EXPECT_LE(packed.low, slab.low);
    EXPECT_GE(packed.high, slab.high);
    EXPECT_LE(packed.high - packed.low,
              std::max(1.25 * (slab.high - slab.low + 1.0 / SLAB_SCALE), 1.0 / SLAB_THINNEST) + 1e-12);
    EXPECT_GE(packed.lower_end, slab.lower_end);
    EXPECT_LE(packed.upper_begin, slab.upper_begin);
    EXPECT_LT(packed.lower_end - slab.lower_end, (listed + 15) / 16);
    EXPECT_LT(slab.upper_begin - packed.upper_begin, (listed + 15) / 16);
    EXPECT_NEAR(std::abs(packed.axis.x) + std::abs(packed.axis.y) + std::abs(packed.axis.z), 1.0, 1e-12);
    EXPECT_GE(packed.axis.x, 0.0);
    EXPECT_GT(std::abs(glm::dot(glm::normalize(packed.axis), glm::normalize(direction))), 0.998);
    EXPECT_EQ(nearest_slab_axis(packed.axis), packed.axis);
  }
  const Slab full = unpack_slab(SLAB_FULL, 1000);
  EXPECT_EQ(full.axis, glm::dvec3(0.0, 0.0, 1.0));
  EXPECT_LE(full.low, -1.0);
  EXPECT_GE(full.high, 1.0);
  EXPECT_EQ(full.lower_end, 1000U);
  EXPECT_EQ(full.upper_begin, 0U);
}

TEST(LeafSlabs, HalvesLieAcrossTheAxisLeastAlongTheSlab) {
  EXPECT_EQ(halved_axis({0.2, 0.5, -0.3}), 0);
  EXPECT_EQ(halved_axis({0.5, -0.2, 0.3}), 1);
  EXPECT_EQ(halved_axis({-0.4, 0.5, 0.1}), 2);
  EXPECT_EQ(halved_axis({0.25, -0.25, 0.5}), 0) << "x before y";
  EXPECT_EQ(halved_axis({0.5, 0.25, 0.25}), 1) << "y before z";
}

}  // namespace
}  // namespace splatray
