#include "engine/base/number_text.h"

#include <cstdio>

#include <charconv>
#include <cstdlib>

namespace splatray {
namespace {

template <typename Number>
std::string shortest(Number value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
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
  return static_cast<float>(std::strtod(text.c_str(), nullptr)) == value
             ? text
             : shortest(static_cast<double>(value));
}

std::string number_text(const glm::dvec3& v, char separator) { return joined(v, separator); }
std::string number_text(const glm::vec3& v, char separator) { return joined(v, separator); }

std::string bytes_text(std::uint64_t bytes) {
  const double mib = static_cast<double>(bytes) / (1024.0 * 1024.0);
  char text[40];
  std::snprintf(text, sizeof(text), mib < 1024.0 ? "%.1f MiB" : "%.2f GiB",
                mib < 1024.0 ? mib : mib / 1024.0);
  return text;
}

}  // namespace splatray
