#include "engine/image/upright.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "engine/base/number_text.h"
#include "engine/image/scan_kind.h"
#include "engine/image/view.h"

namespace splatray {
namespace {

constexpr double RING_FLAT = 0.1, RING_ROUND = 0.5;  ///< of its larger side
constexpr double THIN = 0.5;                         ///< a sweep's height over its width
constexpr double OPEN_LEAST = 0.06, OPEN_MOST = 0.25, OPEN_TIMES = 3.0;
constexpr double BASE_SHARE = 0.03, BASE_TIMES = 3.0, BASE_HEIGHT = 0.03, BASE_OUTSIDE = 0.005,
                 BASE_DEG = 15.0;
constexpr double SURVEY_LEAST = 1e4, SURVEY_SIZES = 10.0, SURVEY_HEIGHT = 0.1;
/// Height over width: ten sites have at most 0.25, 18 things with y up at least 0.44 along z.
constexpr double TERRAIN = 0.3;
constexpr double WALL = 0.3;  ///< height over width of what is too flat to stand

/// Fractions of the height, of the points at each end and of the outline, and a multiple of the other axis's. Of 33 known models they turn the
/// six that stand along z, statues and busts on 0.27 to 0.76 of their outline, and none of those along y, which stand on 0 to 0.27
/// of it along z.
constexpr double FOOT_HEIGHT = 0.05, FOOT_OUTSIDE = 0.0025, FOOT_SHARE = 0.25, FOOT_TIMES = 2.0;
/// A plinth is all foot, while one of its sides is at most 0.7 of the outline from there, as the statue is higher.
constexpr double FOOT_WHOLE = 0.95, FOOT_PART = 0.75;
/// The mean of the normals of what was seen from one side alone is longer: a half ball's is 0.5.
constexpr double ONE_SIDED = 0.4;

/// The six axes: x, y, z and their opposites.
glm::dvec3 signed_axis(int number) {
  glm::dvec3 axis(0.0);
  axis[number % 3] = number < 3 ? 1.0 : -1.0;
  return axis;
}

/// The axis, 0 to 2, of stations that stand in a ring around all points, outside them; nothing where they do not.
std::optional<int> ring_axis(const Scene& scene) {
  std::vector<glm::dvec3> places;
  for (const Station& station : scene.stations)
    if (station.sensor_world) places.push_back(*station.sensor_world);
  if (places.size() < 3) return {};
  glm::dvec3 low = places.front(), high = low;
  for (const glm::dvec3& place : places) {
    low = glm::min(low, place);
    high = glm::max(high, place);
    if (glm::all(glm::greaterThan(place, scene.bounds_min_world)) &&
        glm::all(glm::lessThan(place, scene.bounds_max_world)))
      return {};
  }
  const glm::dvec3 size = high - low;
  int flat = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (size[axis] < size[flat]) flat = axis;
  const double a = size[(flat + 1) % 3], b = size[(flat + 2) % 3];
  const bool ring = size[flat] < RING_FLAT * std::max(a, b) && std::min(a, b) > RING_ROUND * std::max(a, b);
  const glm::dvec3 center = 0.5 * (scene.bounds_min_world + scene.bounds_max_world);
  bool around = true;
  for (const int axis : {(flat + 1) % 3, (flat + 2) % 3})
    around = around && low[axis] < center[axis] && high[axis] > center[axis];
  return ring && around ? std::optional(flat) : std::nullopt;
}

std::optional<UpFound> up_of_ring(const Scene& scene, const PointSample& sample) {
  const std::optional<int> axis = ring_axis(scene);
  if (!axis) return {};
  return UpFound{signed_axis(mean_normal(sample)[*axis] < 0.0 ? *axis + 3 : *axis), UpEvidence::ring};
}

/// Up of a sweep about the origin.
std::optional<UpFound> up_of_sweep(const PointSample& sample, const glm::dvec3& promised) {
  const glm::dvec3 size = robust_size(sample, glm::dmat3(1.0));
  for (int axis = 0; axis < 3; ++axis) {
    const double thin = size[axis] / std::min(size[(axis + 1) % 3], size[(axis + 2) % 3]);
    if (!(thin < THIN)) continue;
    const bool own = std::abs(promised[axis]) > 0.5 * glm::length(promised);
    const glm::dvec3 up = own ? promised : signed_axis(axis);
    if (is_sweep(sample, glm::dvec3(0.0), upright_axes(up))) return UpFound{up, UpEvidence::sweep, thin};
  }
  return {};
}

/// Whether a direction stands the scene on its head.
bool is_opposite(const glm::dvec3& up, const Scene& scene) {
  return glm::dot(up, glm::normalize(scene.up)) < -0.5;
}

/// How far c lies to the left of the way from a to b, times its length.
double left_of(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The corners of the points' convex hull, counter-clockwise (Andrew 1979, "Another Efficient Algorithm for Convex Hulls in Two
/// Dimensions").
std::vector<glm::dvec2> convex_hull(std::vector<glm::dvec2> points) {
  std::sort(points.begin(), points.end(),
            [](const glm::dvec2& a, const glm::dvec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<glm::dvec2> hull;
  const auto add = [&](std::size_t kept, const glm::dvec2& point) {
    while (hull.size() > kept + 1 && left_of(hull[hull.size() - 2], hull.back(), point) <= 0.0)
      hull.pop_back();
    hull.push_back(point);
  };
  for (const glm::dvec2& point : points) add(0, point);
  const std::size_t lower = hull.empty() ? 0 : hull.size() - 1;
  for (auto point = points.rbegin(); point != points.rend(); ++point) add(lower, *point);
  if (hull.size() > 1) hull.pop_back();
  return hull;
}

double area_of(const std::vector<glm::dvec2>& hull) {
  double area = 0.0;
  for (std::size_t i = 2; i < hull.size(); ++i) area += 0.5 * left_of(hull[0], hull[i - 1], hull[i]);
  return area;
}

bool holds(const std::vector<glm::dvec2>& hull, const glm::dvec2& place) {
  for (std::size_t i = 0; i < hull.size(); ++i)
    if (left_of(hull[i], hull[(i + 1) % hull.size()], place) <= 0.0) return false;
  return hull.size() > 2;
}

/// How a thing stands on the end of another up direction than its format's, where it plainly does not on that of its own; else 0. What
/// is flat along it lies, and what was seen from there alone has no other side: neither stands.
double stands_better(const glm::dvec3& up, const glm::dvec3& own, const PointSample& sample) {
  const glm::dvec3 size = robust_size(sample, upright_axes(up));
  if (size.y < WALL * std::min(size.x, size.z)) return 0.0;
  const double share = stands_on(sample, up), of_own = stands_on(sample, own);
  const bool better = share > std::max(FOOT_SHARE, FOOT_TIMES * of_own);
  return better || (share > FOOT_WHOLE && of_own < FOOT_PART) ? share : 0.0;
}

/// Up of what stands on its end by the other of the two directions that programs take for up, y and z.
std::optional<UpFound> up_of_feet(const glm::dvec3& own, const PointSample& sample) {
  const glm::dvec3 y(0.0, 1.0, 0.0), z(0.0, 0.0, 1.0);
  if (own != y && own != z) return {};
  const glm::dvec3 other = own == y ? z : y;
  const double share = stands_better(other, own, sample);
  return share > 0.0 ? std::optional(UpFound{other, UpEvidence::feet, share}) : std::nullopt;
}

/// The same of things whose normals are known: not what was seen from the other direction alone.
std::optional<UpFound> up_of_whole(const glm::dvec3& own, const PointSample& sample) {
  const auto found = up_of_feet(own, sample);
  return found && glm::dot(mean_normal(sample), found->up) <= ONE_SIDED ? found : std::nullopt;
}

/// Up of what is open below.
std::optional<UpFound> up_of_opening(const Scene& scene, const PointSample& sample) {
  const glm::dvec3 mean = mean_normal(sample);
  for (int axis = 0; axis < 3; ++axis) {
    const double along = std::abs(mean[axis]);
    const double across = std::max(std::abs(mean[(axis + 1) % 3]), std::abs(mean[(axis + 2) % 3]));
    const glm::dvec3 up = signed_axis(mean[axis] < 0.0 ? axis + 3 : axis);
    if (along > OPEN_LEAST && along < OPEN_MOST && along > OPEN_TIMES * across && !is_opposite(up, scene))
      return UpFound{up, UpEvidence::opening, along};
  }
  return {};
}

/// The share of the points that lie flat at the lower end of an up direction.
double base_share(const PointSample& sample, const glm::dvec3& up) {
  const double level = std::cos(BASE_DEG * std::numbers::pi / 180.0);
  const auto [low, high] = range_along(sample.position, up, BASE_OUTSIDE);
  std::size_t base = 0;
  for (std::size_t i = 0; i < sample.size(); ++i)
    if (glm::dot(sample.position[i], up) < low + BASE_HEIGHT * (high - low) &&
        std::abs(glm::dot(sample.normal[i], up)) > level)
      ++base;
  return share_of(base, sample.size());
}

/// Up of what stands on something flat.
UpFound up_of_base(const Scene& scene, const PointSample& sample, bool room) {
  const glm::dvec3 own = glm::normalize(scene.up);
  UpFound best{scene.up};
  double most = std::max(BASE_SHARE, BASE_TIMES * base_share(sample, own));
  for (int number = 0; number < 6; ++number) {
    const glm::dvec3 up = signed_axis(number), size = robust_size(sample, upright_axes(up));
    const bool flat = size.y < WALL * std::min(size.x, size.z);
    if (is_opposite(up, scene) || up.z < 0.0 || (flat && !room)) continue;
    const double share = base_share(sample, up);
    if (share <= most) continue;
    most = share;
    best = {up, UpEvidence::base, share};
  }
  return best;
}

}  // namespace

double stands_on(const PointSample& sample, const glm::dvec3& up) {
  const glm::dmat3 axes = upright_axes(up);
  const auto [low, high] = range_along(sample.position, up, FOOT_OUTSIDE);
  glm::dvec2 middle(0.0);
  std::vector<glm::dvec2> all, foot;
  for (const glm::dvec3& point : sample.position) {
    const glm::dvec3 from = point - sample.position.front();
    const glm::dvec2 place(glm::dot(from, axes[2]), glm::dot(from, axes[0]));
    middle += place / static_cast<double>(sample.size());
    all.push_back(place);
    if (glm::dot(point, up) < low + FOOT_HEIGHT * (high - low)) foot.push_back(place);
  }
  const std::vector<glm::dvec2> outline = convex_hull(std::move(all)), hull = convex_hull(std::move(foot));
  return outline.size() > 2 && holds(hull, middle) ? area_of(hull) / area_of(outline) : 0.0;
}

std::string up_note(const glm::dvec3& up) {
  return "up is " + number_text(up) + " by the shape of the points, not by their format";
}

const char* up_evidence_name(UpEvidence evidence) {
  static constexpr std::array NAMES = {"asked",  "format", "camera", "ring",    "sweep",
                                       "survey", "sheet",  "feet",   "opening", "base"};
  return NAMES[static_cast<std::size_t>(evidence)];
}

glm::dvec3 upright_model(const PointSample& sample) {
  const glm::dvec3 own(0.0, 1.0, 0.0);
  return up_of_whole(own, sample).value_or(UpFound{own}).up;
}

std::optional<UpFound> up_of_survey(const PointSample& sample) {
  if (sample.size() == 0) return {};
  const glm::dvec3 z(0.0, 0.0, 1.0), size = robust_size(sample, glm::dmat3(1.0));
  const auto [low, high] = range_along(sample.position, z, FOOT_OUTSIDE);
  const glm::dvec3 middle = glm::abs(sample.position[sample.size() / 2]);
  const double away = std::max(middle.x, middle.y), widest = std::max({size.x, size.y, size.z});
  if (!(widest > 0.0)) return {};
  if (away > std::max(SURVEY_LEAST, SURVEY_SIZES * widest) && middle.z < SURVEY_HEIGHT * away)
    return UpFound{z, UpEvidence::survey, away / widest};
  const double width = std::min(size.x, size.y), flat = size.z / width;
  const bool ahead = low > TERRAIN * width || high < -TERRAIN * width;
  return flat < TERRAIN && !ahead ? std::optional(UpFound{z, UpEvidence::sheet, flat}) : std::nullopt;
}

UpFound upright_places(const PointSample& sample, bool place_known) {
  const glm::dvec3 own(0.0, 1.0, 0.0);
  if (!place_known)
    if (const auto up = up_of_sweep(sample, own)) return *up;
  if (const auto up = up_of_survey(sample)) return *up;
  return up_of_feet(own, sample).value_or(UpFound{own});
}

UpFound upright(const Scene& scene) {
  const SceneKind kind = kind_of_scan(scene);
  if (kind == SceneKind::none || scene.camera) return {scene.up};
  const PointSample all = sample_points(scene), sample = main_parts(all);
  if (is_camera_frame(scene, all)) return {{0.0, -1.0, 0.0}, UpEvidence::camera};
  if (const auto up = up_of_ring(scene, sample)) return *up;
  if (!first_sensor(scene))
    if (const auto up = up_of_sweep(all, scene.up)) return *up;
  if (scene.up == glm::dvec3(0.0, 1.0, 0.0))
    if (const auto up = up_of_survey(all)) return *up;
  if (kind != SceneKind::object && kind != SceneKind::room) return {scene.up};
  if (kind == SceneKind::object) {
    if (const auto up = up_of_whole(scene.up, sample)) return *up;
    if (const auto up = up_of_opening(scene, sample)) return *up;
  }
  return up_of_base(scene, sample, kind == SceneKind::room);
}

}  // namespace splatray
