/// Values as text that people write; all fields and options read them alike.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace splatray {

/// What reading a value throws: what it expected in place of the text.
struct Expected {
  std::string what;
};

/// A name and what it stands for.
template <class Value>
struct Choice {
  std::string name;
  Value value;
};

/// The number that `text` is, whole if asked for, in [least, most]; else throws Expected.
[[nodiscard]] double read_number(const std::string& text, double least, double most, bool whole);
/// The three numbers that `text` is; else throws Expected.
[[nodiscard]] glm::dvec3 read_vector(const std::string& text);
/// Whole numbers from 0 to SPLIT_MOST, such as pixels of a side, as split_numbers has them; empty when the text is anything else.
inline constexpr double SPLIT_MOST = 32768.0;
[[nodiscard]] std::vector<std::uint32_t> split_whole_numbers(const std::string& text, char separator,
                                                             std::size_t count);
/// The parts of a list with commas between; throws Expected where one is empty.
[[nodiscard]] std::vector<std::string> split_names(const std::string& text);

}  // namespace splatray
