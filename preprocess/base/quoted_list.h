/// Names in messages.
#pragma once
#include <algorithm>
#include <string>
#include <vector>

namespace splatray {

/// "'a', 'b'": the names quoted, the first ten, then how many more.
[[nodiscard]] inline std::string quoted_list(const std::vector<std::string>& names) {
  constexpr std::size_t MOST = 10;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), MOST); ++i) {
    text += (i == 0 ? "'" : ", '") + names[i] + "'";
  }
  return names.size() <= MOST ? text : text + " and " + std::to_string(names.size() - MOST) + " more";
}

}  // namespace splatray
