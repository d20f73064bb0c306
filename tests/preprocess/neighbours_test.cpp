/// The neighbour search against brute force over all points, in order and ties too.
#include "preprocess/surface/neighbours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "preprocess/surface/near_places.h"
#include "tests/preprocess/shapes.h"

namespace splatray {
namespace {

std::vector<Neighbour> brute_force(const Cloud& cloud, const glm::vec3& query, std::size_t count) {
  std::vector<Neighbour> all;
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    const glm::vec3 d = cloud.coord[i] - query;
    const float squared = d.x * d.x + d.y * d.y + d.z * d.z;
    const bool first_of_place = i == 0 || cloud.coord[i] != cloud.coord[i - 1];
    if (squared > 0.0F && first_of_place) all.emplace_back(squared, i);
  }
  std::sort(all.begin(), all.end());
  all.resize(std::min(count, all.size()));
  return all;
}

void expect_same_for_all(const Cloud& cloud, const NeighbourSearch& search, std::size_t wanted) {
  const Progress silent;
  std::vector<std::vector<Neighbour>> all(cloud.size());
  search.find_all(wanted, {"neighbours", silent},
                  [&](std::uint32_t point, std::span<const Neighbour> nearest) {
                    all[point].assign(nearest.begin(), nearest.end());
                  });
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    std::vector<Neighbour> found(wanted);
    found.resize(search.find(cloud.coord[i], found));
    ASSERT_EQ(all[i], found) << "point " << i << ", " << wanted << " neighbours";
  }
}

void expect_same_as_brute_force(const Cloud& cloud, std::size_t stride) {
  const NeighbourSearch search(cloud, Sites::positions);
  for (const std::size_t wanted : {1U, 6U, 12U, 32U}) {
    expect_same_for_all(cloud, search, wanted);
    for (std::size_t i = 0; i < cloud.size(); i += stride) {
      std::vector<Neighbour> found(wanted);
      found.resize(search.find(cloud.coord[i], found));
      ASSERT_EQ(found, brute_force(cloud, cloud.coord[i], wanted))
          << "point " << i << ", " << wanted << " neighbours";
    }
  }
}

/// All sites within the limit of each query, or the nearest `count`.
void expect_each_as_brute_force(const Cloud& cloud, std::size_t count, float limit_squared,
                                float guess_share) {
  const NeighbourSearch search(cloud, Sites::positions);
  const Progress silent;
  std::vector<std::vector<Neighbour>> all(cloud.size());
  search.find_each(
      cloud.size(),
      [&](std::uint32_t i) -> NeighbourSearch::Query {
        return {cloud.coord[i], guess_share * limit_squared, limit_squared};
      },
      count, {"neighbours", silent},
      [&](std::uint32_t i, std::span<Neighbour> nearest) { all[i].assign(nearest.begin(), nearest.end()); });
  for (std::uint32_t i = 0; i < cloud.size(); i += 61) {
    std::vector<Neighbour> expected = brute_force(cloud, cloud.coord[i], count);
    while (!expected.empty() && expected.back().distance_squared() > limit_squared) expected.pop_back();
    std::sort(all[i].begin(), all[i].end());
    ASSERT_EQ(all[i], expected) << "point " << i << ", " << count << " neighbours within " << limit_squared
                                << ", a guess of " << guess_share;
  }
}

TEST(Neighbours, EachWithinItsLimit) {
  const Cloud sphere = test::cloud_of(test::random_sphere(3001, 6));
  const Cloud lattice = test::cloud_of(test::square_lattice(40, 0.125));
  for (const float limit_squared : {0.0004F, 0.01F, 0.5F, 1e9F}) {
    for (const float guess_share : {0.01F, 1.0F}) {
      for (const std::size_t count : {1U, 32U, 96U}) {
        expect_each_as_brute_force(sphere, count, limit_squared, guess_share);
        expect_each_as_brute_force(lattice, count, limit_squared, guess_share);
      }
    }
  }
}

TEST(Neighbours, RandomSphere) {
  expect_same_as_brute_force(test::cloud_of(test::random_sphere(3001, 1)), 13);
}

TEST(Neighbours, LatticeFullOfTies) {
  expect_same_as_brute_force(test::cloud_of(test::square_lattice(50, 0.125)), 17);
}

