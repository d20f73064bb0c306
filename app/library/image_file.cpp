#include "app/library/image_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string_view>

#include "app/library/codec/image_codec.h"
#include "app/library/codec/picture_format.h"
#include "app/library/exr_check.h"
#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/base/module.h"
#include "engine/base/srgb.h"
#include "engine/file/atomic_file.h"
#include "engine/file/file_roles.h"

namespace splatray {
namespace {

constexpr std::uint64_t MOST_PIXELS = 1ULL << 30;

/// Pixels of a file as float rgb, grey repeated. `encoded`: stored with 8 or 16 bits, so already
/// display-encoded.
struct Picture {
  std::uint32_t width = 0, height = 0;
  std::vector<vec3> rgb;
  bool encoded = false;
};

[[noreturn]] void refuse(const std::filesystem::path& path, std::string found, const std::string& expected) {
  while (!found.empty() && std::isspace(static_cast<unsigned char>(found.back())) != 0) found.pop_back();
  throw Error(ExitCode::input_unreadable,
              "cannot read picture '" + path.string() + "': found " + found + ", expected " + expected);
}

constexpr const char* EXPECTED = "an image such as HDR, EXR or PNG";

const ImageCodec& load_codec(const char* module, ExitCode code, const std::string& purpose,
                             const std::string& remedy) {
  void* function = module_function(module, "splatray_image_codec", code, purpose, remedy);
  return *reinterpret_cast<decltype(&splatray_image_codec)>(function)();
}

/// What writes pictures, and reads those of the formats that it writes.
const ImageCodec& codec() {
  static const ImageCodec& loaded =
      load_codec("splatray_image_codec", ExitCode::failed, "cannot load what reads and writes pictures", "");
  return loaded;
}

/// What reads a picture: for formats that are not ours, OpenImageIO.
const ImageCodec& codec_of(const std::filesystem::path& path) {
  char start[8]{};
  std::ifstream(path, std::ios::binary).read(start, sizeof start);
  const std::string_view bytes(start, sizeof start);
  for (const std::string_view ours : {"\x89PNG", "\x76\x2f\x31\x01", "#?", "\xff\xd8\xff"})
    if (bytes.starts_with(ours)) return codec();
  const std::string extension = path.extension().string();
  const std::string format =
      extension.empty() ? "no EXR, PNG, HDR or JPEG" : "of the format '" + extension + "'";
  static const ImageCodec& loaded = load_codec(
      "splatray_oiio", ExitCode::input_unreadable,
      "cannot read picture '" + path.string() + "', which is " + format, ": the package splatray-oiio");
  return loaded;
}

PictureHeader read_header(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) refuse(path, "no such file", EXPECTED);
  if (!std::filesystem::is_regular_file(path, error)) refuse(path, "a folder or device", EXPECTED);
  if (std::filesystem::file_size(path, error) == 0) refuse(path, "an empty file", EXPECTED);
  if (const auto defect = find_exr_defect(path))
    refuse(path, *defect,
           "what fits the file's " + std::to_string(std::filesystem::file_size(path)) + " bytes");
  PictureHeader header;
  if (!codec_of(path).read_header(path.string(), header))
    refuse(path, "no picture that can be opened", EXPECTED);
  return header;
}

/// The header of a picture whose pixels may be read.
PictureHeader read_flat_header(const std::filesystem::path& path) {
  PictureHeader header = read_header(path);
  const bool positive = header.width >= 1 && header.height >= 1 && !header.channels.empty();
  const std::uint64_t pixels = positive ? std::uint64_t(header.width) * std::uint64_t(header.height) : 0;
  const auto size_text = [&] {
    return std::to_string(header.width) + " x " + std::to_string(header.height) + " pixels";
  };
  if (pixels == 0 || header.depth > 1 || pixels > MOST_PIXELS)
    refuse(path, size_text(), "a flat picture of up to 2^30");
  if (pixels > header.most_pixels)
    refuse(path, size_text(), "at most " + std::to_string(header.most_pixels) + " in a file of its size");
  return header;
}

Picture read_picture(const std::filesystem::path& path) {
  note_input(path);
  const PictureHeader header = read_flat_header(path);
  Picture picture{static_cast<std::uint32_t>(header.width),
                  static_cast<std::uint32_t>(header.height),
                  {},
                  header.integers};
  const std::size_t channels = std::min<std::size_t>(header.channels.size(), 3);
  const std::size_t pixels = std::size_t{picture.width} * picture.height;
  require_memory(pixels * sizeof(vec3), "'" + path.string() + "'");
  picture.rgb.reserve(pixels);
  const PixelSink append = [&](const float* value, std::size_t count) {
    for (const float* end = value + count * channels; value != end; value += channels)
      picture.rgb.push_back(channels == 3 ? vec3(value[0], value[1], value[2]) : vec3(value[0]));
  };
  std::string damage;
  if (!codec_of(path).read_pixels(path.string(), 0, static_cast<int>(channels), append, damage))
    refuse(path, "damage (" + damage + ")", "a whole image");
  return picture;
}

/// Whether the file has these bytes at offset `at`, counted from its start or, where negative, from its end.
bool has_bytes(std::ifstream& file, std::streamoff at, const std::string& bytes) {
  std::string found(bytes.size(), '\0');
  file.clear();
  file.seekg(at, at < 0 ? std::ios::end : std::ios::beg);
  return file.read(found.data(), static_cast<std::streamsize>(found.size())) && found == bytes;
}

constexpr const char* PREFIX = "splatray.";  ///< of the names of our metadata

Metadata metadata_of(const PictureHeader& header) {
  Metadata metadata;
  for (const auto& [name, value] : header.attributes)
    if (name.starts_with(PREFIX)) metadata.emplace_back(name.substr(std::strlen(PREFIX)), value);
  return metadata;
}

/// What writes WebP.
const ImageCodec& webp_codec() {
  static const ImageCodec& loaded = load_codec("splatray_oiio", ExitCode::failed,
                                               "cannot load what writes WebP", ": the package splatray-oiio");
  return loaded;
}

/// A picture's file in memory; `name` is what to call it where that fails.
std::vector<unsigned char> encode(PictureHeader header, const Metadata& metadata, const void* values,
                                  const char* format, const std::string& name) {
  Metadata sorted = metadata;  // as an EXR keeps it: a picture that went through parts is the same file
  std::sort(sorted.begin(), sorted.end());
  for (const auto& [key, value] : sorted) header.attributes.emplace_back(PREFIX + key, value);
  std::vector<unsigned char> bytes;
  std::string reason;
  const ImageCodec& writer = std::strcmp(format, "webp") == 0 ? webp_codec() : codec();
  if (!writer.encode(format, header, values, bytes, reason))
    throw Error(ExitCode::failed, "cannot write " + name + ": " + reason);
  return bytes;
}

/// What the file of a display format holds beside its metadata.
struct DisplayContents {
  PictureHeader header;
  std::vector<std::uint8_t> bytes;
};

DisplayContents display_contents(const DisplayImage& image) {
  DisplayContents contents{{.width = static_cast<int>(image.width),
                            .height = static_cast<int>(image.height),
                            .channels = {"R", "G", "B"},
                            .integers = true,
                            .attributes = {{"oiio:ColorSpace", "sRGB"}},
                            .dots_per_inch = image.dots_per_inch},
                           {}};
  if (!image.alpha.empty()) contents.header.channels.emplace_back("A");
  const std::size_t channels = contents.header.channels.size();
  contents.bytes.resize(channels * image.rgb.size());
  // In float64, as float32 would round twice.
  const auto byte_of = [](float value) { return static_cast<std::uint8_t>(double(255.0F * value) + 0.5); };
  std::uint8_t* pixel = contents.bytes.data();
  for (std::size_t i = 0; i < image.rgb.size(); ++i, pixel += channels) {
    for (int channel = 0; channel < 3; ++channel) pixel[channel] = byte_of(image.rgb[i][channel]);
    if (!image.alpha.empty()) pixel[3] = byte_of(image.alpha[i]);
  }
  return contents;
}

}  // namespace

