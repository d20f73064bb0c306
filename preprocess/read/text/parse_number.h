/// Numbers in text.
#pragma once
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>

namespace splatray {

[[nodiscard]] inline bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// Reads the number that begins at `begin`, as double: decimal, with a sign or an exponent, also inf, nan and what
/// Microsoft's library prints for these (1.#QNAN). The first character behind it; nullptr where there is no number.
[[nodiscard]] inline const char* parse_number(const char* begin, const char* end, double& value) {
  if (end - begin > 1 && *begin == '+' && begin[1] != '-') ++begin;
  const auto [rest, error] = std::from_chars(begin, end, value);
  if (error == std::errc::invalid_argument) return nullptr;
  if (error == std::errc::result_out_of_range) value = std::strtod(std::string(begin, rest).c_str(), nullptr);
  if (rest == end || *rest != '#') return rest;
  value = NAN;
  const char* behind = rest;
  while (behind != end && !is_blank(*behind) && *behind != ',' && *behind != ';') ++behind;
  return behind;
}

}  // namespace splatray
