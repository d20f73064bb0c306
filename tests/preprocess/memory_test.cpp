/// How much memory a build of a scan takes at once.
#include <gtest/gtest.h>
#include <malloc.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <new>
#include <numbers>
#include <random>

#include "preprocess/surface/number_lists.h"
#include "tests/all_tests.h"
#include "tests/preprocess/shapes.h"

namespace {

std::atomic<std::size_t> live_bytes = 0, most_bytes = 0;

void* taken(void* block) {
  if (block == nullptr) throw std::bad_alloc();
  const std::size_t live = live_bytes += malloc_usable_size(block);
  std::size_t most = most_bytes;
  while (live > most && !most_bytes.compare_exchange_weak(most, live)) {
  }
  return block;
}

void give_back(void* block) noexcept {
  live_bytes -= malloc_usable_size(block);
  std::free(block);
}

}  // namespace

// Arrays are allocated by these: what is counted does not depend on the system, sanitizers or other tests.
void* operator new(std::size_t bytes) { return taken(std::malloc(bytes)); }
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  const auto unit = static_cast<std::size_t>(alignment);
  return taken(std::aligned_alloc(unit, (bytes + unit - 1) / unit * unit));
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  void* const block = std::malloc(bytes);
  return block == nullptr ? nullptr : taken(block);
}
void operator delete(void* block) noexcept { give_back(block); }
void operator delete(void* block, const std::nothrow_t&) noexcept { give_back(block); }
void operator delete(void* block, std::size_t) noexcept { give_back(block); }
void operator delete(void* block, std::align_val_t) noexcept { give_back(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { give_back(block); }

namespace splatray {
namespace {

constexpr std::size_t POINTS = 1U << 18;  // what does not grow with them is less than 10 bytes a point

/// A scanner's points on a sphere with colours, off it by heights of this deviation, in units of their spacing.
InputObject scanned_sphere(double noise) {
  InputObject object = test::random_sphere(POINTS, 5);
  object.surface_area = 0.0;
  object.oriented = false;
  std::mt19937_64 random(7);
  std::normal_distribution<double> height(0.0, noise * std::sqrt(4.0 * std::numbers::pi / POINTS));
  for (glm::dvec3& position : object.points.position) position *= 1.0 + height(random);
  object.points.color.assign(POINTS, glm::vec3(0.5F));
  return object;
}

InputObject without_normals(InputObject object) {
  object.points.normal = std::vector<glm::vec3>();
  return object;
}

/// Builds the scene of what is made and returns the most bytes a point that were there at once, those of the input too.
template <typename Make>
double peak_of(const Make& make) {
  const std::size_t others = live_bytes;
  Input input = test::input_of(make());
  most_bytes.store(live_bytes);
  BuildStats stats;
  const Scene scene = build_scene(std::move(input), {}, 0, stats);
  return static_cast<double>(most_bytes - others) / POINTS;
}

// Of 11 million points 140 bytes each are to do for all: attributes, what does not grow with points, what the allocator keeps. The
// bounds are what was measured (107.4, 121.5, 116.4) and not quite one more float32 of each point.

TEST(Memory, OfAScanWithoutNormals) {
  SPLATRAY_NIGHTLY();
  EXPECT_LT(peak_of([] { return without_normals(scanned_sphere(0.0)); }), 111.0);
}

TEST(Memory, OfAScanWithItsNormals) {
  EXPECT_LT(peak_of([] { return scanned_sphere(0.0); }), 125.0);
}

TEST(Memory, OfANoisyScan) {
  SPLATRAY_NIGHTLY();
  EXPECT_LT(peak_of([] { return without_normals(scanned_sphere(0.4)); }), 120.0);
}

TEST(NumberLists, GiveWhatWasSetNearAndFar) {
  constexpr std::uint32_t COUNT = 100000;
  const auto list_of = [](std::uint32_t i) -> NumberLists<3>::List {
    return {i % 3 == 0 ? COUNT - 1 - i : i, (i + 40000) % COUNT, i > 32767 ? i - 32767 : i + 32767};
  };
  NumberLists<3> lists(COUNT);
  tbb::parallel_for(0U, COUNT, [&](std::uint32_t i) { lists.set(i, list_of(i)); });
  for (std::uint32_t i = 0; i < COUNT; ++i) {
    ASSERT_EQ(lists[i], list_of(i)) << i;
    for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(lists.at(i, k), list_of(i)[k]) << i;
  }
}

TEST(NumberLists, KeepSomeRenumbered) {
  constexpr std::uint32_t COUNT = 100000;
  NumberLists<3> lists(COUNT);
  for (std::uint32_t i = 0; i < COUNT; ++i) lists.set(i, {i, COUNT - 1 - i, i / 2});
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < COUNT; ++i)
    if (i % 7 != 3) kept.push_back(i);
  lists.keep(kept, [](std::uint32_t n, const auto& list) -> NumberLists<3>::List {
    return {n, list[1], list[2]};
  });
  for (std::uint32_t n = 0; n < kept.size(); ++n)
    ASSERT_EQ(lists[n], (NumberLists<3>::List{n, COUNT - 1 - kept[n], kept[n] / 2})) << n;
}

TEST(Release, FreesWhatEmptyBracesKeep) {
  std::vector<int> values(1000);
  const std::size_t before = live_bytes;
  release(values);
  EXPECT_EQ(values.capacity(), 0U);
  EXPECT_GE(before - live_bytes, 1000 * sizeof(int));
}

}  // namespace
}  // namespace splatray
