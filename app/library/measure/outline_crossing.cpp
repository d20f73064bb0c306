#include "app/library/measure/outline_crossing.h"

#include <cstddef>
#include <glm/geometric.hpp>

namespace splatray {
namespace {

/// Twice the area of a triangle, positive where it runs counter-clockwise.
double turn_of(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool cross(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d) {
  return turn_of(a, b, c) * turn_of(a, b, d) < 0.0 && turn_of(c, d, a) * turn_of(c, d, b) < 0.0;
}

}  // namespace

std::string crossing_of(std::span<const glm::dvec2> outline) {
  const std::size_t count = outline.size();
  const auto side = [count](std::size_t i) {
    return std::to_string(i + 1) + " to " + std::to_string((i + 1) % count + 1);
  };
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = i + 1; k < count; ++k)
      if (cross(outline[i], outline[(i + 1) % count], outline[k], outline[(k + 1) % count]))
        return "from place " + side(i) + " crosses that from " + side(k);
  return {};
}

std::vector<glm::dvec2> flat_outline(std::span<const glm::dvec3> places) {
  glm::dvec3 spread(0.0);
  for (std::size_t i = 1; i + 1 < places.size(); ++i)
    spread += glm::abs(glm::cross(places[i] - places[0], places[i + 1] - places[0]));
  int along = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (spread[axis] > spread[along]) along = axis;
  std::vector<glm::dvec2> flat;
  for (const glm::dvec3& place : places) {
    const glm::dvec3 from = place - places[0];
    flat.emplace_back(from[(along + 1) % 3], from[(along + 2) % 3]);
  }
  return flat;
}

}  // namespace splatray
