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

const std::string BASES = "z=HEIGHT, plane=X,Y,Z,NX,NY,NZ, corners or earlier=FILE";

}  // namespace

GivenBase read_base(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string key = text.substr(0, equals),
                    value = equals == std::string::npos ? std::string() : text.substr(equals + 1);
  GivenBase base;
  if (key == "z") {
    const auto numbers = split_numbers(value, ',', 1);
    if (numbers.empty()) throw Expected{"a base of a volume, " + BASES};
    base.height = numbers[0];
  } else if (key == "plane") {
    const auto numbers = split_numbers(value, ',', 6);
    base.kind = GivenBase::Kind::plane;
    if (!numbers.empty()) {
      base.place = {numbers[0], numbers[1], numbers[2]};
      base.normal = {numbers[3], numbers[4], numbers[5]};
    }
    if (base.normal == glm::dvec3(0.0)) throw Expected{"a place and a direction, plane=X,Y,Z,NX,NY,NZ"};
  } else if (text == "corners") {
    base.kind = GivenBase::Kind::corners;
  } else if (key == "earlier" && !value.empty()) {
    base.kind = GivenBase::Kind::earlier;
    base.earlier = value;
  } else {
    throw Expected{"a base of a volume, " + BASES};
  }
  return base;
}

void require_places(const GivenMeasure& given) {
  const std::size_t needed = points_needed(given.kind), found = given.places.size();
  if (given.kind == MeasureKind::volume) {
    if (!given.base) throw Expected{"a base of a volume, " + BASES};
    const bool has_corners = given.base->kind == GivenBase::Kind::corners;
    if (has_corners ? found < 3 : found == 1 || found == 2)
      throw Expected{has_corners ? "3 or more places"
                                 : "3 or more places, or none for all that the region holds"};
    return;
  }
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
  if (kind == MeasureKind::volume) {
    given.base = read_base(parts.back());
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
