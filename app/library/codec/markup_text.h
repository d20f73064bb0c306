/// Text within XML and HTML.
#pragma once
#include <string>

namespace splatray {

/// The text with references in place of what would be markup.
[[nodiscard]] inline std::string markup_text(const std::string& text) {
  std::string escaped;
  for (const char c : text)
    escaped += c == '<' ? "&lt;" : (c == '>' ? "&gt;" : (c == '&' ? "&amp;" : std::string(1, c)));
  return escaped;
}

}  // namespace splatray
