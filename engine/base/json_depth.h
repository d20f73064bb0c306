/// How deep JSON nests, measured before a parser sees it: parsers and their values recurse, and a small file could make them
/// run out of stack.
#pragma once
#include <cstddef>
#include <string_view>

namespace splatray {

/// No file of ours, nor any glTF in the wild, nests half as deep.
inline constexpr std::size_t MOST_JSON_DEPTH = 64;

/// Whether arrays and objects lie more than MOST_JSON_DEPTH deep in each other. Every reader of JSON asks this first. Of a
/// text that is no JSON the answer is right up to the place where a parser gives up.
[[nodiscard]] inline bool json_is_too_deep(std::string_view text) {
  std::size_t depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      i += c == '\\' ? 1 : 0;  // the escaped character is not looked at
      in_string = c != '"';
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      if (++depth > MOST_JSON_DEPTH) return true;
    } else if ((c == ']' || c == '}') && depth > 0) {
      --depth;
    }
  }
  return false;
}

}  // namespace splatray
