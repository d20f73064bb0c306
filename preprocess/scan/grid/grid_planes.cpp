#include "preprocess/scan/grid/grid_planes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/base/vector_clones.h"
#include "preprocess/base/lanes.h"

namespace splatray {
namespace {

constexpr int HALF_WINDOW = 4;               // of a window, in strides
constexpr int WINDOW = 2 * HALF_WINDOW + 1;  // cells along its edge
constexpr double WIDTH = 0.6 * HALF_WINDOW;  // standard deviation of the weights, in strides
constexpr double SUPPORTING = 2.5;           // units off a plane from which a cell does not support it
constexpr double WINDOW_RIDGE = 0.01;        // cells^2: no slope where a window has no width

/// One look at all cells.
struct Pass {
  int stride;
  float units, wider;  ///< tolerance, and more of it for each cell between
  bool mutual;  ///< the other's slope must predict this cell as well, so that nothing is taken across an edge
  bool values;  ///< inverse depths change, else slopes alone
};
constexpr std::array<Pass, 4> PASSES{{{1, 2.0F, 0.2F, false, false},
                                      {2, 1.5F, 0.1F, true, true},
                                      {3, 1.0F, 0.05F, true, true},
                                      {2, 0.3F, 0.03F, true, false}}};

/// The places of windows of one stride, component by component; without weight up to whole vectors.
struct WindowPlaces {
  static constexpr std::size_t COUNT = WINDOW * WINDOW, ROOM = (COUNT + LANES - 1) / LANES * LANES;

  std::int64_t reach;                          ///< cells
  std::int64_t columns[ROOM]{}, rows[ROOM]{};  ///< from the middle
  std::int64_t numbers[ROOM]{};                ///< of cells, the same
  float right[ROOM]{}, down[ROOM]{}, apart[ROOM]{}, weight[ROOM]{};

  WindowPlaces(const DepthGrid& grid, std::int64_t stride) : reach(HALF_WINDOW * stride) {
    for (std::size_t n = 0; n < COUNT; ++n) {
      const std::int64_t i = static_cast<std::int64_t>(n % WINDOW) - HALF_WINDOW;
      const std::int64_t j = static_cast<std::int64_t>(n / WINDOW) - HALF_WINDOW;
      const double strides = std::hypot(i, j);
      columns[n] = stride * i, rows[n] = stride * j;
      numbers[n] = rows[n] * grid.columns + columns[n];
      right[n] = static_cast<float>(columns[n]), down[n] = static_cast<float>(rows[n]);
      apart[n] = static_cast<float>(strides * static_cast<double>(stride));
      weight[n] = static_cast<float>(std::exp(-0.5 * strides * strides / (WIDTH * WIDTH)));
    }
  }
};

/// What is at the places; of empty cells without weight.
struct Window {
  float weight[WindowPlaces::ROOM]{};
  float step[WindowPlaces::ROOM]{};                                    ///< inverse depth less the middle's
  float slope_x[WindowPlaces::ROOM]{}, slope_y[WindowPlaces::ROOM]{};  ///< theirs
};

void look_around(const DepthGrid& grid, const WindowPlaces& places, std::size_t cell, Window& window) {
  const std::int64_t column = static_cast<std::int64_t>(cell) % grid.columns;
  const std::int64_t row = static_cast<std::int64_t>(cell) / grid.columns;
  const float here = grid.inverse[cell];
  const bool inside = column >= places.reach && column + places.reach < grid.columns && row >= places.reach &&
                      row + places.reach < grid.rows;
  const auto take = [&](std::size_t n, std::size_t other) {
    const float inverse = grid.inverse[other];
    window.weight[n] = inverse > 0.0F ? places.weight[n] : 0.0F;
    window.step[n] = inverse - here;
    window.slope_x[n] = grid.slope[other].x, window.slope_y[n] = grid.slope[other].y;
  };
  for (std::size_t n = 0; n < WindowPlaces::COUNT; ++n) {
    if (inside) {
      take(n, cell + static_cast<std::size_t>(places.numbers[n]));
    } else if (const std::size_t other = grid.beside(cell, places.columns[n], places.rows[n]);
               other < grid.size()) {
      take(n, other);
    } else {
      window.weight[n] = 0.0F;
    }
  }
}

/// Makes values their sizes.
[[gnu::always_inline]] inline void drop_signs(Lanes& values) { values = values < 0.0F ? -values : values; }

/// Weighted sums over places (x, y) of values, some in each lane.
struct PlaneSums {
  Lanes w{}, x{}, y{}, v{}, xx{}, xy{}, yy{}, xv{}, yv{};

