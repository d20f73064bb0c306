#include "preprocess/read/las/las_header.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "engine/base/utf8.h"
#include "preprocess/base/little_endian.h"

namespace splatray {
namespace {

constexpr std::size_t LEAST_LAS_HEADER_BYTES = 227;  ///< of LAS 1.0 to 1.2
constexpr std::size_t HEADER_BYTES_1_4 = 375;        ///< with 64-bit counts and the extended records
/// LASzip sets the highest bit of the format, an early one the next.
constexpr unsigned COMPRESSED_FORMAT_BITS = 192;
constexpr unsigned MOST_POINT_FORMAT = 10;

constexpr LasFields FIELDS[] = {
    {20, 0, 0, 0},  {28, 20, 0, 0},  {26, 0, 20, 0},   {34, 20, 28, 0}, {57, 20, 0, 0},   {63, 20, 28, 0},
    {30, 22, 0, 0}, {36, 22, 30, 0}, {38, 22, 30, 36}, {59, 22, 0, 0},  {67, 22, 30, 36},
};

glm::dvec3 load_vector(const unsigned char* bytes) {
  return {load<double>(bytes), load<double>(bytes + 8), load<double>(bytes + 16)};
}

/// A field of 32 bytes, up to its first zero.
std::string load_text(const unsigned char* bytes) {
  constexpr std::size_t TEXT_BYTES = 32;
  return to_utf8(std::string(bytes, std::find(bytes, bytes + TEXT_BYTES, 0)));
}

/// What only people read.
void load_making(const unsigned char* bytes, LasHeader& header) {
  header.system = load_text(bytes + 26);
  header.software = load_text(bytes + 58);
  header.day = load<std::uint16_t>(bytes + 90);
  header.year = load<std::uint16_t>(bytes + 92);
  for (int axis = 0; axis < 3; ++axis) {
    header.box_high[axis] = load<double>(bytes + 179 + 16 * axis);
    header.box_low[axis] = load<double>(bytes + 187 + 16 * axis);
  }
}

/// Counts and places of LAS 1.4, which the header has behind the older ones.
void load_1_4(const unsigned char* bytes, LasHeader& header) {
  header.evlr_offset = load<std::uint64_t>(bytes + 235);
  header.evlr_count = load<std::uint32_t>(bytes + 243);
  const auto count = load<std::uint64_t>(bytes + 247);
  // Some programs fill only the older field.
  header.point_count = count != 0 ? count : header.point_count;
}

void check(const LasHeader& header, const std::filesystem::path& path) {
  const std::string format = std::to_string(header.point_format);
  if (header.point_format > MOST_POINT_FORMAT)
    throw_unreadable(path, "found point format " + format + ", expected 0 to 10");
  const std::size_t least = las_fields(header.point_format).bytes;
  if (header.record_bytes < least)
    throw_unreadable(path, "found records of " + std::to_string(header.record_bytes) +
                               " bytes, expected at least " + std::to_string(least) + " in point format " +
                               format);
  constexpr double MOST_STORED = 2147483648.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double scale = header.scale[axis];
    if (scale == 0.0 || !std::isfinite(std::abs(scale) * MOST_STORED + std::abs(header.offset[axis])))
      throw_unreadable(path, "found scale " + std::to_string(scale) + " and offset " +
                                 std::to_string(header.offset[axis]) + " of " + "xyz"[axis] +
                                 ", expected finite numbers and a scale that is not 0");
  }
}

}  // namespace

LasFields las_fields(unsigned point_format) { return FIELDS[point_format]; }

LasHeader read_las_header(ByteReader& in) {
  const std::uint64_t size = in.remaining();
  const unsigned char* bytes = in.take(std::min<std::size_t>(size, LEAST_LAS_HEADER_BYTES));
  if (bytes == nullptr || size < LEAST_LAS_HEADER_BYTES || std::memcmp(bytes, "LASF", 4) != 0)
    throw_unreadable(in.path(), "found no LAS header, expected LASF and " +
                                    std::to_string(LEAST_LAS_HEADER_BYTES) + " bytes or more");
  LasHeader header;
  header.version_minor = bytes[25];
  if (bytes[24] != 1 || header.version_minor > 5)
    throw_unreadable(in.path(), "found LAS version " + std::to_string(bytes[24]) + "." +
                                    std::to_string(header.version_minor) + ", expected 1.0 to 1.5");
  header.header_bytes = load<std::uint16_t>(bytes + 94);
  header.points_offset = load<std::uint32_t>(bytes + 96);
  header.vlr_count = load<std::uint32_t>(bytes + 100);
  header.is_compressed = (bytes[104] & COMPRESSED_FORMAT_BITS) != 0;
  header.point_format = bytes[104] & ~COMPRESSED_FORMAT_BITS;
  header.record_bytes = load<std::uint16_t>(bytes + 105);
  header.point_count = load<std::uint32_t>(bytes + 107);
  header.scale = load_vector(bytes + 131);
  header.offset = load_vector(bytes + 155);
  load_making(bytes, header);
  if (header.version_minor >= 4 && header.header_bytes >= HEADER_BYTES_1_4 && size >= HEADER_BYTES_1_4) {
    in.seek(0);
    bytes = in.take(HEADER_BYTES_1_4);
    if (bytes == nullptr) throw_unreadable(in.path(), "it could not be read to its end");
    load_1_4(bytes, header);
  }
  check(header, in.path());
  if (header.points_offset > size || header.points_offset < LEAST_LAS_HEADER_BYTES)
    throw_unreadable(in.path(), "found points said to begin at byte " + std::to_string(header.points_offset) +
                                    ", expected " + std::to_string(LEAST_LAS_HEADER_BYTES) +
                                    " to the file's " + std::to_string(size) + " bytes");
  return header;
}

}  // namespace splatray
