#include "engine/base/number_text.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>

namespace splatray {
namespace {

template <typename Number>
std::string shortest(Number value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// The double that the whole text is; nothing where it is none or beyond a double's range.
std::optional<double> number_of(std::string_view text) {
  double number = 0.0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && rest == end ? std::optional(number) : std::nullopt;
}

template <typename Vector>
std::string joined(const Vector& v, char separator) {
  return number_text(v.x) + separator + number_text(v.y) + separator + number_text(v.z);
}

}  // namespace

std::string number_text(double value) { return shortest(value); }

std::string number_text(float value) {
  const std::string text = shortest(value);
  // A short text near the midpoint of two floats may become that midpoint as a double, and the wrong float.
  const std::optional<double> read = number_of(text);
  return read && static_cast<float>(*read) == value ? text : shortest(static_cast<double>(value));
}

std::string number_text(const glm::dvec3& v, char separator) { return joined(v, separator); }
std::string number_text(const glm::vec3& v, char separator) { return joined(v, separator); }

std::vector<double> split_numbers(std::string_view text, char separator, std::size_t count) {
  std::vector<double> numbers;
  for (bool more = true; more;) {
    const std::size_t end = text.find(separator);
    std::string_view part = text.substr(0, end);
    if (part.starts_with('+') && !part.starts_with("+-")) part.remove_prefix(1);
    const std::optional<double> number = number_of(part);
    if (!number || !std::isfinite(*number) || numbers.size() == count) return {};
    numbers.push_back(*number);
    more = end != std::string_view::npos;
    if (more) text.remove_prefix(end + 1);
  }
  return numbers.size() == count ? numbers : std::vector<double>{};
}

std::string short_number(double value) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.3g", value);
  return text;
}

std::string bytes_text(std::uint64_t bytes) {
  const double mib = static_cast<double>(bytes) / (1024.0 * 1024.0);
  char text[40];
  std::snprintf(text, sizeof(text), mib < 1024.0 ? "%.1f MiB" : "%.2f GiB",
                mib < 1024.0 ? mib : mib / 1024.0);
  return text;
}

}  // namespace splatray
