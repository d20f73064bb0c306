#include "engine/scene/sky/sky_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace splatray {
namespace {

using std::numbers::pi;

/// Every cell gets at least this share of what it would have if all were equally bright.
constexpr double SHARE_LEAST = 1e-3;

double brightness(const glm::vec3& radiance) {
  return (double(radiance.x) + double(radiance.y) + double(radiance.z)) / 3.0;
}

/// The mean brightness around each texel, as far as filtering shows it; columns wrap.
std::vector<double> filtered_brightness(const Environment& environment) {
  const std::uint32_t width = environment.width, height = environment.height;
  std::vector<double> plain(environment.texels.size()), across(plain.size()), both(plain.size());
  std::transform(environment.texels.begin(), environment.texels.end(), plain.begin(), brightness);
  for (std::size_t row = 0; row < height; ++row)
    for (std::uint32_t column = 0; column < width; ++column) {
      const std::size_t first = row * width;
      across[first + column] = 0.25 * (plain[first + (column + width - 1) % width] +
                                       2.0 * plain[first + column] + plain[first + (column + 1) % width]);
    }
  for (std::size_t row = 0; row < height; ++row)
    for (std::uint32_t column = 0; column < width; ++column) {
      const std::size_t above = row > 0 ? row - 1 : row, below = std::min<std::size_t>(row + 1, height - 1);
      both[row * width + column] =
          0.25 * (across[above * width + column] + 2.0 * across[row * width + column] +
                  across[below * width + column]);
    }
  return both;
}

/// The light of each cell: brightness times solid angle, up to a factor.
std::vector<double> cell_light(const Environment& environment, std::uint32_t width, std::uint32_t height) {
  const std::vector<double> bright = filtered_brightness(environment);
  std::vector<double> light(std::size_t{width} * height);
  for (std::uint64_t row = 0; row < environment.height; ++row) {
    const double sine = std::sin(pi * (static_cast<double>(row) + 0.5) / environment.height);
    const std::uint64_t cell_row = row * height / environment.height;
    for (std::uint64_t column = 0; column < environment.width; ++column)
      light[cell_row * width + column * width / environment.width] +=
          sine * bright[row * environment.width + column];
  }
  return light;
}

/// Appends for each part of which share, of 2^32, those before it have; no part is left out of those that have a share.
void append_shares(std::span<const double> parts, std::vector<std::uint32_t>& words) {
  double sum = 0.0;
  for (const double part : parts) sum += part;
  const double floor_part = SHARE_LEAST * sum / static_cast<double>(parts.size());
  const double all = sum * (1.0 + SHARE_LEAST);
  double before = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const double even = static_cast<double>(i) / static_cast<double>(parts.size());
    const double share = all > 0.0 ? before / all : even;
    words.push_back(static_cast<std::uint32_t>(std::min(share * 4294967296.0, 4294967295.0)));
    before += parts[i] + floor_part;
  }
}

}  // namespace

SkyTable sky_table(const Environment& environment) {
  SkyTable table;
  if (environment.texels.empty()) return table;
  const std::uint32_t width = std::min(environment.width, SKY_COLUMNS_MOST);
  const std::uint32_t height = std::min(environment.height, SKY_COLUMNS_MOST / 2);
  const std::vector<double> light = cell_light(environment, width, height);
  std::vector<double> rows(height);
  double sum = 0.0, sines = 0.0;
  for (std::uint32_t row = 0; row < height; ++row) {
    for (std::uint32_t column = 0; column < width; ++column)
      rows[row] += light[std::size_t{row} * width + column];
    sum += rows[row];
  }
  if (!(sum > 0.0)) return table;
  for (std::uint32_t row = 0; row < environment.height; ++row)
    sines += std::sin(pi * (row + 0.5) / environment.height) * environment.width;
  table.width = width;
  table.height = height;
  table.irradiance_mean = pi * sum / sines;
  table.words.reserve(height + light.size());
  append_shares(rows, table.words);
  for (std::uint32_t row = 0; row < height; ++row)
    append_shares(std::span(light).subspan(std::size_t{row} * width, width), table.words);
  return table;
}

}  // namespace splatray
