#include "app/library/image_codec.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace splatray {
namespace {

constexpr std::uint64_t DEFLATE = 1032;  ///< most bytes that one compressed byte gives: 258 for 2 bits

/// Bits of a pixel by a PNG's header; 1 if that has no known kind.
std::uint64_t png_bits(const std::string& path) {
  constexpr std::streamoff DEPTH = 24;
  constexpr std::uint64_t CHANNELS[] = {1, 1, 3, 1, 2, 1, 4};  // by kind of colour
  char field[2]{};
  std::ifstream file(path, std::ios::binary);
  if (!file.seekg(DEPTH).read(field, sizeof field)) return 1;
  const auto kind = static_cast<unsigned char>(field[1]);
  return kind < std::size(CHANNELS) ? CHANNELS[kind] * std::max<unsigned char>(1, field[0]) : 1;
}

/// Most pixels that a file of `bytes` can hold; no limit for formats other than our three.
std::uint64_t most_pixels(const std::string& path, const OIIO::ImageInput& input, std::uint64_t bytes) {
  const std::string format = input.format_name();
  if (format == "png") return bytes * DEFLATE * 8 / png_bits(path);
  if (format == "hdr") return bytes * 127 / 8;  // a run of up to 127 takes two bytes in each of four channels
  if (format != "openexr") return ~0ULL;
  const auto native = std::max<std::uint64_t>(1, input.spec().pixel_bytes(/*native=*/true));
  // Every compression but DWA, which gives a block of 64 values for a deflated one, is at most as good as deflate.
  const bool dwa = OIIO::Strutil::starts_with(input.spec().get_string_attribute("compression"), "dwa");
  return bytes * DEFLATE * (dwa ? 64 : 1) / native;
}

bool read_header(const std::string& path, PictureHeader& header) {
  const auto input = OIIO::ImageInput::open(path);
  if (!input) {
    (void)OIIO::geterror();
    return false;
  }
  const OIIO::ImageSpec& spec = input->spec();
  header.width = spec.width;
  header.height = spec.height;
  header.depth = spec.depth;
  header.x = spec.x - spec.full_x;
  header.y = spec.y - spec.full_y;
  header.full_width = spec.full_width;
  header.full_height = spec.full_height;
  header.channels = spec.channelnames;
  header.integers = spec.format == OIIO::TypeDesc::UINT8 || spec.format == OIIO::TypeDesc::UINT16;
  for (const OIIO::ParamValue& attribute : spec.extra_attribs)
    header.attributes.emplace_back(attribute.name().string(), attribute.get_string());
  std::error_code error;
  header.most_pixels = most_pixels(path, *input, std::filesystem::file_size(path, error));
  return !error;
}

/// Reads the rows from `begin` to before `end`.
bool read_rows(OIIO::ImageInput& input, int begin, int end, int channels, float* values) {
  const OIIO::ImageSpec& spec = input.spec();
  if (spec.tile_width == 0)
    return input.read_scanlines(0, 0, begin, end, spec.z, 0, channels, OIIO::TypeDesc::FLOAT, values);
  return input.read_tiles(0, 0, spec.x, spec.x + spec.width, begin, end, spec.z, spec.z + 1, 0, channels,
                          OIIO::TypeDesc::FLOAT, values);
}

bool read_pixels(const std::string& path, int first_row, int channels, const PixelSink& sink,
                 std::string& error) {
  constexpr int MOST_ROWS = 64;
  const auto input = OIIO::ImageInput::open(path);
  if (!input) {
    error = OIIO::geterror();
    return false;
  }
  const OIIO::ImageSpec& spec = input->spec();
  const int step = spec.tile_height > 0 ? spec.tile_height : MOST_ROWS;
  std::vector<float> values;
  for (int row = first_row / step * step; row < spec.height; row += step) {
    const int end = std::min(row + step, spec.height);
    const int begin = spec.tile_height > 0 ? row : std::max(row, first_row);
    const std::size_t pixels = std::size_t(spec.width) * static_cast<std::size_t>(end - begin);
    values.resize(pixels * static_cast<std::size_t>(channels));
    if (!read_rows(*input, spec.y + begin, spec.y + end, channels, values.data())) {
      error = input->geterror();
      return false;
    }
    sink(values.data(), pixels);
  }
  return true;
}

bool encode(const char* format, const PictureHeader& header, const void* values,
            std::vector<unsigned char>& bytes, std::string& error) {
  const OIIO::TypeDesc type = header.integers ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT;
  const auto& channels = header.channels;
  OIIO::ImageSpec spec(header.width, header.height, static_cast<int>(channels.size()), type);
  spec.channelnames = channels;
  if (header.full_width > 0) {
    spec.x = header.x;
    spec.y = header.y;
    spec.full_width = header.full_width;
    spec.full_height = header.full_height;
  }
  const auto alpha = std::find(channels.begin(), channels.end(), "A");
  spec.alpha_channel = alpha == channels.end() ? -1 : static_cast<int>(alpha - channels.begin());
  for (const auto& [name, value] : header.attributes) spec.attribute(name, value);
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create(format, &memory);
  const bool written =
      output && output->open(format, spec) && output->write_image(type, values) && output->close();
  if (!written) error = output ? output->geterror() : OIIO::geterror();
  return written;
}

}  // namespace
}  // namespace splatray

const splatray::ImageCodec* splatray_image_codec() {
  static constexpr splatray::ImageCodec CODEC{splatray::read_header, splatray::read_pixels, splatray::encode};
  return &CODEC;
}
