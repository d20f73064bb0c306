#include "data/oriented_points.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <fstream>

#include "engine/base/error.h"

namespace splatray {
namespace {

static_assert(std::endian::native == std::endian::little, "write_ply writes the machine's own byte order");

/// sRGB (IEC 61966-2-1) byte of a linear value.
std::uint8_t srgb_byte(double linear) {
  const double value = std::clamp(linear, 0.0, 1.0);
  const double encoded = value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255.0 * encoded));
}

void append_floats(std::vector<char>& bytes, glm::dvec3 value) {
  const glm::vec3 narrow(value);
  const std::size_t begin = bytes.size();
  bytes.resize(begin + sizeof narrow);
  std::memcpy(bytes.data() + begin, &narrow, sizeof narrow);
}

}  // namespace

OrientedPoints moved(OrientedPoints cloud, glm::dvec3 offset, const glm::dmat3& axes) {
  for (glm::dvec3& position : cloud.position) position = axes * position + offset;
  for (glm::dvec3& normal : cloud.normal) normal = axes * normal;
  return cloud;
}

OrientedPoints flipped(OrientedPoints cloud) {
  for (glm::dvec3& normal : cloud.normal) normal = -normal;
  return cloud;
}

OrientedPoints painted(OrientedPoints cloud, const Paint& paint) {
  cloud.color.clear();
  for (const glm::dvec3& position : cloud.position) cloud.color.push_back(paint(position));
  return cloud;
}

OrientedPoints kept(const OrientedPoints& cloud, const std::function<bool(glm::dvec3)>& keep) {
  OrientedPoints result;
  for (std::size_t i = 0; i < cloud.position.size(); ++i) {
    if (!keep(cloud.position[i])) continue;
    result.position.push_back(cloud.position[i]);
    result.normal.push_back(cloud.normal[i]);
    if (!cloud.color.empty()) result.color.push_back(cloud.color[i]);
  }
  return result;
}

void append(OrientedPoints& cloud, const OrientedPoints& more) {
  assert(cloud.position.empty() || more.position.empty() || cloud.color.empty() == more.color.empty());
  cloud.position.insert(cloud.position.end(), more.position.begin(), more.position.end());
  cloud.normal.insert(cloud.normal.end(), more.normal.begin(), more.normal.end());
  cloud.color.insert(cloud.color.end(), more.color.begin(), more.color.end());
  cloud.is_scan = cloud.is_scan || more.is_scan;
}

void write_ply(const OrientedPoints& cloud, const std::filesystem::path& path) {
  const bool has_color = !cloud.color.empty();
  std::vector<char> bytes;
  for (std::size_t i = 0; i < cloud.position.size(); ++i) {
    append_floats(bytes, cloud.position[i]);
    if (!cloud.is_scan) append_floats(bytes, cloud.normal[i]);
    for (int channel = 0; has_color && channel < 3; ++channel) {
      bytes.push_back(static_cast<char>(srgb_byte(cloud.color[i][channel])));
    }
  }
  std::ofstream file(path, std::ios::binary);
  file << "ply\nformat binary_little_endian 1.0\ncomment made by splatray-generate\nelement vertex "
       << cloud.position.size() << "\nproperty float x\nproperty float y\nproperty float z\n"
       << (cloud.is_scan ? "" : "property float nx\nproperty float ny\nproperty float nz\n")
       << (has_color ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : "")
       << "end_header\n";
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw Error(ExitCode::failed, path.string() + ": cannot be written");
}

}  // namespace splatray
