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

/// The text without these letters at its begin and end.
[[nodiscard]] inline std::string_view without_blanks(std::string_view text,
                                                     std::string_view blanks = " \t\r\"") {
  const std::size_t begin = std::min(text.find_first_not_of(blanks), text.size());
  return text.substr(begin, text.find_last_not_of(blanks) + 1 - begin);
}

}  // namespace splatray