TEST(Neighbours, VeryUnevenDensity) {
  InputObject object;
  std::mt19937_64 random(3);
  std::normal_distribution<double> gauss;
  for (int i = 0; i < 2000; ++i) {
    const double scale = std::exp(3.0 * gauss(random));
    object.points.position.push_back(scale * glm::dvec3(gauss(random), gauss(random), gauss(random)));
  }
  expect_same_as_brute_force(test::cloud_of(object), 11);
}

TEST(Neighbours, CopiesOfAPointCountOnce) {
  InputObject object = test::random_sphere(200, 4);
  for (int copy = 0; copy < 50; ++copy) object.points.position.push_back(object.points.position[7]);
  object.points.normal.clear();
  expect_same_as_brute_force(test::cloud_of(object), 1);
}

TEST(Neighbours, FewerPointsThanWanted) {
  const Cloud cloud = test::cloud_of(test::random_sphere(3, 5));
  std::vector<Neighbour> found(8);
  EXPECT_EQ(NeighbourSearch(cloud, Sites::positions).find(cloud.coord[0], found), 2U);
  EXPECT_EQ(NeighbourSearch(Cloud(), Sites::positions).find(glm::vec3(0.0F), found), 0U);
  const Progress silent;
  const auto query = [](std::uint32_t) -> NeighbourSearch::Query { return {glm::vec3(0.0F), 0.25F, 1.0F}; };
  const auto visit = [](std::uint32_t, std::span<Neighbour> nearest) { EXPECT_TRUE(nearest.empty()); };
  const Cloud empty;
  NeighbourSearch(empty, Sites::positions).find_each(3, query, 8, {"neighbours", silent}, visit);
}

TEST(Neighbours, OrientedPlacesKeepDifferentNormals) {
  InputObject object;
  for (int i = 0; i < 20; ++i) {
    object.points.position.emplace_back(1.0, 0.0, 0.0);
    object.points.normal.emplace_back(0.0F, 1.0F, static_cast<float>(i % 3));
  }
  object.points.position.emplace_back(0.0, 0.0, 0.0);
  object.points.normal.emplace_back(1.0F, 0.0F, 0.0F);
  const Cloud cloud = test::cloud_of(object);
  std::vector<Neighbour> found(8);
  const glm::vec3 origin = cloud.coord[0].x < cloud.coord[20].x ? cloud.coord[0] : cloud.coord[20];
  EXPECT_EQ(NeighbourSearch(cloud, Sites::positions).find(origin, found), 1U);
  EXPECT_EQ(NeighbourSearch(cloud, Sites::oriented_positions).find(origin, found), 3U);
}

TEST(Neighbours, WhatIsLeftIsFoundAsIfItHadBeenAlone) {
  const Cloud all = test::cloud_of(test::random_sphere(3001, 8));
  NeighbourSearch search(all, Sites::positions);
  std::vector<std::uint32_t> number(all.size(), NO_CELL);
  Cloud left;
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    if (i % 7 == 3 || (i > 100 && i < 140)) continue;
    number[i] = static_cast<std::uint32_t>(left.size());
    left.coord.push_back(all.coord[i]);
  }
  search.keep(number);
  for (const std::size_t wanted : {1U, 12U, 32U}) {
    expect_same_for_all(left, search, wanted);
    for (std::size_t i = 0; i < left.size(); i += 13) {
      std::vector<Neighbour> found(wanted);
      found.resize(search.find(left.coord[i], found));
      ASSERT_EQ(found, brute_force(left, left.coord[i], wanted));
    }
  }
}

TEST(Neighbours, ListsAreWhatTheSearchFinds) {
  const Cloud cloud = test::cloud_of(test::random_sphere(700, 9));
  NearPlaces near(cloud);
  const Progress silent;
  near.search().find_all(NearPlaces::LISTED, {"neighbours", silent},
                         [&](std::uint32_t i, std::span<const Neighbour> nearest) { near.list(i, nearest); });
  std::vector<std::uint32_t> number(cloud.size(), NO_CELL), kept;
  Cloud left;
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    if (i % 50 == 7) continue;
    number[i] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(i);
    left.coord.push_back(cloud.coord[i]);
  }
  const auto expect_same = [&](const Cloud& in) {
    for (std::uint32_t i = 0; i < in.size(); ++i) {
      std::array<Neighbour, NearPlaces::LISTED> store;
      const auto found = near.find(in, i, store);
      ASSERT_EQ(std::vector<Neighbour>(found.begin(), found.end()),
                brute_force(in, in.coord[i], NearPlaces::LISTED));
    }
  };
  expect_same(cloud);
  near.keep(left, kept, number);
  expect_same(left);
}

}  // namespace
}  // namespace splatray