void load_image_codec() { static_cast<void>(codec()); }

void write_png(const DisplayImage& image, const Metadata& metadata, const std::filesystem::path& path) {
  const std::vector<unsigned char> bytes = encode_png(image, metadata);
  write_file(bytes.data(), bytes.size(), path);
}

std::vector<unsigned char> encode_png(const DisplayImage& image, const Metadata& metadata) {
  DisplayContents contents = display_contents(image);
  return encode(std::move(contents.header), metadata, contents.bytes.data(), "png", "a PNG");
}

std::vector<unsigned char> encode_jpeg(DisplayImage image, const Metadata& metadata, int quality) {
  image.alpha.clear();
  DisplayContents contents = display_contents(image);
  contents.header.quality = quality;
  return encode(std::move(contents.header), metadata, contents.bytes.data(), "jpeg", "a JPEG");
}

std::vector<unsigned char> encode_display(const DisplayImage& image, const Metadata& metadata,
                                          const std::filesystem::path& path) {
  if (is_jpeg(path)) return encode_jpeg(image, metadata);
  if (!is_webp(path)) return encode_png(image, metadata);
  DisplayContents contents = display_contents(image);
  return encode(std::move(contents.header), metadata, contents.bytes.data(), "webp", "a WebP");
}

void require_picture_writer(const std::filesystem::path& path) {
  if (is_webp(path)) static_cast<void>(webp_codec());
}

