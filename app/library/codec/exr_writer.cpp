#include "app/library/codec/exr_writer.h"

#include <OpenEXR/openexr.h>
#include <libdeflate.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "engine/base/all_cores.h"

namespace splatray {
namespace {

static_assert(std::endian::native == std::endian::little, "EXR's values are little-endian");

using Bytes = std::vector<unsigned char>;

/// libdeflate's, 1 to 12.
constexpr int EXR_LEVEL = 1;
constexpr int CHUNK_ROWS = 16;  ///< of a chunk of ZIP compression
constexpr std::size_t SHORT_NAME = 31;

/// The channels' places in the header, by their names: so a file has them.
std::vector<std::size_t> file_order(const std::vector<std::string>& names) {
  std::vector<std::size_t> order(names.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return names[a] < names[b]; });
  return order;
}

/// Rows begin .. end - 1 as a file without compression has them: of each row channel by channel.
Bytes plain_rows(const std::vector<std::size_t>& order, const float* values, std::size_t width,
                 std::size_t begin, std::size_t end) {
  Bytes bytes((end - begin) * width * order.size() * sizeof(float));
  unsigned char* out = bytes.data();
  for (std::size_t row = begin; row < end; ++row)
    for (const std::size_t channel : order)
      for (std::size_t x = 0; x < width; ++x, out += sizeof(float))
        std::memcpy(out, values + (row * width + x) * order.size() + channel, sizeof(float));
  return bytes;
}

/// What ZIP compression compresses: all bytes of even number, then the others, each but the first as its difference to the byte
/// before, around 128 (OpenEXR, "ImfZip").
Bytes differences(const Bytes& plain) {
  const std::size_t half = (plain.size() + 1) / 2;
  Bytes parted(plain.size()), made(plain.size());
  for (std::size_t i = 0; i < plain.size() / 2; ++i) {
    parted[i] = plain[2 * i];
    parted[half + i] = plain[2 * i + 1];
  }
  made[0] = parted[0];
  for (std::size_t i = 1; i < parted.size(); ++i)
    made[i] = static_cast<unsigned char>(parted[i] - parted[i - 1] + 128);
  return made;
}

/// A chunk: compressed, or plain where that is no larger.
Bytes chunk_of(Bytes plain) {
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(EXR_LEVEL), libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  const Bytes from = differences(plain);
  Bytes made(plain.size());
  made.resize(libdeflate_zlib_compress(compressor.get(), from.data(), from.size(), made.data(), made.size()));
  return made.empty() || made.size() == plain.size() ? std::move(plain) : made;
}

/// A rectangle of pixels by its first and last ones.
exr_attr_box2i_t box_of(std::int32_t x, std::int32_t y, std::int32_t width, std::int32_t height) {
  exr_attr_box2i_t box{};
  box.min.x = x;
  box.min.y = y;
  box.max.x = x + width - 1;
  box.max.y = y + height - 1;
  return box;
}

/// A file that OpenEXR writes into memory.
class ExrFile {
 public:
  explicit ExrFile(Bytes& bytes) {
    exr_context_initializer_t setting = EXR_DEFAULT_CONTEXT_INITIALIZER;
    setting.user_data = &bytes;
    setting.write_fn = write;
    setting.error_handler_fn = [](exr_const_context_t, exr_result_t, const char*) {};
    demand(exr_start_write(&file_, "memory", EXR_WRITE_FILE_DIRECTLY, &setting));
  }
  ~ExrFile() { exr_finish(&file_); }
  ExrFile(const ExrFile&) = delete;
  ExrFile& operator=(const ExrFile&) = delete;

  void write_header(const PictureHeader& header) {
    const exr_attr_box2i_t data = box_of(header.x, header.y, header.width, header.height);
    const bool whole = header.full_width == 0;
    const exr_attr_box2i_t display =
        box_of(0, 0, whole ? header.width : header.full_width, whole ? header.height : header.full_height);
    const exr_attr_v2f_t middle{};
    demand(exr_add_part(file_, nullptr, EXR_STORAGE_SCANLINE, &part_));
    demand(exr_initialize_required_attr(file_, part_, &display, &data, 1.0F, &middle, 1.0F,
                                        EXR_LINEORDER_INCREASING_Y, EXR_COMPRESSION_ZIP));
    for (const std::string& name : header.channels)
      demand(
          exr_add_channel(file_, part_, name.c_str(), EXR_PIXEL_FLOAT, EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1));
    for (const auto& [name, value] : header.attributes) {
      if (!name.starts_with("splatray.")) continue;
      if (name.size() > SHORT_NAME) demand(exr_set_longname_support(file_, 1));
      demand(exr_attr_set_string(file_, part_, name.c_str(), value.c_str()));
    }
    demand(exr_write_header(file_));
  }

  void write_chunk(int row, const Bytes& chunk) {
    demand(exr_write_scanline_chunk(file_, part_, row, chunk.data(), chunk.size()));
  }

 private:
  static void demand(exr_result_t result) {
    if (result == EXR_ERR_OUT_OF_MEMORY) throw std::bad_alloc();
    if (result != EXR_ERR_SUCCESS) throw std::runtime_error(exr_get_error_code_as_string(result));
  }

  static std::int64_t write(exr_const_context_t file, void* user_data, const void* values, std::uint64_t size,
                            std::uint64_t offset, exr_stream_error_func_ptr_t fail) {
    Bytes& bytes = *static_cast<Bytes*>(user_data);
    try {
      if (bytes.size() < offset + size) bytes.resize(offset + size);
    } catch (const std::bad_alloc&) {
      fail(file, EXR_ERR_OUT_OF_MEMORY, "no memory");
      return -1;
    }
    std::memcpy(bytes.data() + offset, values, size);
    return static_cast<std::int64_t>(size);
  }

  exr_context_t file_ = nullptr;
  int part_ = 0;
};

}  // namespace

std::vector<unsigned char> encode_exr(const PictureHeader& header, const float* values) {
  const std::vector<std::size_t> order = file_order(header.channels);
  const auto width = static_cast<std::size_t>(header.width), height = static_cast<std::size_t>(header.height);
  std::vector<Bytes> chunks((height + CHUNK_ROWS - 1) / CHUNK_ROWS);
  on_all_cores(chunks.size(), [&](std::size_t i) {
    const std::size_t begin = i * CHUNK_ROWS;
    chunks[i] = chunk_of(plain_rows(order, values, width, begin, std::min(begin + CHUNK_ROWS, height)));
  });
  Bytes bytes;
  {
    ExrFile file(bytes);
    file.write_header(header);
    for (std::size_t i = 0; i < chunks.size(); ++i)
      file.write_chunk(header.y + static_cast<int>(i) * CHUNK_ROWS, chunks[i]);
  }
  return bytes;
}

}  // namespace splatray
