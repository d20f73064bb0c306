#include "app/library/codec/kept_text.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <string_view>

namespace splatray {
namespace {

constexpr std::string_view PREFIX = "splatray.", CHUNK = "SPLT";

/// The value's lowest bytes, the lowest first.
std::string little_endian(std::uint64_t value, unsigned bytes) {
  std::string text;
  for (unsigned i = 0; i < bytes; ++i) text += static_cast<char>(value >> 8U * i & 0xFFU);
  return text;
}

std::uint32_t load_little_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8U | static_cast<unsigned char>(bytes[i]);
  return value;
}

/// Adds what a name, a zero and a value say.
void take_pair(std::string_view said, KeptText& text) {
  const std::size_t end = said.find('\0');
  if (end != std::string_view::npos && said.starts_with(PREFIX))
    text.emplace_back(said.substr(0, end), said.substr(end + 1));
}

/// Reads a JPEG's segments up to where its pixels begin.
KeptText read_jpeg(std::ifstream& file) {
  constexpr unsigned char MARK = 0xFF, COMMENT = 0xFE, SCAN = 0xDA;
  KeptText text;
  file.seekg(2);
  unsigned char head[4];
  while (file.read(reinterpret_cast<char*>(head), sizeof head) && head[0] == MARK && head[1] != SCAN) {
    const int length = head[2] << 8 | head[3];
    if (length < 2) break;
    std::string data(static_cast<std::size_t>(length - 2), '\0');
    if (!file.read(data.data(), length - 2)) break;
    if (head[1] == COMMENT) take_pair(data, text);
  }
  return text;
}

/// Reads a WebP's chunks; pairs of ours have a zero behind each text.
KeptText read_webp(std::ifstream& file, std::uint64_t file_bytes) {
  constexpr std::size_t HEAD = 8;
  KeptText text;
  file.seekg(12);
  std::string head(HEAD, '\0');
  while (file.read(head.data(), HEAD)) {
    const std::uint32_t length = load_little_endian(std::string_view(head).substr(4));
    if (length > file_bytes) break;
    if (!head.starts_with(CHUNK)) {
      file.seekg(std::streamoff{length} + length % 2, std::ios::cur);
      continue;
    }
    std::string data(length, '\0');
    if (!file.read(data.data(), length)) break;
    std::string_view rest = data;
    for (std::size_t name = rest.find('\0'); name != std::string_view::npos; name = rest.find('\0')) {
      const std::size_t end = rest.find('\0', name + 1);
      if (end == std::string_view::npos) break;
      take_pair(rest.substr(0, end), text);
      rest.remove_prefix(end + 1);
    }
  }
  return text;
}

std::string riff_chunk(std::string_view name, const std::string& data) {
  return std::string(name) + little_endian(data.size(), 4) + data + std::string(data.size() % 2, '\0');
}

}  // namespace

void add_jpeg_text(std::vector<unsigned char>& bytes, const KeptText& text) {
  constexpr std::size_t MOST = 65533, BEGIN = 2;  // of a segment; behind the mark of the begin
  constexpr std::size_t LENGTH = 2;
  // Behind JFIF's own segment, which is to be the first.
  const std::size_t first =
      bytes.size() > BEGIN + 4 ? std::size_t{bytes[BEGIN + 2]} << 8U | bytes[BEGIN + 3] : 0;
  std::string segments;
  for (const auto& [name, value] : text) {
    const std::string said = name + '\0' + value;
    if (!name.starts_with(PREFIX) || said.size() > MOST) continue;
    const std::size_t length = said.size() + LENGTH;
    segments += "\xFF\xFE";
    segments += static_cast<char>(length >> 8U);
    segments += static_cast<char>(length & 0xFFU);
    segments += said;
  }
  const auto place = bytes.begin() + static_cast<std::ptrdiff_t>(BEGIN + 2 + first);
  bytes.insert(place, segments.begin(), segments.end());
}

void add_webp_text(std::vector<unsigned char>& bytes, const KeptText& text, int width, int height,
                   bool has_alpha) {
  constexpr std::size_t RIFF = 12;  ///< bytes before the first chunk
  constexpr char ALPHA = 0x10;
  std::string said;
  for (const auto& [name, value] : text)
    if (name.starts_with(PREFIX)) said += name + '\0' + value + '\0';
  if (said.empty()) return;
  const std::string_view first(reinterpret_cast<const char*>(bytes.data()) + RIFF, 4);
  if (first != "VP8X") {
    const std::string size = little_endian(static_cast<std::uint64_t>(width - 1), 3) +
                             little_endian(static_cast<std::uint64_t>(height - 1), 3);
    const std::string extended =
        riff_chunk("VP8X", std::string(1, has_alpha ? ALPHA : '\0') + std::string(3, '\0') + size);
    bytes.insert(bytes.begin() + RIFF, extended.begin(), extended.end());
  }
  const std::string added = riff_chunk(CHUNK, said);
  bytes.insert(bytes.end(), added.begin(), added.end());
  const std::string length = little_endian(bytes.size() - 8, 4);
  std::copy(length.begin(), length.end(), bytes.begin() + 4);
}

KeptText read_kept_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const auto size = static_cast<std::uint64_t>(std::max<std::streamoff>(file.tellg(), 0));
  std::string head(12, '\0');
  if (!file.seekg(0).read(head.data(), static_cast<std::streamsize>(head.size()))) return {};
  if (head.starts_with("\xFF\xD8")) return read_jpeg(file);
  if (head.starts_with("RIFF") && head.ends_with("WEBP")) return read_webp(file, size);
  return {};
}

}  // namespace splatray