ExrPicture exr_picture(const Image& image, AovSet aovs, const Metadata& metadata) {
  ExrPicture picture{image.width,          image.height, {0, 0, image.width, image.height},
                     {"R", "G", "B", "A"}, {},           metadata};
  std::vector<std::string>& names = picture.channels;
  for (std::size_t i = 0; i < all_aovs().size(); ++i)
    if (has_aov(aovs, i))
      names.insert(names.end(), all_aovs()[i].channels.begin(), all_aovs()[i].channels.end());
  std::vector<float>& values = picture.values;
  values.reserve(image.rgba.size() * names.size());
  for (std::size_t pixel = 0; pixel < image.rgba.size(); ++pixel) {
    for (int channel = 0; channel < 4; ++channel) values.push_back(image.rgba[pixel][channel]);
    for (std::size_t i = 0; i < all_aovs().size(); ++i)
      if (has_aov(aovs, i)) all_aovs()[i].put(image, pixel, values);
  }
  return picture;
}

std::vector<unsigned char> encode_exr(const ExrPicture& picture) {
  PictureHeader header{.width = static_cast<int>(picture.window.width),
                       .height = static_cast<int>(picture.window.height),
                       .x = static_cast<int>(picture.window.x),
                       .y = static_cast<int>(picture.window.y),
                       .full_width = static_cast<int>(picture.width),
                       .full_height = static_cast<int>(picture.height),
                       .channels = picture.channels,
                       .attributes = {}};
  return encode(std::move(header), picture.metadata, picture.values.data(), "openexr", "an EXR");
}

void write_exr(const ExrPicture& picture, const std::filesystem::path& path) {
  const std::vector<unsigned char> bytes = encode_exr(picture);
  write_file(bytes.data(), bytes.size(), path);
}

void write_exr(const Image& image, AovSet aovs, const Metadata& metadata, const std::filesystem::path& path) {
  write_exr(exr_picture(image, aovs, metadata), path);
}

ExrPicture read_exr_header(const std::filesystem::path& path) {
  const PictureHeader header = read_flat_header(path);
  const bool inside = header.x >= 0 && header.y >= 0 &&
                      header.x + std::int64_t{header.width} <= header.full_width &&
                      header.y + std::int64_t{header.height} <= header.full_height &&
                      std::uint64_t(header.full_width) * std::uint64_t(header.full_height) <= MOST_PIXELS;
  if (header.integers || !inside)
    refuse(path, header.integers ? "8 or 16 bits a channel" : "a data window that is not inside the picture",
           "an EXR of splatray-render");
  return {static_cast<std::uint32_t>(header.full_width),
          static_cast<std::uint32_t>(header.full_height),
          {static_cast<std::uint32_t>(header.x), static_cast<std::uint32_t>(header.y),
           static_cast<std::uint32_t>(header.width), static_cast<std::uint32_t>(header.height)},
          header.channels,
          {},
          metadata_of(header)};
}

