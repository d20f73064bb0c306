#include "tests/bench/regression/figures.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "app/library/image_file.h"
#include "engine/base/error.h"
#include "tests/bench/cases/statistics.h"
#include "tests/bench/regression/input_files.h"
#include "tests/bench/regression/source_mesh.h"
#include "tests/bench/truth/mesh_truth.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

constexpr double FAR = 0.01;    // of the diagonal
constexpr double MOVED = 2e-3;  // of the diagonal: several times a scanner's noise
constexpr double PPM = 1e6;

/// What a pixel shows: of a miss the depth is +inf.
struct Shown {
  double depth;
  dvec3 normal;
};

std::vector<Shown> shown_in(const std::filesystem::path& path, const View& view) {
  const ExrPicture picture = read_exr(path);
  const auto& names = picture.channels;
  std::array<std::size_t, 4> at{};
  const std::array<const char*, 4> wanted{"Z", "N.X", "N.Y", "N.Z"};
  for (std::size_t i = 0; i < at.size(); ++i) {
    at[i] = static_cast<std::size_t>(std::find(names.begin(), names.end(), wanted[i]) - names.begin());
    if (at[i] == names.size() || picture.width != view.width || picture.height != view.height)
      throw Error(ExitCode::input_unreadable, path.string() + ": found no channel " + wanted[i] +
                                                  " of a whole picture, expected --aov depth,normal");
  }
  std::vector<Shown> shown;
  for (std::size_t i = 0; i < picture.values.size(); i += names.size()) {
    const auto value = [&](std::size_t channel) {
      return static_cast<double>(picture.values[i + at[channel]]);
    };
    shown.push_back({value(0), {value(1), value(2), value(3)}});
  }
  return shown;
}

/// Sums over pixels.
struct PixelSums {
  double pixels = 0.0, wrong = 0.0, far = 0.0, inner = 0.0, holes = 0.0;
  std::vector<double> depths, angles;

  void add(const Shown& shown, const TruePixel& truth, double jump_world, double diagonal) {
    const bool hit = std::isfinite(shown.depth);
    pixels += 1.0;
    wrong += hit != truth.hit() ? 1.0 : 0.0;
    if (truth.hit() && !truth.edge) {
      inner += 1.0;
      holes += shown.depth > truth.depth_world + jump_world ? 1.0 : 0.0;
    }
    if (!hit || !truth.hit()) return;
    const double depth = (shown.depth - truth.depth_world) / diagonal;
    far += depth < -FAR ? 1.0 : 0.0;
    depths.push_back(std::abs(depth));
    angles.push_back(angle_deg(shown.normal, truth.normal_world));
  }
};

Points points_of(const std::filesystem::path& path) {
  return std::move(read_input({path}, {}).objects.front().points);
}

/// Points by cells of a grid, to find near ones.
class NearPoints {
 public:
  NearPoints(const std::vector<dvec3>& places, double reach) : places_(places), reach_(reach) {
    for (std::size_t i = 0; i < places.size(); ++i) cells_[key(cell(places[i]))].push_back(i);
  }

  /// The nearest within reach; all numbers there are where there is none.
  [[nodiscard]] std::size_t nearest(const dvec3& place) const {
    std::size_t best = places_.size();
    double least = reach_ * reach_;
    for (int i = 0; i < 27; ++i) {
      const auto found = cells_.find(key(cell(place) + glm::i64vec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1)));
      if (found == cells_.end()) continue;
      for (const std::size_t point : found->second) {
        const dvec3 off = places_[point] - place;
        if (glm::dot(off, off) <= least) least = glm::dot(off, off), best = point;
      }
    }
    return best;
  }

 private:
  [[nodiscard]] glm::i64vec3 cell(const dvec3& place) const {
    return glm::i64vec3(glm::floor(place / reach_));
  }
  static std::int64_t key(const glm::i64vec3& cell) {
    return (cell.x * 73856093) ^ (cell.y * 19349663) ^ (cell.z * 83492791);
  }

  const std::vector<dvec3>& places_;
  double reach_;
  std::unordered_map<std::int64_t, std::vector<std::size_t>> cells_;
};

double diagonal_of(const std::vector<dvec3>& places) {
  dvec3 low(INFINITY), high(-INFINITY);
  for (const dvec3& place : places) low = glm::min(low, place), high = glm::max(high, place);
  return glm::length(high - low);
}

/// What reaches the eye of what is covered, the mean of rgb.
double light_of(const vec4& pixel) {
  return static_cast<double>(pixel.a) * static_cast<double>(pixel.r + pixel.g + pixel.b) / 3.0;
}

