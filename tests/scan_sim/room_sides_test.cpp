// Sides where nothing says where the scanner was: bodies that look like rooms by their planes, rooms by what they enclose.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "engine/scene/splat.h"
#include "tests/all_tests.h"
#include "tests/scan_sim/built_scan.h"

namespace splatray::testing {
namespace {

/// Points with the side that was seen.
struct SeenPoints {
  Points points;
  std::vector<glm::dvec3> normal;

  double step = 0.04;  ///< between points

  /// A rectangle from a corner along two edges, a point every step or so, but for those that `hidden` says; seen from the side that
  /// cross(a, b) looks to.
  void add(const glm::dvec3& corner, const glm::dvec3& a, const glm::dvec3& b,
           const std::function<bool(const glm::dvec3&)>& hidden = {}) {
    std::uniform_real_distribution<double> jitter(0.1, 0.9);
    const double length_a = glm::length(a), length_b = glm::length(b);
    for (double s = 0.0; s < length_a; s += step)
      for (double t = 0.0; t < length_b; t += step) {
        const glm::dvec3 place = corner + a * ((s + step * jitter(random_)) / length_a) +
                                 b * ((t + step * jitter(random_)) / length_b);
        if (hidden && hidden(place)) continue;
        points.position.push_back(place);
        normal.push_back(glm::normalize(glm::cross(a, b)));
      }
  }
  /// The four upright sides of a box; `out`: seen from outside, else from inside.
  void add_walls(const glm::dvec3& low, const glm::dvec3& high, bool out,
                 const std::function<bool(const glm::dvec3&)>& hidden = {}) {
    const glm::dvec3 up(0, 0, high.z - low.z), along(high.x - low.x, 0, 0), across(0, high.y - low.y, 0);
    const auto wall = [&](const glm::dvec3& corner, const glm::dvec3& a) {
      out ? add(corner, a, up, hidden) : add(corner, up, a, hidden);
    };
    wall(low, along), wall(low + along, across);
    wall(low + along + across, -along), wall(low + across, -across);
  }
  void add_ball(const glm::dvec3& middle, double radius, int count) {
    std::normal_distribution<double> gauss;
    for (int i = 0; i < count; ++i) {
      const glm::dvec3 out = glm::normalize(glm::dvec3(gauss(random_), gauss(random_), gauss(random_)));
      points.position.push_back(middle + radius * out);
      normal.push_back(out);
    }
  }

