#include "preprocess/read/scan/read_kitti.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "preprocess/read/byte_reader.h"

namespace splatray {

ScanFile read_kitti(const std::filesystem::path& path, const ReadOptions& /*options*/,
                    const ReadListener& listener) {
  constexpr std::size_t POINT_BYTES = 16;
  constexpr float MOST_METRES = 1000.0F;
  constexpr float MOST_REFLECTANCE = 255.0F;
  const std::string expected = ", expected float32 x y z reflectance of a sweep (KITTI)";
  ByteReader in(path, &listener);
  if (in.remaining() % POINT_BYTES != 0)
    throw_unreadable(path, "found " + std::to_string(in.remaining()) + " bytes" + expected);
  ScanFile file;
  file.counts.stored = in.remaining() / POINT_BYTES;
  std::vector<float> reflectance;
  for (std::uint64_t i = 0; i < file.counts.stored; ++i) {
    const unsigned char* bytes = in.take(POINT_BYTES);
    if (bytes == nullptr) throw_unreadable(path, "it could not be read to its end");
    float v[4];
    std::memcpy(v, bytes, sizeof v);
    const float away = std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])});
    const bool finite = std::isfinite(v[0] + v[1] + v[2] + v[3]);
    if (!finite || away > MOST_METRES || v[3] < 0.0F || v[3] > MOST_REFLECTANCE)
      throw_unreadable(path,
                       "found no plausible point at byte " + std::to_string(i * POINT_BYTES) + expected);
    file.points.position.emplace_back(v[0], v[1], v[2]);
    reflectance.push_back(v[3]);
  }
  file.points.columns.push_back({std::string(COLUMN_INTENSITY), std::move(reflectance)});
  file.points.stations = {{"", glm::dvec3(0.0), 0, 0}};
  return file;
}

}  // namespace splatray
