#include "preprocess/read/scan/read_kitti.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string_view>

#include "preprocess/read/bytes/byte_reader.h"
#include "preprocess/read/scan/narrow_column.h"

namespace splatray {
namespace {

/// No coordinate of a map on Earth is farther; bytes of other files soon are.
constexpr float MOST_METRES = 1e7F;
constexpr float MOST_RING = 255.0F;
constexpr std::string_view RING_COLUMN = "ring";

/// The floats of one point.
using Floats = std::array<float, 5>;

Floats floats_at(const std::vector<unsigned char>& bytes, std::size_t at, std::size_t width) {
  Floats v{};
  std::memcpy(v.data(), bytes.data() + at, width * sizeof(float));
  return v;
}

bool has_position(const Floats& v) { return std::isfinite(v[0] + v[1] + v[2]); }

/// A position that is not finite is none of a return.
bool is_plausible(const Floats& v) {
  const float away = std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])});
  const bool ring = v[4] >= 0.0F && v[4] <= MOST_RING && v[4] == std::floor(v[4]);
  return !has_position(v) || (away <= MOST_METRES && ring);
}

/// The first byte of a point that is none of `width` floats; the end where all are, and the begin where none has a position.
std::size_t first_implausible(const std::vector<unsigned char>& bytes, std::size_t width) {
  std::size_t at = 0;
  bool has_any = false;
  for (; at < bytes.size() && is_plausible(floats_at(bytes, at, width)); at += width * sizeof(float))
    has_any = has_any || has_position(floats_at(bytes, at, width));
  return at == bytes.size() && !has_any ? 0 : at;
}

/// How many floats a point has: five where that makes sense of all bytes, as whole rings are no chance.
std::size_t floats_of_points(const std::vector<unsigned char>& bytes, const std::filesystem::path& path) {
  const std::string expected =
      ", expected float32 x y z reflectance of a sweep (KITTI), or these and a ring (nuScenes)";
  for (const std::size_t width : {5U, 4U})
    if (bytes.size() % (width * sizeof(float)) == 0 && first_implausible(bytes, width) == bytes.size())
      return width;
  const std::size_t width = bytes.size() % (4 * sizeof(float)) == 0 ? 4 : 5;
  if (bytes.size() % (width * sizeof(float)) != 0)
    throw_unreadable(path, "found " + std::to_string(bytes.size()) + " bytes" + expected);
  throw_unreadable(
      path, "found no plausible point at byte " + std::to_string(first_implausible(bytes, width)) + expected);
}

}  // namespace

ScanFile read_kitti(const std::filesystem::path& path, const ReadOptions& options,
                    const ReadListener& listener) {
  ByteReader in(path, &listener);
  const std::vector<unsigned char> bytes = in.read(in.remaining());
  const std::size_t width = floats_of_points(bytes, path);
  ScanFile file;
  file.counts.stored = bytes.size() / (width * sizeof(float));
  std::vector<float> reflectance;
  std::vector<double> ring;
  for (std::size_t at = 0; at < bytes.size(); at += width * sizeof(float)) {
    const Floats v = floats_at(bytes, at, width);
    if (!has_position(v)) {
      ++file.counts.no_return;
      continue;
    }
    file.points.position.emplace_back(v[0], v[1], v[2]);
    reflectance.push_back(std::isfinite(v[3]) ? v[3] : 0.0F);
    ring.push_back(v[4]);
  }
  if (file.counts.no_return > 0)
    listener.note(path, "left out what has no finite position: " + std::to_string(file.counts.no_return) +
                            " of " + std::to_string(file.counts.stored) + " points");
  file.points.columns.push_back({std::string(COLUMN_INTENSITY), std::move(reflectance)});
  const std::vector<std::string>& wanted = options.scans.attributes;
  if (width == 5 && std::find(wanted.begin(), wanted.end(), RING_COLUMN) != wanted.end())
    file.points.columns.push_back(narrow_column(RING_COLUMN, std::move(ring)));
  file.points.stations = {{"", glm::dvec3(0.0), 0, 0}};
  return file;
}

}  // namespace splatray
