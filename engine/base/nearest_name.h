/// What someone meant who wrote a name that is none.
#pragma once
#include <algorithm>
#include <cctype>
#include <string>
#include <utility>
#include <vector>

namespace splatray {

/// In lower case and American spelling, as the names are.
inline std::string plain_spelling(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const auto& [british, american] :
       {std::pair("colour", "color"), std::pair("grey", "gray"), std::pair("centre", "center")})
    for (std::size_t at = word.find(british); at != std::string::npos; at = word.find(british))
      word.replace(at, std::string(british).size(), american);
  return word;
}

/// Optimal string alignment: letters added, left out, changed, neighbours swapped.
inline std::size_t edits_between(const std::string& a, const std::string& b) {
  std::vector<std::size_t> two_ago, last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0U : 1U)});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], two_ago[j - 2] + 1);
    }
    two_ago = std::exchange(last, row);
  }
  return last[b.size()];
}

/// What other renderers and viewers call our options.
inline std::string our_word(const std::string& word) {
  for (const auto& [theirs, ours] :
       {std::pair("size", "resolution"), std::pair("width", "resolution"), std::pair("height", "resolution"),
        std::pair("res", "resolution"), std::pair("spp", "samples"), std::pair("out", "output"),
        std::pair("hdri", "environment"), std::pair("envmap", "environment"), std::pair("depth", "bounces")})
    if (word == theirs) return ours;
  return {};
}

/// The one of the names that a word most likely stands for: the one that other programs have that word for, else the nearest by edits (upper and lower case and British spelling count
/// nothing), up to a third of the word's letters; else the first that begins with the word. Empty where there is none.
[[nodiscard]] inline std::string nearest_name(const std::string& word,
                                              const std::vector<std::string>& names) {
  const std::string meant = plain_spelling(word);
  if (meant.empty()) return {};
  if (const std::string ours = our_word(meant); std::find(names.begin(), names.end(), ours) != names.end())
    return ours;
  // More edits than a third of the letters make another word of most.
  std::size_t least = std::max<std::size_t>(meant.size() / 3, 1) + 1;
  std::string nearest, longer;
  for (const std::string& name : names) {
    const std::string other = plain_spelling(name);
    if (longer.empty() && other.starts_with(meant)) longer = name;
    if (const std::size_t edits = edits_between(meant, other); edits < least) {
      least = edits;
      nearest = name;
    }
  }
  return nearest.empty() ? longer : nearest;
}

/// "; did you mean NAME?" for the end of a sentence, with `before` before the name; empty where no name is near.
[[nodiscard]] inline std::string did_you_mean(const std::string& word, const std::vector<std::string>& names,
                                              const std::string& before = "") {
  const std::string name = nearest_name(word, names);
  return name.empty() ? std::string() : "; did you mean " + before + name + "?";
}

}  // namespace splatray
