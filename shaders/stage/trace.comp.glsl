#version 450
#extension GL_GOOGLE_include_directive : require
// A tile of an image: whole paths or, on CPU devices, a wavefront stage of one sample's; in STAGE_AOV what the ray through each
// pixel's centre hits.
#include "scene/bindings.glsl"
#include "stage/paths.glsl"

/// A number that tells splats apart.
uint hash_words(uvec4 words) {
  return hash_uint(words.x ^ hash_uint(words.y ^ hash_uint(words.z ^ hash_uint(words.w))));
}

void write_aov(uvec2 pixel, uint index) {
  Tally tally = Tally(0u, 0u, 0u, 0u);
  float eye_distance = 0.0f;
  Ray ray = center_ray(pixel, eye_distance);
  Hit hit = trace_nearest(ray, frame.kappa, tally);
  aov[index].normal = hit.found ? hit.normal : vec3(0.0f);
  aov[index].z = hit.found ? (hit.t + eye_distance) * frame.root_unit_world : INFINITY_F;
  aov[index].object = hit.object;
  aov[index].splat = (hash_words(hit.first) & ~1u) | (hit.front ? 1u : 0u);
  aov[index].tests = tally.tests;
  aov[index].steps = tally.node_steps;
}

void main() {
  read_frame();
#ifdef CPU
  if (STAGE == STAGE_NEXT) {
    uint queued = group_number() * GROUP_SIZE + gl_LocalInvocationIndex;
    if (queued < frame.path_count) follow_queued(queued);
    return;
  }
#endif
  uvec2 in_tile = uvec2(0u);
  if (!find_pixel(in_tile)) return;
  uvec2 pixel = in_tile + uvec2(frame.tile_x, frame.tile_y);
  uint index = in_tile.y * frame.tile_width + in_tile.x;
  if (STAGE == STAGE_AOV) {
    write_aov(pixel, index);
  } else {
    add_samples(pixel, index);
  }
}
