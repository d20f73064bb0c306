#include "app/library/codec/image_codec.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>

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

}  // namespace
}  // namespace splatray

const splatray::ImageCodec* splatray_image_codec() {
  static constexpr splatray::ImageCodec CODEC{splatray::read_header, splatray::read_pixels, nullptr};
  return &CODEC;
}
