/// Texts of files in messages.
#pragma once
#include <algorithm>
#include <string>
#include <string_view>

#include "engine/base/utf8.h"

namespace splatray {

/// The text in UTF-8 with a '?' for each control character, so that what a file says neither breaks a message's line nor commands
/// the terminal.
[[nodiscard]] inline std::string one_line(std::string_view text) {
  std::string line = to_utf8(text);
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; }, '?');
  return line;
}

}  // namespace splatray
