/// A ball at coordinates of surveys, and sheets of it.
#pragma once
#include <string>

#include "app/library/request/fields.h"
#include "data/shapes.h"
#include "tests/trace/scenes.h"

namespace splatray::testing {

inline constexpr double FAR_AWAY = 500000.0;  ///< as coordinates of surveys are

/// A ball of radius 1 around (FAR_AWAY, 10 FAR_AWAY, 100), z up.
inline Scene ball() {
  TestObject object{sphere({.count = 20000, .even = true, .seed = 7}, 1.0),
                    test_material(MATERIAL_TWO_SIDED)};
  for (glm::dvec3& place : object.points.position) place += glm::dvec3(FAR_AWAY, 10.0 * FAR_AWAY, 100.0);
  Scene scene = scene_of({object});
  scene.up = {0.0, 0.0, 1.0};
  return scene;
}

inline Request with_sheet(const std::string& text) {
  Request request;
  assign(request, {{"sheet", text}}, DOOR_RENDER);
  return request;
}

}  // namespace splatray::testing
