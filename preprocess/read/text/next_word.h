/// Words of lines.
#pragma once
#include <algorithm>
#include <string_view>

namespace splatray {

/// Takes the next word, between blanks, from the line's begin; empty at its end.
[[nodiscard]] inline std::string_view next_word(std::string_view& line) {
  constexpr const char* BLANKS = " \t\r";
  const std::size_t begin = std::min(line.find_first_not_of(BLANKS), line.size());
  const std::size_t end = std::min(line.find_first_of(BLANKS, begin), line.size());
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

}  // namespace splatray
