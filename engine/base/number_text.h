/// Numbers as text that reads back to the same bits, whatever the locale.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace splatray {

/// The shortest decimal text whose nearest double is `value`.
[[nodiscard]] std::string number_text(double value);
/// The same for a float: the nearest double, rounded to float, is exactly `value`.
[[nodiscard]] std::string number_text(float value);
/// Three digits for people: "0.0214", "2e+03".
[[nodiscard]] std::string short_number(double value);
/// The components with `separator` between them.
[[nodiscard]] std::string number_text(const glm::dvec3& v, char separator = ',');
[[nodiscard]] std::string number_text(const glm::vec3& v, char separator = ',');

/// Finite numbers separated by `separator`, exactly `count` of them, each with or without a plus; empty when the text is anything else.
[[nodiscard]] std::vector<double> split_numbers(std::string_view text, char separator, std::size_t count);

/// Bytes for people: "1.5 MiB", "2.25 GiB".
[[nodiscard]] std::string bytes_text(std::uint64_t bytes);

}  // namespace splatray
