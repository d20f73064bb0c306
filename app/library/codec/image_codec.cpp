// The library of image_codec.h that writes pictures: EXR by exr_writer.h, which OpenEXR reads, PNG by png_writer.h, JPEG by stb, which
// also reads PNG and Radiance HDR. What metadata a PNG has are its text chunks.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTestFile.h>
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <filesystem>
#include <memory>
#include <utility>

#include "app/library/codec/exr_writer.h"
#include "app/library/codec/image_codec.h"
#include "app/library/codec/kept_text.h"
#include "app/library/codec/png_text.h"
#include "app/library/codec/png_writer.h"

namespace splatray {
namespace {

constexpr std::uint64_t DEFLATE = 1032;  ///< most bytes that one compressed byte gives: 258 for 2 bits

bool is_exr(const std::string& path) { return Imf::isOpenExrFile(path.c_str()); }

/// An EXR's channels, colours first: a file has them by their names' order.
std::vector<std::string> ordered_channels(const Imf::ChannelList& all) {
  std::vector<std::string> names;
  for (const char* first : {"R", "G", "B", "A", "Z"})
    if (all.findChannel(first) != nullptr) names.emplace_back(first);
  for (auto channel = all.begin(); channel != all.end(); ++channel)
    if (std::find(names.begin(), names.end(), channel.name()) == names.end())
      names.emplace_back(channel.name());
  return names;
}

std::uint64_t pixel_bytes(const Imf::ChannelList& channels) {
  std::uint64_t bytes = 0;
  for (auto channel = channels.begin(); channel != channels.end(); ++channel)
    bytes += channel.channel().type == Imf::HALF ? 2 : 4;
  return std::max<std::uint64_t>(bytes, 1);
}

void read_exr_header(const std::string& path, std::uint64_t file_bytes, PictureHeader& header) {
  const Imf::InputFile file(path.c_str());
  const Imath::Box2i window = file.header().dataWindow();
  header.width = window.max.x - window.min.x + 1;
  header.height = window.max.y - window.min.y + 1;
  const Imath::Box2i whole = file.header().displayWindow();
  header.x = window.min.x - whole.min.x;
  header.y = window.min.y - whole.min.y;
  header.full_width = whole.max.x - whole.min.x + 1;
  header.full_height = whole.max.y - whole.min.y + 1;
  header.channels = ordered_channels(file.header().channels());
  for (auto attribute = file.header().begin(); attribute != file.header().end(); ++attribute)
    // The type says what kind of file this is, nothing of the picture.
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute());
        text != nullptr && std::strcmp(attribute.name(), "type") != 0)
      header.attributes.emplace_back(attribute.name(), text->value());
  const Imf::Compression compression = file.header().compression();
  const bool dwa = compression == Imf::DWAA_COMPRESSION || compression == Imf::DWAB_COMPRESSION;
  header.most_pixels = file_bytes * DEFLATE * (dwa ? 64 : 1) / pixel_bytes(file.header().channels());
}

bool read_stb_header(const std::string& path, std::uint64_t file_bytes, PictureHeader& header) {
  int channels = 0;
  if (stbi_info(path.c_str(), &header.width, &header.height, &channels) == 0) return false;
  header.channels = channels < 3 ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
  header.integers = stbi_is_hdr(path.c_str()) == 0;
  // A run of up to 127 takes two bytes in each of an HDR's four channels.
  header.most_pixels = header.integers ? file_bytes * DEFLATE * 8 / png_bits(path) : file_bytes * 127 / 8;
  header.attributes = read_png_text(path);
  for (auto& pair : read_kept_text(path)) header.attributes.push_back(std::move(pair));
  return true;
}

