/// Letters of formats that care for no case.
#pragma once
#include <algorithm>
#include <cctype>
#include <string>

namespace splatray {

/// The text with the letters A to Z as a to z.
[[nodiscard]] inline std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace splatray
