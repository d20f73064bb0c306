#include "engine/base/utf8.h"

#include <algorithm>

namespace splatray {
namespace {

/// Length by a sequence's first byte, 0 where none begins so.
std::size_t length_by_lead(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead < 0xE0) return 2;
  if (lead >= 0xE0 && lead < 0xF0) return 3;
  return lead >= 0xF0 && lead < 0xF5 ? 4 : 0;
}

/// Whether a second byte may follow a first: no overlong forms, surrogates or numbers beyond U+10FFFF.
bool may_follow(unsigned char lead, unsigned char second) {
  const unsigned char least = lead == 0xE0 ? 0xA0 : (lead == 0xF0 ? 0x90 : 0x80);
  const unsigned char most = lead == 0xED ? 0x9F : (lead == 0xF4 ? 0x8F : 0xBF);
  return second >= least && second <= most;
}

/// Whether the bytes behind the first are what follows it, as far as there are any, up to the sequence's length.
bool goes_on(std::string_view text, std::size_t length) {
  for (std::size_t i = 1; i < std::min(length, text.size()); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (i == 1 ? !may_follow(static_cast<unsigned char>(text[0]), byte) : (byte & 0xC0U) != 0x80)
      return false;
  }
  return true;
}

}  // namespace

std::size_t utf8_length(std::string_view text) {
  const std::size_t length = text.empty() ? 0 : length_by_lead(static_cast<unsigned char>(text[0]));
  return length <= text.size() && goes_on(text, length) ? length : 0;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string to_utf8(std::string_view text) {
  std::string utf8;
  utf8.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length > 0) {
      utf8 += text.substr(0, length);
    } else {
      const auto byte = static_cast<unsigned char>(text[0]);
      utf8 += static_cast<char>(0xC0U | byte >> 6U);
      utf8 += static_cast<char>(0x80U | (byte & 0x3FU));
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return utf8;
}

std::string path_text(const std::filesystem::path& path) { return to_utf8(path.string()); }

std::size_t cut_utf8_bytes(std::string_view text) {
  for (std::size_t bytes = 1; bytes <= std::min<std::size_t>(3, text.size()); ++bytes) {
    const std::string_view end = text.substr(text.size() - bytes);
    const std::size_t length = length_by_lead(static_cast<unsigned char>(end[0]));
    if (length > bytes && goes_on(end, length)) return bytes;
  }
  return 0;
}

}  // namespace splatray
