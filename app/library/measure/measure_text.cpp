#include "app/library/measure/measure_text.h"

#include "app/library/request/value_text.h"
#include "engine/base/number_text.h"

namespace splatray {
namespace {

const std::string PLACES = "places X,Y,Z or rays X,Y,Z>DX,DY,DZ with ; between them";

glm::dvec3 read_triple(const std::string& text) {
  const auto numbers = split_numbers(text, ',', 3);
  if (numbers.empty()) throw Expected{PLACES};
  return {numbers[0], numbers[1], numbers[2]};
}

GivenPlace read_place(const std::string& text) {
  const std::size_t arrow = text.find('>');
  GivenPlace place;
  place.place = read_triple(text.substr(0, arrow));
  if (arrow == std::string::npos) return place;
  place.direction = read_triple(text.substr(arrow + 1));
  if (*place.direction == glm::dvec3(0.0)) throw Expected{"a direction DX,DY,DZ other than 0,0,0"};
  return place;
}

std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == ';')
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

}  // namespace

void require_places(const GivenMeasure& given) {
  const std::size_t needed = points_needed(given.kind), found = given.places.size();
  if (found < needed || (found > needed && !is_open_ended(given.kind)))
    throw Expected{std::to_string(needed) +
                   (is_open_ended(given.kind) ? " or more places" : (needed == 1 ? " place" : " places"))};
  if (is_fitted(given.kind) && !(given.reach > 0.0)) throw Expected{"a reach above 0"};
}

GivenMeasure read_measure(MeasureKind kind, const std::string& text) {
  GivenMeasure given{kind, {}};
  std::vector<std::string> parts = parts_of(text);
  if (is_fitted(kind)) {
    const auto reach = split_numbers(parts.back(), ',', 1);
    if (parts.size() != 2 || reach.empty() || !(reach[0] > 0.0))
      throw Expected{"a place and a reach above 0, such as 1,2,3;0.5"};
    given.reach = reach[0];
    parts.pop_back();
  }
  for (const std::string& part : parts) given.places.push_back(read_place(part));
  try {
    require_places(given);
  } catch (const Expected& expected) {
    throw Expected{expected.what + ": " + PLACES};
  }
  return given;
}

}  // namespace splatray
