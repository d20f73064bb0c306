/// Whether an outline crosses itself, so that it has no area and no inside.
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace splatray {

/// Which sides of a closed outline cross, "from place 1 to 2 crosses that from 3 to 4", the first that do; empty where none does. Sides
/// that only touch do not cross.
[[nodiscard]] std::string crossing_of(std::span<const glm::dvec2> outline);
/// Places about in a plane, seen along the axis across which they spread most.
[[nodiscard]] std::vector<glm::dvec2> flat_outline(std::span<const glm::dvec3> places);

}  // namespace splatray
