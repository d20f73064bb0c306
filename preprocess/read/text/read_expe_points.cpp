#include "preprocess/read/text/read_expe_points.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "preprocess/base/little_endian.h"
#include "preprocess/read/bytes/byte_reader.h"
#include "preprocess/read/float_precision.h"
#include "preprocess/read/scan/missing_points.h"

namespace splatray {
namespace {

constexpr std::string_view MAGIC = "[Expe/PointSet/Binary";
constexpr std::size_t MOST_EXPE_LINE_BYTES = 256;
constexpr int MOST_HEADER_LINES = 100;
constexpr std::size_t MOST_PROPERTY_BYTES = 4096;

/// Where the bytes of a point stand; -1 = absent.
struct Layout {
  int position = -1;
  int radius = -1;
  int normal = -1;
  int color = -1;
  std::size_t stride = 0;
  std::uint64_t count = 0;
};

void add_property(const ByteReader& in, std::istringstream& words, Layout& layout) {
  std::string name;
  std::size_t bytes = 0;
  words >> name >> bytes;
  if (!words || bytes == 0 || bytes > MOST_PROPERTY_BYTES)
    throw_unreadable(in.path(), "found the property '" + name + "' without a size, expected 1 to 4096 bytes");
  const std::pair<const char*, std::pair<int*, std::size_t>> known[] = {{"position", {&layout.position, 12}},
                                                                        {"radius", {&layout.radius, 4}},
                                                                        {"normal", {&layout.normal, 12}},
                                                                        {"color", {&layout.color, 4}}};
  for (const auto& [property, place] : known)
    if (name == property && bytes == place.second) *place.first = static_cast<int>(layout.stride);
  layout.stride += bytes;
}

Layout read_layout(ByteReader& in) {
  Layout layout;
  std::string_view line;
  for (int lines = 0; lines < MOST_HEADER_LINES && in.line(line, MOST_EXPE_LINE_BYTES); ++lines) {
    std::istringstream words{std::string(line)};
    std::string key;
    words >> key;
    if (key == "data" && layout.position >= 0) return layout;
    if (key == "property") add_property(in, words, layout);
    if (key == "nofpoints" && !(words >> layout.count))
      throw_unreadable(in.path(), "found no count after 'nofpoints', expected a whole number");
  }
  throw_unreadable(in.path(), "found an Expe point set without 'property position 12' and 'data' lines");
}

void append_point(const unsigned char* bytes, const Layout& layout, ScanFile& file) {
  Points& points = file.points;
  const glm::dvec3 position(load<glm::vec3>(bytes + layout.position));
  if (!std::isfinite(position.x + position.y + position.z)) {
    ++file.counts.no_return;
    return;
  }
  points.position.push_back(position);
  if (layout.radius >= 0) points.radius.push_back(load<float>(bytes + layout.radius));
  if (layout.normal >= 0) points.normal.push_back(load<glm::vec3>(bytes + layout.normal));
  if (layout.color >= 0) points.stored_color.emplace_back(load<glm::u8vec3>(bytes + layout.color));
}

}  // namespace

bool is_expe_points(const std::filesystem::path& path) {
  ByteReader in(path);
  const unsigned char* bytes = in.remaining() < MAGIC.size() ? nullptr : in.take(MAGIC.size());
  return bytes != nullptr && std::memcmp(bytes, MAGIC.data(), MAGIC.size()) == 0;
}

ScanFile read_expe_points(const std::filesystem::path& path, const ReadOptions& options,
                          const ReadListener& listener) {
  ByteReader in(path, &listener);
  const Layout layout = read_layout(in);
  ScanFile file;
  file.up = {0.0, 1.0, 0.0};
  file.counts.stored = layout.count;
  file.points.stored_color_most = 255;
  const std::uint64_t present = std::min<std::uint64_t>(layout.count, in.remaining() / layout.stride);
  for (std::uint64_t i = 0; i < present; ++i) {
    const unsigned char* bytes = in.take(layout.stride);
    if (bytes == nullptr) throw_unreadable(path, "it could not be read to its end");
    append_point(bytes, layout, file);
  }
  file.counts.missing = layout.count - present;
  report_missing(path, file.counts, options.scans, listener);
  note_float_precision(file.points, path, listener);
  return file;
}

}  // namespace splatray
