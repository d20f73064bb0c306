#include "app/library/request/value_text.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "engine/base/number_text.h"

namespace splatray {

double read_number(const std::string& text, double least, double most, bool whole) {
  const auto numbers = split_numbers(text, ',', 1);
  const bool fits = !numbers.empty() && (!whole || numbers[0] == std::floor(numbers[0])) &&
                    numbers[0] >= least && numbers[0] <= most;
  if (fits) return numbers[0];
  std::ostringstream expected;
  expected.precision(12);
  expected << (whole ? "a whole number" : "a number") << " from " << least << " to " << most;
  throw Expected{expected.str()};
}

glm::dvec3 read_vector(const std::string& text) {
  const auto numbers = split_numbers(text, ',', 3);
  if (numbers.empty()) throw Expected{"three numbers such as 1,-2,0.5"};
  return {numbers[0], numbers[1], numbers[2]};
}

std::vector<std::uint32_t> split_whole_numbers(const std::string& text, char separator, std::size_t count) {
  std::vector<std::uint32_t> whole;
  for (const double number : split_numbers(text, separator, count)) {
    if (!(number >= 0.0 && number <= SPLIT_MOST && number == std::floor(number))) return {};
    whole.push_back(static_cast<std::uint32_t>(number));
  }
  return whole;
}

std::vector<std::string> split_names(const std::string& text) {
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    if (end == begin) throw Expected{"names with a comma between"};
    names.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return names;
}

}  // namespace splatray
