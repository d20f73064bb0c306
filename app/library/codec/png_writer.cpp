#include "app/library/codec/png_writer.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <string>
#include <string_view>

#include "engine/base/all_cores.h"

namespace splatray {
namespace {

using Bytes = std::vector<unsigned char>;

/// libdeflate's, 1 to 12: 3 takes a third longer, for 3 percent of the file.
constexpr int PNG_LEVEL = 1;
constexpr std::size_t CHUNK_BYTES = std::size_t{1} << 30U;  ///< a chunk has less than 2^31
constexpr std::size_t ROWS_TOGETHER = 32;                   ///< filtered by one thread
constexpr std::size_t FILTERS = 5;                          ///< none, left, up, average, Paeth (section 9.2)

void append_big_endian(std::uint32_t value, Bytes& bytes) {
  for (const unsigned shift : {24U, 16U, 8U, 0U})
    bytes.push_back(static_cast<unsigned char>(value >> shift & 0xFFU));
}

void append_chunk(std::string_view name, const void* data, std::size_t size, Bytes& bytes) {
  append_big_endian(static_cast<std::uint32_t>(size), bytes);
  const std::size_t begin = bytes.size();
  bytes.insert(bytes.end(), name.begin(), name.end());
  const auto* from = static_cast<const unsigned char*>(data);
  bytes.insert(bytes.end(), from, from + size);
  append_big_endian(libdeflate_crc32(0, bytes.data() + begin, bytes.size() - begin), bytes);
}

void append_chunk(std::string_view name, const Bytes& data, Bytes& bytes) {
  append_chunk(name, data.data(), data.size(), bytes);
}

/// Whichever of the pixels to the left, above and above to the left is nearest to left + up - corner (section 9.4).
int paeth(int left, int up, int corner) {
  const int to_left = std::abs(up - corner), to_up = std::abs(left - corner),
            to_corner = std::abs(left + up - 2 * corner);
  const int of_two = to_up <= to_corner ? up : corner;
  return to_left <= to_up && to_left <= to_corner ? left : of_two;
}

/// A row by each of the filters. `now` and `above` have a pixel of zeros before them.
void filter_row(const unsigned char* now, const unsigned char* above, std::size_t pixel, std::size_t count,
                std::array<Bytes, FILTERS>& filtered) {
  const unsigned char *left = now - pixel, *corner = above - pixel;
  const auto by = [&](std::size_t filter, const auto& expected) {
    unsigned char* out = filtered[filter].data() + 1;
    for (std::size_t i = 0; i < count; ++i) out[i] = static_cast<unsigned char>(now[i] - expected(i));
  };
  by(0, [](std::size_t) { return 0; });
  by(1, [=](std::size_t i) { return int{left[i]}; });
  by(2, [=](std::size_t i) { return int{above[i]}; });
  by(3, [=](std::size_t i) { return (left[i] + above[i]) / 2; });
  by(4, [=](std::size_t i) { return paeth(left[i], above[i], corner[i]); });
}

/// How large a filtered row's bytes are in all, as signed numbers: the least promises the smallest file (section 12.7).
std::uint64_t size_of(const Bytes& row) {
  std::uint64_t sum = 0;
  for (std::size_t i = 1; i < row.size(); ++i) {
    const std::uint32_t value = row[i];
    sum += std::min(value, 256U - value);
  }
  return sum;
}

/// Rows begin .. end - 1, each filtered by what makes it smallest, behind that filter's number.
void filter_rows(const unsigned char* values, std::size_t pixel, std::size_t count, std::size_t begin,
                 std::size_t end, unsigned char* out) {
  Bytes now(pixel + count), above(pixel + count);
  std::array<Bytes, FILTERS> filtered;
  for (std::size_t i = 0; i < FILTERS; ++i)
    filtered[i].assign(1 + count, static_cast<unsigned char>(i));  // the number stays, the row is overwritten
  if (begin > 0) std::copy_n(values + (begin - 1) * count, count, above.data() + pixel);
  for (std::size_t row = begin; row < end; ++row) {
    std::copy_n(values + row * count, count, now.data() + pixel);
    filter_row(now.data() + pixel, above.data() + pixel, pixel, count, filtered);
    std::array<std::uint64_t, FILTERS> sizes{};
    std::transform(filtered.begin(), filtered.end(), sizes.begin(), size_of);
    const auto least = std::min_element(sizes.begin(), sizes.end()) - sizes.begin();
    std::copy_n(filtered[static_cast<std::size_t>(least)].data(), 1 + count, out + row * (1 + count));
    std::swap(now, above);
  }
}

/// All rows, filtered on all cores.
Bytes filtered_rows(const PictureHeader& header, const unsigned char* values) {
  const std::size_t pixel = header.channels.size(), count = pixel * static_cast<std::size_t>(header.width);
  const auto rows = static_cast<std::size_t>(header.height);
  Bytes all(rows * (1 + count));
  on_all_cores((rows + ROWS_TOGETHER - 1) / ROWS_TOGETHER, [&](std::size_t i) {
    const std::size_t begin = i * ROWS_TOGETHER;
    filter_rows(values, pixel, count, begin, std::min(begin + ROWS_TOGETHER, rows), all.data());
  });
  return all;
}

Bytes compressed(const Bytes& bytes) {
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(PNG_LEVEL), libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  Bytes made(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()));
  made.resize(
      libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), made.data(), made.size()));
  return made;
}

