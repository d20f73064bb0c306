#include "app/image_file.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>

#include "engine/host/atomic_file.h"
#include "engine/host/error.h"

namespace splatray {
namespace {

constexpr std::uint64_t MOST_PIXELS = 1ULL << 30;

float encode_srgb(float linear) {
  return linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
}

float decode_srgb(float encoded) {
  return encoded <= 0.04045F ? encoded / 12.92F : std::pow((encoded + 0.055F) / 1.055F, 2.4F);
}

float shoulder(float x) {
  constexpr float KNEE = 0.8F, ROOM = 1.0F - KNEE;
  if (!(x > 0.0F)) return 0.0F;
  return x <= KNEE ? x : 1.0F - ROOM * std::exp((KNEE - x) / ROOM);
}

/// Pixels of a file as float rgb, grey repeated. `encoded`: stored with 8 or 16 bits, so already
/// display-encoded.
struct Picture {
  std::uint32_t width = 0, height = 0;
  std::vector<vec3> rgb;
  bool encoded = false;
};

[[noreturn]] void refuse(const std::filesystem::path& path, std::string found, const char* expected) {
  while (!found.empty() && std::isspace(static_cast<unsigned char>(found.back())) != 0) found.pop_back();
  std::replace(found.begin(), found.end(), '\n', ' ');
  throw Error(ExitCode::input_unreadable,
              "cannot read picture '" + path.string() + "': found " + found + ", expected " + expected);
}

constexpr const char* EXPECTED = "an image such as HDR, EXR or PNG";

/// Opens a picture file and reads its header.
std::unique_ptr<OIIO::ImageInput> open_picture(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) refuse(path, "no such file", EXPECTED);
  if (!std::filesystem::is_regular_file(path, error)) refuse(path, "a folder or device", EXPECTED);
  auto input = OIIO::ImageInput::open(path.string());
  if (!input) {
    (void)OIIO::geterror();
    refuse(path, "no picture OpenImageIO can open", EXPECTED);
  }
  return input;
}

Picture read_picture(const std::filesystem::path& path) {
  const auto input = open_picture(path);
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1 ||
      spec.image_pixels() > MOST_PIXELS)
    refuse(path, std::to_string(spec.width) + " x " + std::to_string(spec.height) + " pixels",
           "a flat picture of up to 2^30");
  const int channels = std::min(spec.nchannels, 3);
  std::vector<float> values(spec.image_pixels() * static_cast<std::size_t>(channels));
  if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, values.data()))
    refuse(path, "damage (" + input->geterror() + ")", "a whole image");
  Picture picture{static_cast<std::uint32_t>(spec.width), static_cast<std::uint32_t>(spec.height), {}, false};
  picture.encoded = spec.format == OIIO::TypeDesc::UINT8 || spec.format == OIIO::TypeDesc::UINT16;
  picture.rgb.reserve(spec.image_pixels());
  for (auto value = values.cbegin(); value != values.cend(); value += channels)
    picture.rgb.push_back(channels == 3 ? vec3(value[0], value[1], value[2]) : vec3(value[0]));
  return picture;
}

constexpr const char* PREFIX = "splatray.";  ///< of the names of our metadata

void add_metadata(const Metadata& metadata, OIIO::ImageSpec& spec) {
  for (const auto& [name, value] : metadata) spec.attribute(PREFIX + name, value);
}

/// Writes pixels under a temporary name; all formats and failures the same way.
void write_picture(const OIIO::ImageSpec& spec, const void* pixels, OIIO::TypeDesc type, const char* format,
                   const std::filesystem::path& path) {
  AtomicFile file(path);
  const auto output = OIIO::ImageOutput::create(format);
  const bool written = output && output->open(file.temporary().string(), spec) &&
                       output->write_image(type, pixels) && output->close();
  if (!written) {
    std::string reason = output ? output->geterror() : OIIO::geterror();
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    throw Error(ExitCode::failed, "cannot write '" + path.string() + "': " + reason);
  }
  file.commit();
}

}  // namespace

