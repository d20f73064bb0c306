#include "tests/bench/truth/errors.h"

#include <cassert>
#include <cmath>

#include "tests/bench/cases/statistics.h"
#include "tests/bench/truth/flip.h"
#include "tests/bench/truth/shading.h"

namespace splatray::testing {
namespace {

void count_mismatches(const Image& image, const Truth& truth, Errors& errors) {
  std::uint64_t edge = 0, inside = 0;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    const TruePixel& pixel = truth.pixels[i];
    if ((image.aov[i].object != NO_OBJECT) != pixel.hit()) ++(pixel.edge ? edge : inside);
  }
  const double ppm = 1e6 / static_cast<double>(truth.pixels.size());
  errors.mismatch_edge_ppm = ppm * static_cast<double>(edge);
  errors.mismatch_inside_ppm = ppm * static_cast<double>(inside);
  errors.mismatch_ppm = errors.mismatch_edge_ppm + errors.mismatch_inside_ppm;
}

void count_holes(const Image& image, const Truth& truth, Errors& errors) {
  std::uint64_t holes = 0;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    const TruePixel& pixel = truth.pixels[i];
    if (!pixel.hit() || pixel.edge) continue;
    ++errors.hole_rays;
    holes += image.aov[i].z > pixel.depth_world + truth.jump_world ? 1 : 0;
  }
  if (errors.hole_rays > 0) errors.holes = wilson_share(holes, errors.hole_rays);
}

void measure_geometry(const Image& image, const Truth& truth, double diagonal_world, Errors& errors) {
  std::vector<double> depths_inside, depths, angles;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    const TruePixel& pixel = truth.pixels[i];
    const AovPixel& shown = image.aov[i];
    if (!pixel.hit() || shown.object == NO_OBJECT) continue;
    const double depth = (shown.z - pixel.depth_world) / diagonal_world;
    if (!pixel.edge) depths_inside.push_back(depth);
    depths.push_back(std::abs(depth));
    angles.push_back(angle_deg(glm::dvec3(shown.normal), pixel.normal_world));
  }
  errors.depth_signed_mean = mean(depths_inside);
  errors.depth_abs_median = quantile(depths, 0.5);
  errors.depth_abs_p99 = quantile(depths, 0.99);
  errors.normal_median_deg = quantile(angles, 0.5);
  errors.normal_p95_deg = quantile(angles, 0.95);
  errors.normal_p99_deg = quantile(angles, 0.99);
  errors.normal_rms_deg = root_mean_square(angles);
}

void measure_shaded(const Image& image, const Truth& truth, const View& view, Errors& errors) {
  const auto shown = shaded_picture(view, [&](std::uint32_t x, std::uint32_t y) -> std::optional<glm::dvec3> {
    const AovPixel& pixel = image.aov[std::size_t{y} * view.width + x];
    if (pixel.object == NO_OBJECT) return {};
    return glm::dvec3(pixel.normal);
  });
  const auto wanted =
      shaded_picture(view, [&](std::uint32_t x, std::uint32_t y) -> std::optional<glm::dvec3> {
        const TruePixel& pixel = truth.pixels[std::size_t{y} * view.width + x];
        if (!pixel.hit()) return {};
        return pixel.normal_world;
      });
  errors.psnr_db = psnr_db(shown, wanted);
  errors.flip_mean = flip_mean(wanted, shown, view.width, view.height);
}

}  // namespace

Errors errors_of(const Image& image, const Truth& truth, const View& view, double diagonal_world) {
  assert(image.aov.size() == truth.pixels.size() && truth.width == view.width && truth.height == view.height);
  Errors errors;
  count_mismatches(image, truth, errors);
  count_holes(image, truth, errors);
  measure_geometry(image, truth, diagonal_world, errors);
  measure_shaded(image, truth, view, errors);
  return errors;
}

}  // namespace splatray::testing