 private:
  std::mt19937_64 random_{9};
};

/// Adds the lower half of an ellipsoid, its points even on it; `out`: seen from outside, else from inside.
void add_lower_half(const glm::dvec3& half_size, double step, bool out, SeenPoints& seen) {
  constexpr double GOLDEN = 2.399963;  // radians between neighbours of a sunflower
  const double mean = (half_size.x + half_size.y + half_size.z) / 3.0;
  const int count = static_cast<int>(2.0 * std::numbers::pi * mean * mean / (step * step));
  for (int i = 0; i < count; ++i) {
    const double z = -(i + 0.5) / count, across = std::sqrt(1.0 - z * z);
    const glm::dvec3 unit(across * std::cos(GOLDEN * i), across * std::sin(GOLDEN * i), z);
    seen.points.position.push_back(half_size * unit);
    const glm::dvec3 normal = glm::normalize(unit / half_size);
    seen.normal.push_back(out ? normal : -normal);
  }
}

/// The share of right sides, in a format that promises `up`, or nothing.
double right_sides(const SeenPoints& seen, const std::optional<glm::dvec3>& up = glm::dvec3(0.0, 0.0, 1.0)) {
  const BuiltScan built = build_scan(seen.points, {}, 0, up);
  double right = 0.0;
  for (std::size_t s = 0; s < built.scene.data_pool.size(); ++s)
    right += glm::dot(glm::dvec3(unpack_splat(built.scene.data_pool[s]).normal),
                      seen.normal[number_of(built.scene, s)]) > 0.0
                 ? 1.0
                 : 0.0;
  return right / static_cast<double>(built.scene.data_pool.size());
}

TEST(RoomSides, AStatuesPlinthIsNoRoom) {
  SeenPoints seen;
  seen.step = 0.02;  // a ball of 0.9 m is more than a few points across
  seen.add_walls({-0.6, -0.6, 0.0}, {0.6, 0.6, 1.0}, /*out=*/true);
  seen.add({-0.6, -0.6, 1.0}, {1.2, 0, 0}, {0, 1.2, 0});
  seen.add_ball({0.0, 0.0, 1.5}, 0.45, 9000);
  EXPECT_GT(right_sides(seen), 0.97);
}

/// A format that says no up direction has a statue as its program writes it, y up or z.
TEST(RoomSides, AStatueOfUnknownUpIsNoRoom) {
  for (const bool z_up : {true, false}) {
    SeenPoints seen;
    seen.step = 0.02;
    seen.add_walls({-0.6, -0.6, 0.0}, {0.6, 0.6, 1.0}, /*out=*/true);
    seen.add_ball({0.0, 0.0, 1.5}, 0.45, 9000);
    if (!z_up)
      for (std::vector<glm::dvec3>* all : {&seen.points.position, &seen.normal})
        for (glm::dvec3& v : *all) v = {v.x, v.z, -v.y};
    EXPECT_GT(right_sides(seen, std::nullopt), 0.97) << (z_up ? "z up" : "y up");
  }
}

/// A bust that was gone around and turned over: its base and its crown bound it as a floor and a ceiling do, but it is round.
TEST(RoomSides, ABustWithAFlatCrownIsNoRoom) {
  SeenPoints seen;
  seen.add_ball({0.0, 0.0, 0.0}, 1.0, 20000);
  const auto cut = [&](const glm::dvec3& normal, double away) {
    for (std::size_t i = 0; i < seen.normal.size(); ++i) {
      glm::dvec3& place = seen.points.position[i];
      const double along = glm::dot(place, normal);
      if (along < away) continue;
      seen.normal[i] = normal;
      place *= away / along;
    }
  };
  cut({0.0, 0.0, -1.0}, 0.84);
  cut({0.0, -0.3, std::sqrt(0.91)}, 0.78);
  EXPECT_GT(right_sides(seen), 0.97);
}

/// A lid bounds a body as a ceiling does a room, but nothing does from below.
TEST(RoomSides, ABodyWithAFlatTopIsNoRoom) {
  SeenPoints seen;
  seen.add_walls({-1.0, -0.8, 0.0}, {1.0, 0.8, 1.2}, /*out=*/true);
  seen.add({-1.0, -0.8, 1.2}, {2.0, 0, 0}, {0, 1.6, 0});
  EXPECT_GT(right_sides(seen), 0.97);
}

TEST(RoomSides, HalfARoomIsSeenFromWithin) {
  SeenPoints seen;
  seen.add({0, 0, 0}, {6, 0, 0}, {0, 5, 0});
  seen.add({0, 0, 0}, {0, 5, 0}, {0, 0, 2.7});
  seen.add({0, 0, 0}, {0, 0, 2.7}, {6, 0, 0});
  EXPECT_GT(right_sides(seen), 0.97);
}

/// Both faces of a bowl with a wall of 12 mm, whichever way it stands.
TEST(RoomSides, ABowlHasTwoFaces) {
  SeenPoints seen;
  add_lower_half(glm::dvec3(0.15), 0.003, /*out=*/true, seen);
  add_lower_half(glm::dvec3(0.138), 0.003, /*out=*/false, seen);
  EXPECT_GT(right_sides(seen), 0.97);
  for (std::vector<glm::dvec3>* all : {&seen.points.position, &seen.normal})
    for (glm::dvec3& v : *all) v = {v.x, -v.y, -v.z};
  EXPECT_GT(right_sides(seen), 0.97) << "upside down";
  EXPECT_GT(right_sides(seen, std::nullopt), 0.97) << "up unknown";
}

/// A boat's hull was gone around, and nobody looked into it.
TEST(RoomSides, AHullIsSeenFromOutside) {
  SeenPoints seen;
  add_lower_half({3.0, 1.0, 0.8}, 0.03, /*out=*/true, seen);
  EXPECT_GT(right_sides(seen), 0.97);
}

TEST(RoomSides, ACourtyardIsSeenFromWithin) {
  SeenPoints seen;
  seen.step = 0.15;
  seen.add({0, 0, 0}, {20, 0, 0}, {0, 16, 0});
  seen.add_walls({0, 0, 0}, {20, 16, 7}, /*out=*/false);
  seen.add_walls({8, 6, 0}, {10, 8, 1}, /*out=*/true);
  seen.add({8, 6, 1}, {2, 0, 0}, {0, 2, 0});
  EXPECT_GT(right_sides(seen), 0.97);
}

/// More than half of a town lies on upright walls, so that it is no open sheet; its ground has more room below than above, and bounds all as
/// a floor does.
TEST(RoomSides, ATownsGroundIsSeenFromAbove) {
  const auto shift = [](double x, double y) {
    return glm::dvec3(std::sin(x + y), std::cos(2.0 * x - y), 0.0);
  };
  SeenPoints seen;
  seen.step = 0.3;
  seen.add({0, 0, 0}, {60, 0, 0}, {0, 60, 0}, [&](const glm::dvec3& p) {
    const double x = 12.0 * std::floor(p.x / 12.0), y = 12.0 * std::floor(p.y / 12.0);
    const glm::dvec3 from_middle = p - glm::dvec3(x + 6.0, y + 6.0, 0.0) - shift(x, y);
    return std::abs(from_middle.x) < 4.0 && std::abs(from_middle.y) < 3.0;
  });
  for (double x = 0.0; x < 60.0; x += 12.0)
    for (double y = 0.0; y < 60.0; y += 12.0) {
      const glm::dvec3 low = glm::dvec3(x + 2.0, y + 3.0, 0.0) + shift(x, y);
      const double height = 7.0 + std::fmod(0.7 * x + 0.3 * y, 5.0);
      seen.add_walls(low, low + glm::dvec3(8.0, 6.0, height), /*out=*/true);
      seen.add(low + glm::dvec3(0.0, 0.0, height), {8, 0, 0}, {0, 6, 0});
    }
  EXPECT_GT(right_sides(seen), 0.97);
}

/// A second room lies beyond each outer wall of the first, so that hardly a plane bounds all.
TEST(RoomSides, RoomsBehindDoorsAreRooms) {
  SPLATRAY_NIGHTLY();
  const auto door = [](const glm::dvec3& p) {
    return p.z < 2.0 && (std::abs(p.x - 1.0) < 0.5 || std::abs(p.y - 1.0) < 0.5);
  };
  SeenPoints seen;
  for (const glm::dvec3 corner : {glm::dvec3(0, 0, 0), glm::dvec3(4.2, 0.5, 0.2), glm::dvec3(-0.7, 4.2, 0.4),
                                  glm::dvec3(-4.2, -0.5, 0.6), glm::dvec3(0.7, -4.2, 0.8)}) {
    const glm::dvec3 high = corner + glm::dvec3(4.0, 4.0, 2.6 + 0.1 * corner.z);
    seen.add_walls(corner, high, /*out=*/false, door);
    seen.add(corner, {4, 0, 0}, {0, 4, 0});
    seen.add({corner.x, corner.y, high.z}, {0, 4, 0}, {4, 0, 0});
    seen.add_walls(corner + glm::dvec3(1.8, 1.8, 0), corner + glm::dvec3(2.6, 2.6, 0.8), /*out=*/true);
    seen.add(corner + glm::dvec3(1.8, 1.8, 0.8), {0.8, 0, 0}, {0, 0.8, 0});
  }
  EXPECT_GT(right_sides(seen), 0.95);
}

}  // namespace
}  // namespace splatray::testing
