#include "engine/light/emitter_area.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "engine/scene/clip.h"

namespace splatray {
namespace {

using glm::dvec3;

/// Points of each disc that are looked at: enough for a share to some per cent.
constexpr int POINTS = 16;
/// Most splats that are looked at: with more, looking takes longer than it saves, and each matters less.
constexpr std::size_t MOST = 65536;
constexpr double USUAL_SHARE = 0.45;  // discs overlap 2.2 times
/// Where the golden angle divides a turn, points of a spiral lie evenly.
constexpr double GOLDEN_ANGLE = 2.39996322972865332;

/// Discs by cells of space, each in all cells that its box meets.
class DiscGrid {
 public:
  explicit DiscGrid(std::span<const Splat> splats) : splats_(splats) {
    double sum = 0.0;
    for (const Splat& splat : splats) sum += std::sqrt(splat.radius_squared);
    cell_ = std::max(2.0 * sum / static_cast<double>(splats.size()), 1.0);
    for (std::uint32_t i = 0; i < splats.size(); ++i) {
      // A disc's box: along each axis its radius times the sine of the angle between axis and normal.
      const dvec3 reach = std::sqrt(splats[i].radius_squared) *
                          glm::sqrt(glm::max(1.0 - splats[i].normal * splats[i].normal, dvec3(0.0)));
      const glm::i64vec3 low = cell_of(splats[i].center - reach), high = cell_of(splats[i].center + reach);
      for (std::int64_t x = low.x; x <= high.x; ++x)
        for (std::int64_t y = low.y; y <= high.y; ++y)
          for (std::int64_t z = low.z; z <= high.z; ++z) cells_[key({x, y, z})].push_back(i);
    }
  }

  [[nodiscard]] std::span<const std::uint32_t> near(const dvec3& point) const {
    const auto found = cells_.find(key(cell_of(point)));
    return found == cells_.end() ? std::span<const std::uint32_t>{} : std::span(found->second);
  }

 private:
  [[nodiscard]] glm::i64vec3 cell_of(const dvec3& point) const {
    return glm::i64vec3(glm::floor(point / cell_));
  }
  /// Positions are of the root, 21 bits each.
  static std::uint64_t key(const glm::i64vec3& cell) {
    const auto bits = [](std::int64_t x) { return static_cast<std::uint64_t>(x) & 0x1FFFFFU; };
    return bits(cell.x) << 42U | bits(cell.y) << 21U | bits(cell.z);
  }

  std::span<const Splat> splats_;
  double cell_ = 1.0;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

/// Whether clip lines leave this offset from the centre.
bool kept(const std::array<ClipLine, 2>& lines, const dvec3& offset) {
  return std::all_of(lines.begin(), lines.end(),
                     [&](const ClipLine& line) { return glm::dot(line.across, offset) <= line.limit; });
}

/// Whether a splat lies over or under a point of another, as in a blend.
bool covers(const Splat& splat, const dvec3& point, const Splat& other) {
  const dvec3 offset = point - splat.center;
  const double height = glm::dot(offset, splat.normal), squared = glm::dot(offset, offset);
  return splat.object == other.object && glm::dot(splat.normal, other.normal) > 0.5 &&
         squared - height * height <= splat.radius_squared && height * height <= splat.radius_squared;
}

/// As if each had as much for itself as is usual.
std::vector<float> usual_areas(std::span<const Splat> splats) {
  std::vector<float> areas;
  areas.reserve(splats.size());
  for (const Splat& splat : splats)
    areas.push_back(static_cast<float>(USUAL_SHARE * std::numbers::pi * splat.radius_squared));
  return areas;
}

}  // namespace

std::vector<float> areas_alone(std::span<const Splat> splats, std::span<const std::uint32_t> clips) {
  if (splats.size() > MOST) return usual_areas(splats);
  const DiscGrid grid(splats);
  std::vector<std::array<ClipLine, 2>> lines;
  for (std::size_t i = 0; i < clips.size(); ++i)
    lines.push_back(unpack_clip(clips[i], pack_splat(splats[i])));
  std::vector<float> areas;
  areas.reserve(splats.size());
  for (std::size_t i = 0; i < splats.size(); ++i) {
    const Splat& splat = splats[i];
    const TangentFrame frame(splat.normal);
    double sum = 0.0;
    for (int j = 0; j < POINTS; ++j) {
      const double radius = std::sqrt(splat.radius_squared * (j + 0.5) / POINTS), angle = j * GOLDEN_ANGLE;
      const dvec3 offset = radius * (std::cos(angle) * frame.u + std::sin(angle) * frame.v);
      const dvec3 point = splat.center + offset;
      if (!clips.empty() && !kept(lines[i], offset)) continue;
      int members = 0;
      for (const std::uint32_t other : grid.near(point))
        if (other == i || (covers(splats[other], point, splat) &&
                           (clips.empty() || kept(lines[other], point - splats[other].center))))
          ++members;
      sum += 1.0 / std::max(members, 1);
    }
    const double disc = std::numbers::pi * splat.radius_squared;
    areas.push_back(static_cast<float>(disc * std::max(sum / POINTS, 1e-3)));
  }
  return areas;
}

}  // namespace splatray
