#include "app/library/codec/image_codec.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "app/library/codec/kept_text.h"

namespace splatray {
namespace {

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
  for (auto& pair : read_kept_text(path)) header.attributes.push_back(std::move(pair));
  return true;
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

/// The bytes of a picture as OpenImageIO's writer of WebP takes them, which divides colours by alpha, with a gamma of 2.2 in between,
/// whatever "oiio:UnassociatedAlpha" says. Rounded down, as what comes out above 255 would be dark.
std::vector<unsigned char> for_webp(const unsigned char* values, std::size_t pixels) {
  constexpr double MOST = 255.0, GAMMA = 2.2;
  std::vector<unsigned char> taken(values, values + 4 * pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const double factor = std::pow(taken[4 * i + 3] / MOST, 1.0 / GAMMA);
    for (std::size_t channel = 0; channel < 3; ++channel)
      taken[4 * i + channel] = static_cast<unsigned char>(taken[4 * i + channel] * factor);
  }
  return taken;
}

/// A WebP, as this library writes it into memory.
bool encode(const char* format, const PictureHeader& header, const void* values,
            std::vector<unsigned char>& bytes, std::string& error) {
  const auto output = OIIO::ImageOutput::create(std::string("memory.") + format);
  if (std::strcmp(format, "webp") != 0 || !output || !output->supports("ioproxy")) {
    error = "this OpenImageIO writes none" + (output ? std::string() : ": " + OIIO::geterror());
    return false;
  }
  const auto channels = static_cast<int>(header.channels.size());
  OIIO::ImageSpec spec(header.width, header.height, channels, OIIO::TypeDesc::UINT8);
  spec.attribute("compression", "webp:" + std::to_string(header.quality));
  OIIO::Filesystem::IOVecOutput memory(bytes);
  output->set_ioproxy(&memory);
  const auto* colors = static_cast<const unsigned char*>(values);
  std::vector<unsigned char> taken;
  if (channels == 4) {
    taken =
        for_webp(colors, static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height));
    colors = taken.data();
  }
  const bool made = output->open("memory.webp", spec) && output->write_image(OIIO::TypeDesc::UINT8, colors) &&
                    output->close();
  if (!made) error = output->geterror();
  if (made) add_webp_text(bytes, header.attributes, header.width, header.height, channels == 4);
  return made;
}

}  // namespace
}  // namespace splatray

const splatray::ImageCodec* splatray_image_codec() {
  static constexpr splatray::ImageCodec CODEC{splatray::read_header, splatray::read_pixels, splatray::encode};
  return &CODEC;
}
