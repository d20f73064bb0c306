/// The tiny scene with all that the scene files of a version can hold.
#pragma once
#include "engine/scene/clip.h"
#include "tests/format/tiny_scene.h"

namespace splatray {

/// `version`: 10 to 14. Files of version 15 hold all that those of 14 do.
inline Scene scene_of_version(std::uint32_t version) {
  Scene scene = tiny_scene();
  if (version >= 11)
    scene.lights = {
        {LIGHT_POINT, {1.0, 2.0, 3.0}, vec3(4.0F, 5.0F, 6.0F), 0.25},
        {LIGHT_DIRECTIONAL, {0.0, 1.0, 0.0}, vec3(1.0F)},
        {LIGHT_RECTANGLE, {0.0, 5.0, 0.0}, vec3(2.0F, 3.0F, 4.0F), 0.0, {3.0, 0.0, 4.0}, {0.0, 0.5, 0.0}}};
  if (version >= 12) {
    scene.lights.front().spot_axis = {0.0, -2.0, 0.0};
    scene.lights.front().spot_inner = 0.25;
    scene.lights.front().spot_outer = 0.5;
    scene.lights.front().range = 8.0;
  }
  if (version >= 13)
    scene.field_pool.edit()[1] = pack_lean({0.25, 0.0, 0.0}, unpack_splat(scene.data_pool[1]).normal);
  if (version >= 14) {
    scene.clip_pool.edit()[1] = pack_ellipse(scene.data_pool[1], {1.0, 0.0, 0.0}, 5.0);
    scene.crs = "PROJCS[\"ETRS89 / UTM zone 32N\",UNIT[\"metre\",1]]";
    scene.stations[1].noise_world = 0.003;
    scene.stations[0].step_world = 1e-4;
  }
  return scene;
}

}  // namespace splatray