vec3 display_value(vec3 radiance, double exposure_ev) {
  const auto factor = static_cast<float>(std::exp2(exposure_ev));
  const auto channel = [factor](float x) { return encode_srgb(shoulder(factor * x)); };
  return {channel(radiance.x), channel(radiance.y), channel(radiance.z)};
}

DisplayImage display_image(const Image& image, double exposure_ev) {
  DisplayImage display{image.width, image.height, {}};
  display.rgb.reserve(image.rgba.size());
  for (const vec4& pixel : image.rgba) display.rgb.push_back(display_value(vec3(pixel), exposure_ev));
  return display;
}

void quantise(DisplayImage& image) {
  for (vec3& pixel : image.rgb) pixel = glm::round(pixel * 255.0F) / 255.0F;
}

void write_png(const DisplayImage& image, const Metadata& metadata, const std::filesystem::path& path) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(3 * image.rgb.size());
  for (const vec3& pixel : image.rgb)
    for (int channel = 0; channel < 3; ++channel)
      bytes.push_back(static_cast<std::uint8_t>(std::lround(255.0F * pixel[channel])));
  OIIO::ImageSpec spec(static_cast<int>(image.width), static_cast<int>(image.height), 3,
                       OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  add_metadata(metadata, spec);
  write_picture(spec, bytes.data(), OIIO::TypeDesc::UINT8, "png", path);
}

void write_exr(const Image& image, AovChannels aovs, const Metadata& metadata,
               const std::filesystem::path& path) {
  std::vector<std::string> names = {"R", "G", "B", "A"};
  if (aovs.depth) names.emplace_back("Z");
  if (aovs.normal) names.insert(names.end(), {"N.X", "N.Y", "N.Z"});
  if (aovs.id) names.emplace_back("id");
  std::vector<float> values;
  values.reserve(image.rgba.size() * names.size());
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    for (int channel = 0; channel < 4; ++channel) values.push_back(image.rgba[i][channel]);
    if (aovs.depth) values.push_back(image.aov[i].z);
    if (aovs.normal)
      values.insert(values.end(), {image.aov[i].normal.x, image.aov[i].normal.y, image.aov[i].normal.z});
    if (aovs.id)
      values.push_back(image.aov[i].object == NO_OBJECT ? -1.0F : static_cast<float>(image.aov[i].object));
  }
  OIIO::ImageSpec spec(static_cast<int>(image.width), static_cast<int>(image.height),
                       static_cast<int>(names.size()), OIIO::TypeDesc::FLOAT);
  spec.channelnames = names;
  spec.alpha_channel = 3;
  spec.attribute("oiio:ColorSpace", "Linear");
  spec.attribute("compression", "zip");
  spec.attribute("DateTime", "");  // else the time of writing: the same picture makes the same file
  add_metadata(metadata, spec);
  write_picture(spec, values.data(), OIIO::TypeDesc::FLOAT, "openexr", path);
}

Metadata read_metadata(const std::filesystem::path& path) {
  const auto input = open_picture(path);
  Metadata metadata;
  for (const OIIO::ParamValue& attribute : input->spec().extra_attribs) {
    const std::string name = attribute.name().string();
    if (name.starts_with(PREFIX))
      metadata.emplace_back(name.substr(std::strlen(PREFIX)), attribute.get_string());
  }
  return metadata;
}

DisplayImage read_display_image(const std::filesystem::path& path, double exposure_ev) {
  Picture picture = read_picture(path);
  if (!picture.encoded)
    for (vec3& pixel : picture.rgb) pixel = display_value(pixel, exposure_ev);
  return {picture.width, picture.height, std::move(picture.rgb)};
}

Environment read_environment(const std::filesystem::path& path) {
  Picture picture = read_picture(path);
  for (vec3& pixel : picture.rgb)
    for (int channel = 0; channel < 3; ++channel) {
      const float value = picture.encoded ? decode_srgb(pixel[channel]) : pixel[channel];
      pixel[channel] = std::isfinite(value) && value > 0.0F ? value : 0.0F;
    }
  return {picture.width, picture.height, std::move(picture.rgb), vec3(0.0F)};
}

}  // namespace splatray
