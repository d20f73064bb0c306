/// Numbers as text that reads back to the same bits, whatever the locale.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <string>

namespace splatray {

/// The shortest decimal text that std::strtod reads as exactly `value`.
[[nodiscard]] std::string number_text(double value);
/// The same for a float: std::strtod's double, rounded to float, is exactly `value`.
[[nodiscard]] std::string number_text(float value);
/// The components with `separator` between them.
[[nodiscard]] std::string number_text(const glm::dvec3& v, char separator = ',');
[[nodiscard]] std::string number_text(const glm::vec3& v, char separator = ',');

/// Bytes for people: "1.5 MiB", "2.25 GiB".
[[nodiscard]] std::string bytes_text(std::uint64_t bytes);

}  // namespace splatray
