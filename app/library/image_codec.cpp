#include "app/library/image_codec.h"

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
  header.channels = spec.channelnames;
  header.integers = spec.format == OIIO::TypeDesc::UINT8 || spec.format == OIIO::TypeDesc::UINT16;
  for (const OIIO::ParamValue& attribute : spec.extra_attribs)
    header.attributes.emplace_back(attribute.name().string(), attribute.get_string());
  return true;
}

bool read_pixels(const std::string& path, int channels, float* values, std::string& error) {
  const auto input = OIIO::ImageInput::open(path);
  const bool whole = input && input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, values);
  if (!whole) error = input ? input->geterror() : OIIO::geterror();
  return whole;
}

bool write(const std::string& path, const char* format, const PictureHeader& header, const void* values,
           std::string& error) {
  const OIIO::TypeDesc type = header.integers ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT;
  const auto& channels = header.channels;
  OIIO::ImageSpec spec(header.width, header.height, static_cast<int>(channels.size()), type);
  spec.channelnames = channels;
  const auto alpha = std::find(channels.begin(), channels.end(), "A");
  spec.alpha_channel = alpha == channels.end() ? -1 : static_cast<int>(alpha - channels.begin());
  for (const auto& [name, value] : header.attributes) spec.attribute(name, value);
  const auto output = OIIO::ImageOutput::create(format);
  const bool written =
      output && output->open(path, spec) && output->write_image(type, values) && output->close();
  if (!written) error = output ? output->geterror() : OIIO::geterror();
  return written;
}

}  // namespace
}  // namespace splatray

const splatray::ImageCodec* splatray_image_codec() {
  static constexpr splatray::ImageCodec CODEC{splatray::read_header, splatray::read_pixels, splatray::write};
  return &CODEC;
}
