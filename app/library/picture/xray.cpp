#include "app/library/picture/xray.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/rank.h"
#include "engine/base/srgb.h"

namespace splatray {
namespace {

constexpr std::uint32_t GRID = 256;                  ///< rays each way that decide what is black
constexpr double LIGHTEST = 0.05, BLACKEST = 0.999;  ///< ranks of their counts above 0
constexpr double LIGHT = 0.92;                       ///< the shade of few, as shown
constexpr std::size_t BATCH = 1U << 18U;

/// A sheet's rays, root space.
class SheetRays {
 public:
  SheetRays(const RootTransform& root, const Sheet& sheet)
      : plane_(image_plane(root, {sheet.camera(), sheet.width, sheet.height})) {}

  /// Through position (x, y), pixels.
  [[nodiscard]] RayQuery at(double x, double y) const {
    RayQuery ray{};
    ray.origin = vec3(plane_.eye + plane_.corner + x * plane_.dx + y * plane_.dy);
    ray.dir = vec3(plane_.forward);
    ray.from_object = NO_OBJECT;
    return ray;
  }

 private:
  ImagePlane plane_;
};

std::vector<std::uint32_t> counts_of(Tracer& tracer, const Look& look, const std::vector<RayQuery>& rays,
                                     const Settings& settings) {
  std::vector<std::uint32_t> counts;
  for (const RayHit& hit : tracer.intersect(look, rays, settings))
    counts.push_back(hit.object == NO_OBJECT ? 0 : hit.members);
  return counts;
}

/// What counts are shown as: LIGHT for the lightest, 0 for the blackest, by the logarithm.
struct Shades {
  double light = 0.0, black = 1.0;  ///< log2(1 + count)

  [[nodiscard]] float linear(std::uint32_t count) const {
    const double share = (std::log2(1.0 + count) - light) / std::max(black - light, 1.0);
    return srgb_to_linear(static_cast<float>(std::clamp(LIGHT * (1.0 - share), 0.0, 1.0)));
  }
};

Shades shades_of(Tracer& tracer, const Look& look, const SheetRays& rays, const Sheet& sheet,
                 const Settings& settings) {
  std::vector<RayQuery> grid;
  for (std::uint32_t i = 0; i < GRID * GRID; ++i)
    grid.push_back(rays.at((i % GRID + 0.5) / GRID * sheet.width, (i / GRID + 0.5) / GRID * sheet.height));
  std::vector<double> counts;
  for (const std::uint32_t count : counts_of(tracer, look, grid, settings))
    if (count > 0) counts.push_back(std::log2(1.0 + count));
  if (counts.empty()) return {};
  return {value_at(counts, LIGHTEST), value_at(counts, BLACKEST)};
}

}  // namespace

Image xray_image(Tracer& tracer, const RootTransform& root, const Look& look, const Sheet& sheet,
                 const PixelWindow& window, const Settings& asked, const Tracer::Progress& progress) {
  Settings settings = asked;
  settings.blend = BLEND_COUNT;
  const SheetRays rays(root, sheet);
  const Shades shades = shades_of(tracer, look, rays, sheet, settings);
  Image image{window.width, window.height, {}, {}};
  const std::size_t pixels = std::size_t{window.width} * window.height;
  image.rgba.reserve(pixels);
  std::vector<RayQuery> batch;
  for (std::size_t i = 0; i < pixels; ++i) {
    batch.push_back(rays.at(window.x + static_cast<double>(i % window.width) + 0.5,
                            window.y + static_cast<double>(i / window.width) + 0.5));
    if (batch.size() < BATCH && i + 1 < pixels) continue;
    for (const std::uint32_t count : counts_of(tracer, look, batch, settings))
      image.rgba.push_back(count > 0 ? vec4(vec3(shades.linear(count)), 1.0F) : vec4(0.0F));
    batch.clear();
    if (progress && !progress(static_cast<double>(i + 1) / static_cast<double>(pixels)))
      throw Error(ExitCode::interrupted, "rendering was interrupted");
  }
  return image;
}

}  // namespace splatray
