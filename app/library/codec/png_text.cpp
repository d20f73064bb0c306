#include "app/library/codec/png_text.h"

#include <algorithm>
#include <fstream>
#include <iterator>

namespace splatray {
namespace {

constexpr std::size_t SIGNATURE = 8;
constexpr std::size_t HEADER_END = SIGNATURE + 4 + 4 + 13 + 4;  ///< of the chunk IHDR, which is first
constexpr std::string_view MAGIC{"\x89PNG"};

}  // namespace

std::uint64_t png_bits(const std::string& path) {
  constexpr std::size_t DEPTH = 24;
  constexpr std::uint64_t CHANNELS[] = {1, 1, 3, 1, 2, 1, 4};  // by kind of colour
  std::string start(HEADER_END, '\0');
  std::ifstream file(path, std::ios::binary);
  if (!file.read(start.data(), HEADER_END) || !start.starts_with(MAGIC)) return 1;
  const auto kind = static_cast<unsigned char>(start[DEPTH + 1]);
  return kind < std::size(CHANNELS)
             ? CHANNELS[kind] * std::max<unsigned char>(1, static_cast<unsigned char>(start[DEPTH]))
             : 1;
}

PngText read_png_text(const std::string& path) {
  PngText text;
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const auto size = static_cast<std::uint64_t>(std::max<std::streamoff>(file.tellg(), 0));
  std::string head(SIGNATURE, '\0');
  if (!file.seekg(0).read(head.data(), SIGNATURE) || !head.starts_with(MAGIC)) return text;
  while (file.read(head.data(), SIGNATURE)) {
    std::uint64_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8U | static_cast<unsigned char>(head[i]);
    if (length > size) break;
    if (head.substr(4) != "tEXt") {
      file.seekg(static_cast<std::streamoff>(length + 4), std::ios::cur);
      continue;
    }
    std::string data(length, '\0');
    if (!file.read(data.data(), static_cast<std::streamsize>(length))) break;
    const std::size_t end = data.find('\0');
    if (end != std::string::npos) text.emplace_back(data.substr(0, end), data.substr(end + 1));
    file.seekg(4, std::ios::cur);
  }
  return text;
}

}  // namespace splatray
