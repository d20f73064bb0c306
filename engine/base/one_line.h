/// Texts of files in messages.
#pragma once
#include <algorithm>
#include <string>

namespace splatray {

/// The text with a '?' for each control character, so that what a file says neither breaks a message's line nor commands
/// the terminal.
[[nodiscard]] inline std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; }, '?');
  return text;
}

}  // namespace splatray
