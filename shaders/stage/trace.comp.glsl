#version 450
#extension GL_GOOGLE_include_directive : require
// A tile of an image: whole paths or, on CPU devices, a wavefront stage of one sample's; in STAGE_AOV what the ray through each
// pixel's centre hits.
#include "scene/bindings.glsl"
#include "stage/paths.glsl"

#ifndef LIT
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
#endif

void main() {
  read_frame();
  Work work;
  if (!find_work(work)) return;
#ifndef LIT
  if (STAGE == STAGE_AOV) {
    write_aov(work.pixel, work.place - frame.tile_first);
    return;
  }
#endif
  add_samples(work);
}