bool on_surface(PointKind kind) { return kind == PointKind::surface || kind == PointKind::leaf; }

}  // namespace

Figures picture_figures(const std::filesystem::path& mesh, const std::vector<PictureOfMesh>& pictures) {
  const Mesh source = source_mesh(mesh);
  const auto [low, high] = box_of(source);
  const double diagonal = glm::length(high - low);
  PixelSums sums;
  for (const PictureOfMesh& one : pictures) {
    const ExrPicture head = read_exr_header(one.picture);
    const View view{one.camera, head.width, head.height};
    const Truth truth = mesh_truth(source, view);
    const std::vector<Shown> shown = shown_in(one.picture, view);
    for (std::size_t i = 0; i < shown.size(); ++i)
      sums.add(shown[i], truth.pixels[i], truth.jump_world, diagonal);
  }
  return {{"wrong", PPM * sums.wrong / sums.pixels},
          {"holes", PPM * sums.holes / std::max(sums.inner, 1.0)},
          {"far", PPM * sums.far / sums.pixels},
          {"depth p50", PPM * quantile(sums.depths, 0.5)},
          {"depth p95", PPM * quantile(sums.depths, 0.95)},
          {"normals p50", quantile(sums.angles, 0.5)},
          {"normals p95", quantile(sums.angles, 0.95)},
          {"normals p99", quantile(sums.angles, 0.99)},
          {"pixels", sums.pixels}};
}

Figures point_figures(const std::filesystem::path& scan, const std::filesystem::path& truth_folder,
                      const std::filesystem::path& drawn_file) {
  const Points measured = points_of(scan), drawn = points_of(drawn_file);
  const PointTruth truth = read_point_truth(truth_folder);
  if (truth.kind.size() != measured.size())
    throw Error(ExitCode::input_unreadable, truth_folder.string() + ": found the truth of " +
                                                std::to_string(truth.kind.size()) + " points, expected " +
                                                std::to_string(measured.size()) + " as " + scan.string());
  const NearPoints near(measured.position, MOVED * diagonal_of(measured.position));
  std::vector<bool> shown(measured.size());
  std::vector<double> angles;
  double moved = 0.0, wrong = 0.0;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const std::size_t point = near.nearest(drawn.position[i]);
    if (point == measured.size()) {
      moved += 1.0;
      continue;
    }
    shown[point] = true;
    if (truth.kind[point] != PointKind::surface) continue;
    const double angle = angle_deg(dvec3(drawn.normal[i]), dvec3(truth.normal[point]));
    wrong += angle > 90.0 ? 1.0 : 0.0;
    angles.push_back(std::min(angle, 180.0 - angle));
  }
  double good = 0.0, lost = 0.0, bad = 0.0, strays = 0.0;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const bool surface = on_surface(truth.kind[i]);
    (surface ? good : bad) += 1.0;
    if (surface != shown[i]) (surface ? lost : strays) += 1.0;
  }
  return {{"sides", PPM * wrong / std::max(static_cast<double>(angles.size()), 1.0)},
          {"normals p50", quantile(angles, 0.5)},
          {"normals p95", quantile(angles, 0.95)},
          {"lost", PPM * lost / std::max(good, 1.0)},
          {"strays", 100.0 * strays / std::max(bad, 1.0)},
          {"moved", PPM * moved / std::max(static_cast<double>(drawn.size()), 1.0)}};
}

Figures light_figures(const std::filesystem::path& picture) {
  const Image image = image_of(read_exr(picture));
  double light = 0.0, cover = 0.0;
  for (const vec4& pixel : image.rgba) {
    light += light_of(pixel);
    cover += static_cast<double>(pixel.a);
  }
  return {{"light", light / std::max(cover, 1e-9)},
          {"cover", cover / static_cast<double>(image.rgba.size())}};
}

std::vector<std::vector<double>> part_means(const std::filesystem::path& picture, std::uint32_t parts) {
  const Image image = image_of(read_exr(picture));
  const std::uint32_t width = image.width / parts, height = image.height / parts;
  std::vector<std::vector<double>> means(parts, std::vector<double>(parts, 0.0));
  for (std::uint32_t y = 0; y < parts * height; ++y)
    for (std::uint32_t x = 0; x < parts * width; ++x)
      means[y / height][x / width] +=
          light_of(image.rgba[std::size_t{y} * image.width + x]) / (width * height);
  return means;
}

}  // namespace splatray::testing
