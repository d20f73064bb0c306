// A thread of empty.comp.glsl. Needs what bindings.glsl declares.
#ifndef SPLATRAY_EMPTY_GLSL
#define SPLATRAY_EMPTY_GLSL
#include "stage/pixels.glsl"

void write_miss(uint index) {
  aov[index].normal = vec3(0.0f);
  aov[index].z = INFINITY_F;
  aov[index].object = NO_OBJECT;
  aov[index].splat = 1u;
  aov[index].tests = 0u;
  aov[index].steps = 0u;
}

void add_misses(uvec2 pixel, uint index) {
  uint place = frame.tile_first + index;
  vec4 mean = mean_before(place);
  uint sample_index = frame.sample_begin;
  do {
    vec3 radiance = background_radiance(sample_ray(pixel, sample_index).dir);
    mean = add_to_mean(mean, radiance, 0.0f, sample_index);
    if (COUNTERS) count(COUNT_PRIMARY, 1u);
    sample_index += 1u;
  } while (sample_index < frame.sample_end);
  accumulation[place] = mean;
}

/// A pixel of the tile.
void miss_all(uvec2 in_tile) {
  uint index = in_tile.y * frame.tile_width + in_tile.x;
  if (STAGE == STAGE_AOV) {
    write_miss(index);
  } else {
    add_misses(in_tile + uvec2(frame.tile_x, frame.tile_y), index);
  }
}

#endif