bool read_header(const std::string& path, PictureHeader& header) {
  std::error_code error;
  const std::uint64_t bytes = std::filesystem::file_size(path, error);
  if (error) return false;
  try {
    if (!is_exr(path)) return read_stb_header(path, bytes, header);
    read_exr_header(path, bytes, header);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

void read_exr(const std::string& path, int first_row, int channels, const PixelSink& sink) {
  Imf::InputFile file(path.c_str());
  const Imath::Box2i window = file.header().dataWindow();
  const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
  const auto count = static_cast<std::size_t>(channels);
  const std::vector<std::string> names = ordered_channels(file.header().channels());
  std::vector<float> row(width * count);
  for (int y = window.min.y + first_row; y <= window.max.y; ++y) {
    Imf::FrameBuffer buffer;
    for (std::size_t i = 0; i < count; ++i)
      buffer.insert(names[i], Imf::Slice::Make(Imf::FLOAT, row.data() + i, Imath::V2i(window.min.x, y),
                                               static_cast<std::int64_t>(width), 1, sizeof(float) * count,
                                               sizeof(float) * count * width));
    file.setFrameBuffer(buffer);
    file.readPixels(y);
    sink(row.data(), width);
  }
}

bool read_stb(const std::string& path, int first_row, int channels, const PixelSink& sink,
              std::string& error) {
  int width = 0, height = 0, stored = 0;
  const auto give = [&](const auto* values, float most) {
    std::vector<float> row(static_cast<std::size_t>(width) * static_cast<std::size_t>(channels));
    for (int y = first_row; y < height; ++y) {
      const auto* from = values + static_cast<std::size_t>(y) * row.size();
      std::transform(from, from + row.size(), row.begin(),
                     [most](auto value) { return static_cast<float>(value) / most; });
      sink(row.data(), static_cast<std::size_t>(width));
    }
  };
  const auto free = [](void* values) { stbi_image_free(values); };
  std::unique_ptr<void, decltype(free)> values(nullptr, free);
  if (stbi_is_hdr(path.c_str()) != 0) {
    values.reset(stbi_loadf(path.c_str(), &width, &height, &stored, channels));
    if (values) give(static_cast<const float*>(values.get()), 1.0F);
  } else if (stbi_is_16_bit(path.c_str()) != 0) {
    values.reset(stbi_load_16(path.c_str(), &width, &height, &stored, channels));
    if (values) give(static_cast<const stbi_us*>(values.get()), 65535.0F);
  } else {
    values.reset(stbi_load(path.c_str(), &width, &height, &stored, channels));
    if (values) give(static_cast<const stbi_uc*>(values.get()), 255.0F);
  }
  if (!values) error = stbi_failure_reason();
  return values != nullptr;
}

bool read_pixels(const std::string& path, int first_row, int channels, const PixelSink& sink,
                 std::string& error) {
  try {
    if (!is_exr(path)) return read_stb(path, first_row, channels, sink, error);
    read_exr(path, first_row, channels, sink);
    return true;
  } catch (const std::exception& thrown) {
    error = thrown.what();
    return false;
  }
}

/// Behind the bytes of a file, as stb's writers ask for.
void append(void* to, void* data, int size) {
  const auto* from = static_cast<const unsigned char*>(data);
  auto& list = *static_cast<std::vector<unsigned char>*>(to);
  list.insert(list.end(), from, from + size);
}

bool encode_jpeg(const PictureHeader& header, const void* values, std::vector<unsigned char>& bytes) {
  const auto channels = static_cast<int>(header.channels.size());
  const bool made = stbi_write_jpg_to_func(append, &bytes, header.width, header.height, channels, values,
                                           header.quality) != 0;
  if (made) add_jpeg_text(bytes, header.attributes);
  return made;
}

bool encode(const char* format, const PictureHeader& header, const void* values,
            std::vector<unsigned char>& bytes, std::string& error) {
  try {
    if (std::strcmp(format, "openexr") == 0) {
      bytes = encode_exr(header, static_cast<const float*>(values));
      return true;
    }
    if (std::strcmp(format, "png") == 0) {
      bytes = encode_png(header, static_cast<const unsigned char*>(values));
      return true;
    }
    if (encode_jpeg(header, values, bytes)) return true;
    error = "a JPEG could not be made";
  } catch (const std::exception& thrown) {
    error = thrown.what();
  }
  return false;
}

}  // namespace
}  // namespace splatray

const splatray::ImageCodec* splatray_image_codec() {
  static constexpr splatray::ImageCodec CODEC{splatray::read_header, splatray::read_pixels, splatray::encode};
  return &CODEC;
}