ExrPicture read_exr(const std::filesystem::path& path) {
  ExrPicture picture = read_exr_header(path);
  const std::size_t channels = picture.channels.size();
  const std::size_t values = std::size_t{picture.window.width} * picture.window.height * channels;
  require_memory(values * sizeof(float), "'" + path.string() + "'");
  picture.values.reserve(values);
  const PixelSink append = [&](const float* value, std::size_t count) {
    picture.values.insert(picture.values.end(), value, value + count * channels);
  };
  std::string damage;
  if (!codec_of(path).read_pixels(path.string(), 0, static_cast<int>(channels), append, damage))
    refuse(path, "damage (" + damage + ")", "a whole image");
  return picture;
}

Image image_of(const ExrPicture& picture) {
  Image image{picture.window.width, picture.window.height, {}, {}};
  image.rgba.resize(std::size_t{image.width} * image.height);
  for (glm::length_t channel = 0; channel < 4; ++channel) {
    const auto& names = picture.channels;
    const auto at = static_cast<std::size_t>(
        std::find(names.begin(), names.end(), std::string(1, "RGBA"[channel])) - names.begin());
    for (std::size_t i = 0; i < image.rgba.size() && at < names.size(); ++i)
      image.rgba[i][channel] = picture.values[i * names.size() + at];
  }
  return image;
}

bool is_whole_picture(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  const std::string png_end{"\0\0\0\0IEND\xAE\x42\x60\x82", 12};
  std::ifstream file(path, std::ios::binary);
  if (has_bytes(file, 0, "\x89PNG")) return has_bytes(file, -12, png_end);
  if (has_bytes(file, 0, "\xFF\xD8\xFF")) return has_bytes(file, -2, "\xFF\xD9");
  PictureHeader header;
  std::string damage;
  const PixelSink nowhere = [](const float*, std::size_t) {};
  return codec_of(path).read_header(path.string(), header) && header.height >= 1 &&
         codec_of(path).read_pixels(path.string(), header.height - 1, 1, nowhere, damage);
}

Metadata read_metadata(const std::filesystem::path& path) { return metadata_of(read_header(path)); }

DisplayImage read_display_image(const std::filesystem::path& path, const Display& display) {
  Picture picture = read_picture(path);
  if (!picture.encoded)
    for (vec3& pixel : picture.rgb) pixel = display_value(pixel, display);
  return {picture.width, picture.height, std::move(picture.rgb)};
}

Environment read_environment(const std::filesystem::path& path,
                             const std::function<void(const std::string&)>& note) {
  constexpr float LARGEST_HALF = 65504.0F;  // beyond it half floats are infinite
  Picture picture = read_picture(path);
  std::size_t dark = 0, infinite = 0;
  for (vec3& pixel : picture.rgb)
    for (int channel = 0; channel < 3; ++channel) {
      const float value = picture.encoded ? srgb_to_linear(pixel[channel]) : pixel[channel];
      dark += value >= 0.0F ? 0 : 1;
      infinite += std::isinf(value) && value > 0.0F ? 1 : 0;
      pixel[channel] = value >= 0.0F ? (std::isinf(value) ? LARGEST_HALF : value) : 0.0F;
    }
  const auto say = [&](std::size_t count, const std::string& found, const std::string& taken) {
    if (count > 0 && note)
      note("'" + path.string() + "': found " + std::to_string(count) + " values " + found +
           ", expected radiance; taken as " + taken);
  };
  say(dark, "that are negative or NaN", "0");
  say(infinite, "that are infinite", "65504");
  return {picture.width, picture.height, std::move(picture.rgb), vec3(0.0F)};
}

}  // namespace splatray
