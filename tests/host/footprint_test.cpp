/// The footprint: no ray that meets a cell is left out.
#include "engine/image/footprint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/scene/tree.h"
#include "tests/host/pixel_ray.h"
#include "tests/host/scenes.h"

namespace splatray {
namespace {

constexpr double EDGE = 1U << LATTICE_BITS;
constexpr std::uint32_t WIDTH = 203, HEIGHT = 131;

using Random = std::mt19937_64;

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

std::vector<OctreeCell> random_cells(Random& random, std::size_t count) {
  std::vector<OctreeCell> cells;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t size = 1U << static_cast<std::uint32_t>(uniform(random, 12.0, 18.0));
    const auto place = [&] { return static_cast<std::uint32_t>(uniform(random, 0.0, EDGE)) / size * size; };
    cells.push_back({{place(), place(), place()}, size});
  }
  return cells;
}

/// Whether the ray has a point after t_min that is within LIST_INFLATION of the cell.
bool meets(const PixelRay& ray, double t_min, const OctreeCell& cell) {
  double enter = t_min * glm::length(glm::dvec3(ray.dir)), leave = std::numeric_limits<double>::infinity();
  const glm::dvec3 dir = glm::normalize(glm::dvec3(ray.dir));
  for (int axis = 0; axis < 3; ++axis) {
    const double low = double(cell.low[axis]) - LIST_INFLATION - double(ray.point[axis]);
    const double high = double(cell.low[axis]) + cell.size + LIST_INFLATION - double(ray.point[axis]);
    if (dir[axis] == 0.0 && (low > 0.0 || high < 0.0)) return false;
    if (dir[axis] == 0.0) continue;
    enter = std::max(enter, std::min(low / dir[axis], high / dir[axis]));
    leave = std::min(leave, std::max(low / dir[axis], high / dir[axis]));
  }
  return enter <= leave;
}

/// Rays that meet a cell, of all and of those outside the footprint.
struct Count {
  std::size_t met = 0, missed = 0;
};

/// Tests rays through random pixel positions against a footprint of `marked`.
Count count(const View& view, const std::vector<OctreeCell>& cells, const std::vector<OctreeCell>& marked,
            Random& random) {
  const Scene scene = box_scene();
  const FrameParams frame = make_frame_params(scene, view, {});
  const Footprint footprint(marked, scene.root, view);
  Count result;
  for (int i = 0; i < 20000; ++i) {
    const auto x = static_cast<float>(uniform(random, 0.0, view.width));
    const auto y = static_cast<float>(uniform(random, 0.0, view.height));
    const PixelRay ray = pixel_ray(frame, x, y);
    const bool met = std::any_of(cells.begin(), cells.end(),
                                 [&](const OctreeCell& cell) { return meets(ray, frame.t_min, cell); });
    result.met += met ? 1 : 0;
    if (met && !footprint.meets(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), 1, 1))
      ++result.missed;
  }
  return result;
}

View view_of(const glm::dvec3& eye, double fov_y_deg, double ortho_height = 0.0) {
  return {{eye, {0.1, -0.1, 0.2}, {0.1, 1.0, 0.0}, fov_y_deg, ortho_height}, WIDTH, HEIGHT};
}

View shifted(View view) {
  view.camera.lens_shift = {0.4, -0.3};
  view.camera.pixel_aspect = 1.5;
  return view;
}

std::vector<View> views() {
  return {view_of({1.0, 0.7, 3.0}, 40.0),
          view_of({0.2, 0.3, 0.1}, 90.0),
          view_of({1.3, 0.0, 0.0}, 130.0),
          view_of({1.0, 0.7, 3.0}, 3.0),
          view_of({30.0, 20.0, 200.0}, 0.8),
          view_of({3e5, 2e5, 2e6}, 1e-4),
          view_of({1.0, 0.7, 3.0}, 40.0, 2.0),
          view_of({0.2, 0.3, 0.1}, 40.0, 2.0),
          view_of({0.0, 0.0, 1.0e4}, 40.0, 1.0e-1),
          shifted(view_of({1.0, 0.7, 3.0}, 40.0)),
          shifted(view_of({1.0, 0.7, 3.0}, 40.0, 2.0))};
}

TEST(Footprint, HoldsEveryRayThatMeetsACell) {
  Random random(1);
  std::size_t met = 0;
  for (const View& view : views()) {
    const std::vector<OctreeCell> cells = random_cells(random, 40);
    const Count found = count(view, cells, cells, random);
    EXPECT_EQ(found.missed, 0U) << view.camera.eye.x << ' ' << view.camera.fov_y_deg;
    met += found.met;
  }
  EXPECT_GT(met, 5000U);
}

TEST(Footprint, OfOtherCellsIsNoticed) {
  Random random(2);
  std::vector<OctreeCell> cells = random_cells(random, 40);
  std::vector<OctreeCell> moved = cells;
  for (OctreeCell& cell : moved) cell.low.x += 2 * cell.size;
  EXPECT_GT(count(views().front(), cells, moved, random).missed, 100U);
}

TEST(Footprint, IsNoLargerThanABlockMore) {
  const Scene scene = box_scene();
  const View view = view_of({1.0, 0.7, 3.0}, 40.0);
  const std::uint32_t size = 1U << 12;
  const Footprint footprint({{{1U << 20, 1U << 20, 1U << 20}, size}}, scene.root, view);
  std::size_t blocks = 0;
  for (std::uint32_t y = 0; y < HEIGHT; y += 8)
    for (std::uint32_t x = 0; x < WIDTH; x += 8) blocks += footprint.meets(x, y, 8, 8) ? 1 : 0;
  EXPECT_GE(blocks, 1U);
  EXPECT_LE(blocks, 4U);
}

TEST(Footprint, IsEmptyBehindTheEyeAndWholeAroundIt) {
  const Scene scene = box_scene();
  View view = view_of({0.0, 0.0, 3.0}, 40.0);
  const std::vector<OctreeCell> root = {{glm::uvec3(0), 1U << LATTICE_BITS}};
  view.camera.target = {0.0, 0.0, 4.0};
  EXPECT_FALSE(Footprint(root, scene.root, view).meets(0, 0, WIDTH, HEIGHT));
  view.camera.eye = {0.0, 0.0, 0.0};
  const Footprint around(root, scene.root, view);
  for (std::uint32_t y = 0; y < HEIGHT; ++y)
    for (std::uint32_t x = 0; x < WIDTH; ++x) ASSERT_TRUE(around.meets(x, y, 1, 1));
}

TEST(Footprint, MeetsRectanglesThatReachIntoIt) {
  const Footprint whole(20, 10);
  EXPECT_TRUE(whole.meets(16, 8, 8, 8));
  EXPECT_FALSE(whole.meets(24, 0, 64, 1));
  EXPECT_FALSE(Footprint().meets(0, 0, 8, 8));
}

}  // namespace
}  // namespace splatray