Bytes header_chunk(const PictureHeader& header) {
  constexpr unsigned char BITS = 8, RGB = 2, RGBA = 6;
  Bytes chunk;
  append_big_endian(static_cast<std::uint32_t>(header.width), chunk);
  append_big_endian(static_cast<std::uint32_t>(header.height), chunk);
  for (const unsigned char byte :
       {BITS, header.channels.size() == 4 ? RGBA : RGB, static_cast<unsigned char>(0),
        static_cast<unsigned char>(0), static_cast<unsigned char>(0)})
    chunk.push_back(byte);
  return chunk;
}

void append_pixel_size(double dots_per_inch, Bytes& bytes) {
  constexpr double INCHES_PER_METRE = 1.0 / 0.0254;
  constexpr unsigned char PER_METRE = 1;
  const auto dots = static_cast<std::uint32_t>(std::lround(dots_per_inch * INCHES_PER_METRE));
  Bytes chunk;
  append_big_endian(dots, chunk);
  append_big_endian(dots, chunk);
  chunk.push_back(PER_METRE);
  append_chunk("pHYs", chunk, bytes);
}

/// That the picture is a whole panorama, for viewers of such (Google, "Photo Sphere XMP Metadata").
void append_panorama(const PictureHeader& header, Bytes& bytes) {
  const std::string width = std::to_string(header.width), height = std::to_string(header.height);
  std::string text("XML:com.adobe.xmp\0\0\0\0\0", 22);
  text +=
      "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:RDF "
      "xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">"
      "<rdf:Description rdf:about=\"\" xmlns:GPano=\"http://ns.google.com/photos/1.0/panorama/\""
      " GPano:UsePanoramaViewer=\"True\" GPano:ProjectionType=\"equirectangular\""
      " GPano:FullPanoWidthPixels=\"" +
      width + "\" GPano:FullPanoHeightPixels=\"" + height + "\" GPano:CroppedAreaImageWidthPixels=\"" +
      width + "\" GPano:CroppedAreaImageHeightPixels=\"" + height +
      "\" GPano:CroppedAreaLeftPixels=\"0\" GPano:CroppedAreaTopPixels=\"0\"/></rdf:RDF></x:xmpmeta>";
  append_chunk("iTXt", text.data(), text.size(), bytes);
}

}  // namespace

std::vector<unsigned char> encode_png(const PictureHeader& header, const unsigned char* values) {
  Bytes bytes = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  append_chunk("IHDR", header_chunk(header), bytes);
  append_chunk("sRGB", Bytes{0}, bytes);
  if (header.dots_per_inch > 0.0) append_pixel_size(header.dots_per_inch, bytes);
  for (const auto& [name, value] : header.attributes) {
    if (!name.starts_with("splatray.")) continue;
    const std::string text = name + '\0' + value;
    append_chunk("tEXt", text.data(), text.size(), bytes);
    const bool whole = header.width == 2 * header.height;  // a part has another shape
    if (whole && name == "splatray.projection" && value == "equirectangular") append_panorama(header, bytes);
  }
  const Bytes pixels = compressed(filtered_rows(header, values));
  for (std::size_t at = 0; at < pixels.size(); at += CHUNK_BYTES)
    append_chunk("IDAT", pixels.data() + at, std::min(CHUNK_BYTES, pixels.size() - at), bytes);
  append_chunk("IEND", Bytes{}, bytes);
  return bytes;
}

}  // namespace splatray
