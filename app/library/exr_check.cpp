#include "app/library/exr_check.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string_view>
#include <utility>

namespace splatray {
namespace {

constexpr std::array<unsigned char, 4> MAGIC = {0x76, 0x2F, 0x31, 0x01};
constexpr std::uint32_t MULTI_PART = 0x1000;  ///< bit of the version field
constexpr std::size_t LONGEST_NAME = 255;     ///< of an attribute, or of its type
constexpr std::uint64_t MOST_LINES = 256;     ///< that a chunk of any compression holds
constexpr std::uint64_t OFFSET_BYTES = 8;     ///< of a chunk in the table

/// Types whose values OpenEXR reads without a look at the size stated, and the bytes it reads.
constexpr std::array<std::pair<std::string_view, std::uint32_t>, 25> FIXED_TYPES = {{{"int", 4},
                                                                                     {"float", 4},
                                                                                     {"double", 8},
                                                                                     {"box2i", 16},
                                                                                     {"box2f", 16},
                                                                                     {"v2i", 8},
                                                                                     {"v2f", 8},
                                                                                     {"v2d", 16},
                                                                                     {"v3i", 12},
                                                                                     {"v3f", 12},
                                                                                     {"v3d", 24},
                                                                                     {"m33f", 36},
                                                                                     {"m33d", 72},
                                                                                     {"m44f", 64},
                                                                                     {"m44d", 128},
                                                                                     {"envmap", 1},
                                                                                     {"compression", 1},
                                                                                     {"lineOrder", 1},
                                                                                     {"tiledesc", 9},
                                                                                     {"rational", 8},
                                                                                     {"timecode", 8},
                                                                                     {"keycode", 28},
                                                                                     {"chromaticities", 32},
                                                                                     {"deepImageState", 1},
                                                                                     {"v4f", 16}}};

/// Bytes that a list of channels takes by what it holds; more than `value` has where it has no end.
std::size_t channel_list_bytes(const std::string& value) {
  constexpr std::size_t CHANNEL_BYTES = 16;  // behind its name
  for (std::size_t at = 0; at < value.size();) {
    const std::size_t end = value.find('\0', at);
    if (end == std::string::npos) break;
    if (end == at) return at + 1;
    at = end + 1 + CHANNEL_BYTES;
  }
  return value.size() + 1;
}

/// The same of a small picture in the header: its edges, then four bytes a pixel.
std::uint64_t preview_bytes(const std::string& value) {
  std::array<std::uint32_t, 2> edges{};
  if (value.size() < sizeof edges) return sizeof edges;
  std::memcpy(&edges, value.data(), sizeof edges);
  return sizeof edges + 4 * (std::uint64_t{edges[0]} * edges[1] & 0xFFFFFFFFFFFFFFU);
}

class ExrHeader {
 public:
  explicit ExrHeader(const std::filesystem::path& path) : file_(path, std::ios::binary) {
    std::error_code error;
    size_ = std::filesystem::file_size(path, error);
    if (error) size_ = 0;
  }

  std::optional<std::string> defect() {
    std::array<unsigned char, 4> magic{};
    std::uint32_t version = 0;
    if (!read(magic.data(), magic.size()) || magic != MAGIC) return {};
    if (!read(&version, sizeof version)) return "an OpenEXR header without an end";
    do {
      if (auto found = part_defect()) return found;
    } while ((version & MULTI_PART) != 0 && !ended_);
    return {};
  }

 private:
  bool read(void* target, std::size_t bytes) {
    position_ += bytes;
    return bool(file_.read(static_cast<char*>(target), static_cast<std::streamsize>(bytes)));
  }

  /// A text up to its zero byte; nothing when it is too long or the file ends.
  std::optional<std::string> name() {
    std::string text;
    for (char c = 0; read(&c, 1);) {
      if (c == 0) return text;
      if (text.size() == LONGEST_NAME) return {};
      text += c;
    }
    return {};
  }

  /// One part's header, up to the empty name at its end.
  std::optional<std::string> part_defect() {
    ended_ = true;  // unless an attribute follows
    for (;;) {
      const auto attribute = name();
      if (!attribute) return "an OpenEXR header without an end";
      if (attribute->empty()) return table_defect();
      ended_ = false;
      const auto type = name();
      std::uint32_t bytes = 0;
      if (!type || !read(&bytes, sizeof bytes)) return "an OpenEXR header without an end";
      if (bytes > size_ - std::min(position_, size_))
        return "an attribute '" + *attribute + "' of " + std::to_string(bytes) + " bytes";
      if (auto found = value_defect(*attribute, *type, bytes)) return found;
    }
  }

  std::optional<std::string> value_defect(const std::string& attribute, const std::string& type,
                                          std::uint32_t bytes) {
    std::string value(bytes, '\0');
    if (!read(value.data(), bytes)) return "an OpenEXR header without an end";
    if (attribute == "dataWindow" && bytes == sizeof window_) std::memcpy(&window_, value.data(), bytes);
    if (attribute == "tiles" && bytes >= sizeof tile_) std::memcpy(&tile_, value.data(), sizeof tile_);
    const auto fixed = std::find_if(FIXED_TYPES.begin(), FIXED_TYPES.end(),
                                    [&type](const auto& row) { return row.first == type; });
    if ((fixed != FIXED_TYPES.end() && fixed->second != bytes) ||
        (type == "chlist" && channel_list_bytes(value) != bytes) ||
        (type == "preview" && preview_bytes(value) != bytes))
      return "an attribute '" + attribute + "' of type " + type + " and " + std::to_string(bytes) + " bytes";
    if (type != "stringvector") return {};
    for (std::size_t at = 0; at + 4 <= value.size();) {
      std::uint32_t length = 0;
      std::memcpy(&length, value.data() + at, sizeof length);
      at += sizeof length;
      if (length > value.size() - at)
        return "a text of " + std::to_string(length) + " bytes in '" + attribute + "'";
      at += length;
    }
    return {};
  }

  /// The table of offsets that follows from the window must be in the file.
  std::optional<std::string> table_defect() {
    const auto edge = [](std::int32_t low, std::int32_t high) {
      return static_cast<std::uint64_t>(std::max<std::int64_t>(std::int64_t{high} - low + 1, 0));
    };
    const std::uint64_t width = edge(window_[0], window_[2]), height = edge(window_[1], window_[3]);
    const auto over = [](std::uint64_t pixels, std::uint64_t step) { return (pixels + step - 1) / step; };
    const bool tiled = tile_[0] > 0 && tile_[1] > 0;
    const std::uint64_t across = tiled ? over(width, tile_[0]) : 1;
    const std::uint64_t down = tiled ? over(height, tile_[1]) : over(height, MOST_LINES);
    window_ = {};
    tile_ = {};
    if (across == 0 || down <= size_ / OFFSET_BYTES / across) return {};
    return "a picture of " + std::to_string(width) + " x " + std::to_string(height) + " pixels";
  }

  std::ifstream file_;
  std::uint64_t size_ = 0;
  std::uint64_t position_ = 0;
  bool ended_ = false;                    ///< the last part was the empty one behind all
  std::array<std::int32_t, 4> window_{};  ///< dataWindow: least x, y, greatest x, y
  std::array<std::uint32_t, 2> tile_{};   ///< pixels; 0 = not tiled
};

}  // namespace

std::optional<std::string> find_exr_defect(const std::filesystem::path& path) {
  return ExrHeader(path).defect();
}

}  // namespace splatray
