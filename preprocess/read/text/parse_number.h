/// Numbers in text.
#pragma once
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

namespace splatray {

[[nodiscard]] inline bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// Whether a cell may end before this character.
[[nodiscard]] inline bool is_cell_end(char c) { return is_blank(c) || c == ',' || c == ';'; }

/// Reads a number of at most 15 digits without an exponent, as are nearly all. Its digits and the power of ten that divides
/// them are doubles without rounding, so that the quotient is the nearest double (Clinger 1990, "How to read floating
/// point numbers accurately", sec. 5). The first character behind it; nullptr where it is no such number.
[[nodiscard]] inline const char* parse_short_number(const char* begin, const char* end, double& value) {
  constexpr std::ptrdiff_t MOST_DIGITS = 15;
  constexpr double POWERS[] = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                               1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  const char* at = begin;
  const bool negative = at != end && *at == '-';
  at += negative ? 1 : 0;
  std::uint64_t digits = 0;
  const auto read_digits = [&] {
    const char* const first = at;
    for (; at != end && *at >= '0' && *at <= '9'; ++at)
      digits = 10 * digits + static_cast<unsigned char>(*at - '0');
    return at - first;
  };
  const std::ptrdiff_t before_point = read_digits();
  std::ptrdiff_t fraction = 0;
  if (at != end && *at == '.') {
    ++at;
    fraction = read_digits();
  }
  const std::ptrdiff_t count = before_point + fraction;
  if (count == 0 || count > MOST_DIGITS || (at != end && !is_cell_end(*at))) return nullptr;
  const double size = static_cast<double>(digits) / POWERS[fraction];
  value = negative ? -size : size;
  return at;
}

/// Reads the number that begins at `begin`, as the nearest double: decimal, with a sign or an exponent, also inf, nan and
/// what Microsoft's library prints for these (1.#QNAN). The first character behind it; nullptr where there is no number.
[[nodiscard]] inline const char* parse_number(const char* begin, const char* end, double& value) {
  if (end - begin > 1 && *begin == '+' && begin[1] != '-') ++begin;
  if (const char* const rest = parse_short_number(begin, end, value)) return rest;
  const auto [rest, error] = std::from_chars(begin, end, value);
  if (error == std::errc::invalid_argument) return nullptr;
  if (error == std::errc::result_out_of_range) value = std::strtod(std::string(begin, rest).c_str(), nullptr);
  if (rest == end || *rest != '#') return rest;
  value = NAN;
  const char* behind = rest;
  while (behind != end && !is_cell_end(*behind)) ++behind;
  return behind;
}

/// What is wrong with a word that stands where a number is expected.
[[nodiscard]] inline std::string no_number(std::string_view word) {
  constexpr std::size_t SHOWN = 20;
  const std::string found = "found '" + std::string(word.substr(0, SHOWN)) + "'";
  std::string pointed(word);
  std::replace(pointed.begin(), pointed.end(), ',', '.');
  double value = 0.0;
  const char* const end = pointed.data() + pointed.size();
  const bool has_comma = pointed != word && parse_number(pointed.data(), end, value) == end;
  return found + (has_comma ? " with a decimal comma, expected a number with a decimal point"
                            : ", expected a number");
}

}  // namespace splatray
