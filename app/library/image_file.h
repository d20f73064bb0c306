/// Pictures in files: PNG, JPEG, WebP and EXR out, pictures and environment maps in.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "app/library/display_image.h"
#include "engine/image/aovs.h"
#include "engine/image/image.h"
#include "engine/image/view.h"
#include "engine/scene/environment.h"

namespace splatray {

/// Names and values kept in the file: attributes of an EXR, text chunks of a PNG, comments of a JPEG, a chunk of a WebP; their names
/// after "splatray.".
using Metadata = std::vector<std::pair<std::string, std::string>>;

/// Bytes a pixel that writing a picture takes beside it, at most: of a display format (picture_format.h), or an EXR by its count of channels.
inline constexpr std::uint64_t DISPLAY_WRITING_BYTES = sizeof(vec3) + sizeof(float) + 3 * 4;
[[nodiscard]] constexpr std::uint64_t exr_writing_bytes(std::size_t channels) {
  return 2 * sizeof(float) * channels;
}

/// Writes sRGB PNG, 8 bit, with an alpha channel where the picture has one. Throws Error (failed); then an older file of that
/// name is as it was.
void write_png(const DisplayImage& image, const Metadata& metadata, const std::filesystem::path& path);

/// The bytes that write_png writes.
[[nodiscard]] std::vector<unsigned char> encode_png(const DisplayImage& image, const Metadata& metadata);
/// A JPEG's, without alpha; `quality` 1 to 100, of which 95 shows no blocks.
[[nodiscard]] std::vector<unsigned char> encode_jpeg(DisplayImage image, const Metadata& metadata = {},
                                                     int quality = 95);
/// The bytes of a file of a display format (picture_format.h), by its name; of a JPEG or WebP of quality 95. Throws Error (failed):
/// WebP needs the library that OpenImageIO is in.
[[nodiscard]] std::vector<unsigned char> encode_display(const DisplayImage& image, const Metadata& metadata,
                                                        const std::filesystem::path& path);
/// Throws Error (failed), which says what to install, where what writes this file's format is not there.
void require_picture_writer(const std::filesystem::path& path);

/// The channels of a picture, or of a part of it, as an EXR holds them.
struct ExrPicture {
  std::uint32_t width = 0, height = 0;  ///< of the whole picture
  PixelWindow window;                   ///< the part that is there
  std::vector<std::string> channels;    ///< their names
  std::vector<float> values;            ///< of the window's pixels, top row first, channel by channel
  Metadata metadata;
};

/// Writes linear float EXR; a part as data window. Throws Error (failed) as write_png does.
void write_exr(const ExrPicture& picture, const std::filesystem::path& path);
/// The bytes that it writes.
[[nodiscard]] std::vector<unsigned char> encode_exr(const ExrPicture& picture);
/// Wraps an image that covers the whole picture; set `window` for a part.
[[nodiscard]] ExrPicture exr_picture(const Image& image, AovSet aovs, const Metadata& metadata);
/// The same of an image that is the whole picture.
void write_exr(const Image& image, AovSet aovs, const Metadata& metadata, const std::filesystem::path& path);
/// What write_exr wrote, without its values. Throws Error (input_unreadable) with path, found and expected.
[[nodiscard]] ExrPicture read_exr_header(const std::filesystem::path& path);
/// Reads it whole; Error (out_of_memory), too, where that would take more memory than there is.
[[nodiscard]] ExrPicture read_exr(const std::filesystem::path& path);

/// Its window's colours and coverage alone; black where it lacks their channels.
[[nodiscard]] Image image_of(const ExrPicture& picture);

/// Whether the file was written completely: a PNG or JPEG has its end, of other pictures the last row can be read. Throws Error (failed)
/// when the library for pictures cannot be loaded, which it is but for these.
[[nodiscard]] bool is_whole_picture(const std::filesystem::path& path);

/// Reads what encode_display or write_exr kept; empty for pictures of others. Throws Error (input_unreadable) with path,
/// found and expected.
[[nodiscard]] Metadata read_metadata(const std::filesystem::path& path);

/// Reads a picture to compare with: files of 8 or 16 bit as they are, float files (EXR, HDR) through
/// display_value. Throws Error (input_unreadable) with path, found and expected.
[[nodiscard]] DisplayImage read_display_image(const std::filesystem::path& path, const Display& display);

/// Reads a latitude-longitude environment, any format: EXR, PNG, HDR and JPEG by
/// ourselves, others by OpenImageIO; 8 and 16 bit files are taken as
/// sRGB. Values that are negative or NaN become 0, infinite ones
/// 65504, half float's largest; `note` hears how many there were of each. Throws Error (input_unreadable) with
/// path, found and expected.
[[nodiscard]] Environment read_environment(const std::filesystem::path& path,
                                           const std::function<void(const std::string&)>& note = {});

/// Loads what writes pictures, as the first of the functions above would; any thread. Throws Error (failed) where that
/// fails.
void load_image_codec();

}  // namespace splatray