  [[gnu::always_inline]] void add(const Lanes& weight, const Lanes& at_x, const Lanes& at_y,
                                  const Lanes& value) {
    const Lanes wx = weight * at_x, wy = weight * at_y;
    w += weight, x += wx, y += wy, v += weight * value;
    xx += wx * at_x, xy += wx * at_y, yy += wy * at_y;
    xv += wx * value, yv += wy * value;
  }
};

/// A plane over a window.
struct WindowPlane {
  glm::dvec2 slope{0.0}, middle{0.0};  ///< and the weighted mean of the places
  double value = 0.0;                  ///< at the window's middle
};

WindowPlane plane_of(const PlaneSums& sums) {
  const double by = 1.0 / double{sum_lanes(sums.w)};
  const double x = by * sum_lanes(sums.x), y = by * sum_lanes(sums.y), v = by * sum_lanes(sums.v);
  const double xx = by * sum_lanes(sums.xx) - x * x + WINDOW_RIDGE,
               yy = by * sum_lanes(sums.yy) - y * y + WINDOW_RIDGE;
  const double xy = by * sum_lanes(sums.xy) - x * y;
  const double xv = by * sum_lanes(sums.xv) - x * v, yv = by * sum_lanes(sums.yv) - y * v;
  const glm::dvec2 slope = glm::dvec2(xv * yy - yv * xy, yv * xx - xv * xy) / (xx * yy - xy * xy);
  return {slope, {x, y}, v - slope.x * x - slope.y * y};
}

/// What a window adds to its middle's slope and inverse depth. With half of its own slope and half of each other's, the value
/// is that of a surface of second order, as curvature cancels.
SPLATRAY_VECTOR_CLONES glm::dvec3 fit_plane(const WindowPlaces& places, const Window& window,
                                            const glm::vec2& slope, float unit, const Pass& pass) {
  PlaneSums sums;  // of what is off the slope so far
  Lanes by_theirs{}, right, down, apart, weight, step, their_x, their_y;
  const float units = unit * pass.units, wider = unit * pass.wider;
  for (std::size_t n = 0; n < WindowPlaces::ROOM; n += LANES) {
    load_lanes(places.right + n, right), load_lanes(places.down + n, down);
    load_lanes(places.apart + n, apart), load_lanes(window.weight + n, weight);
    load_lanes(window.step + n, step);
    load_lanes(window.slope_x + n, their_x), load_lanes(window.slope_y + n, their_y);
    const Lanes ours = slope.x * right + slope.y * down, theirs = their_x * right + their_y * down;
    Lanes off = step - ours, off_theirs = step - theirs;
    drop_signs(off), drop_signs(off_theirs);
    if (pass.mutual) off = off > off_theirs ? off : off_theirs;
    const Lanes share = off / (units + wider * apart);
    const Lanes has = share < 1.0F ? weight * (1.0F - share * share) : Lanes{};
    sums.add(has, right, down, step - ours);
    by_theirs += has * (theirs - ours);
  }
  const WindowPlane plane = plane_of(sums);
  const double bent = glm::dot(plane.slope, plane.middle) - sum_lanes(by_theirs) / double{sum_lanes(sums.w)};
  return {plane.slope, pass.values ? plane.value + 0.5 * bent : 0.0};
}

/// Slopes of both sides along columns or rows, of which one may belong to what is behind or beyond a crease.
std::array<double, 2> side_slopes(const DepthGrid& grid, std::size_t cell, std::int64_t right,
                                  std::int64_t down) {
  constexpr std::int64_t SPAN = 3;
  std::array<double, 2> slopes{};
  std::array<bool, 2> found{};
  for (const std::size_t i : {0U, 1U}) {
    for (std::int64_t span = SPAN; span > 0 && !found[i]; --span) {
      const std::int64_t steps = i == 0 ? -span : span;
      const double other = grid.inverse_beside(cell, steps * right, steps * down);
      if (!(other > 0.0)) continue;
      slopes[i] = (other - grid.inverse[cell]) / static_cast<double>(steps);
      found[i] = true;
    }
  }
  if (!found[0]) slopes[0] = slopes[1];
  if (!found[1]) slopes[1] = slopes[0];
  return slopes;
}

/// Weight of the cells that lie on the plane of a slope, less of those that are off it; `by` is 1 / what is too far.
SPLATRAY_VECTOR_CLONES float support_of(const WindowPlaces& places, const Window& window,
                                        const glm::vec2& slope, float by) {
  Lanes support{}, right, down, weight, step;
  for (std::size_t n = 0; n < WindowPlaces::ROOM; n += LANES) {
    load_lanes(places.right + n, right), load_lanes(places.down + n, down);
    load_lanes(window.weight + n, weight), load_lanes(window.step + n, step);
    Lanes share = (step - slope.x * right - slope.y * down) * by;
    drop_signs(share);
    support += share < 1.0F ? weight * (1.0F - share) : Lanes{};
  }
  return sum_lanes(support);
}

/// The mean slope of both sides, or one side's where clearly more of the window lies on its plane; and how much does.
std::pair<glm::vec2, float> first_slope(const DepthGrid& grid, const DepthUnit& unit,
                                        const WindowPlaces& places, std::size_t cell) {
  constexpr float CLEARLY = 1.3F;
  const std::array<double, 2> x = side_slopes(grid, cell, 1, 0), y = side_slopes(grid, cell, 0, 1);
  const auto by = static_cast<float>(1.0 / (SUPPORTING * unit.of(grid.inverse[cell])));
  Window window;
  look_around(grid, places, cell, window);
  const glm::vec2 mean(0.5 * (x[0] + x[1]), 0.5 * (y[0] + y[1]));
  std::pair<glm::vec2, float> best{mean, support_of(places, window, mean, by)};
  float least = CLEARLY * best.second;
  for (const glm::vec2 slope :
       {glm::vec2(x[0], y[0]), glm::vec2(x[1], y[0]), glm::vec2(x[0], y[1]), glm::vec2(x[1], y[1])}) {
    const float support = support_of(places, window, slope, by);
    if (support > least) best = {slope, support}, least = support;
  }
  return best;
}

void run_pass(DepthGrid& grid, const DepthUnit& unit, const Pass& pass, const Stage& stage) {
  std::vector<float> inverse(grid.size());
  std::vector<glm::vec2> slope(grid.size());
  const WindowPlaces places(grid, pass.stride);
  parallel_each(stage, grid.size(), [&](std::size_t cell) {
    if (!(grid.inverse[cell] > 0.0F)) return;
    Window window;
    look_around(grid, places, cell, window);
    const glm::dvec3 more =
        fit_plane(places, window, grid.slope[cell], static_cast<float>(unit.of(grid.inverse[cell])), pass);
    const double found = grid.inverse[cell] + more.z;
    inverse[cell] = found > 0.0 ? static_cast<float>(found) : grid.inverse[cell];
    slope[cell] = grid.slope[cell] + glm::vec2(more);
  });
  grid.inverse = std::move(inverse);
  grid.slope = std::move(slope);
}

}  // namespace

std::vector<float> find_first_slopes(DepthGrid& grid, const DepthUnit& unit, const Stage& stage) {
  grid.slope.resize(grid.size());
  std::vector<float> supports(grid.size());
  std::vector<glm::vec2> slopes(grid.size());
  const WindowPlaces places(grid, 1);
  parallel_each(stage, grid.size(), [&](std::size_t cell) {
    if (!(grid.inverse[cell] > 0.0F)) return;
    const auto [slope, support] = first_slope(grid, unit, places, cell);
    slopes[cell] = slope;
    supports[cell] = support;
  });
  grid.slope = std::move(slopes);
  return supports;
}

void fit_planes(DepthGrid& grid, const DepthUnit& unit, const Stage& stage) {
  for (const Pass& pass : PASSES) run_pass(grid, unit, pass, stage);
}

}  // namespace splatray
