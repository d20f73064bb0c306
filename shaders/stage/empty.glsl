// In trace.glsl's place for pixels whose rays hit nothing (engine/image/footprint.h). A program of its own: drivers take as long
// to read one with the walk in it whether the walk is used or not.
#define SPLATRAY_TRACE_GLSL
#include "trace/answer.glsl"
#include "primitive/disc.glsl"

Hit trace_nearest(Ray ray, float kappa, INOUT(Tally) tally) {
  Hit hit;
  hit.found = false;
  hit.t = INFINITY_F;
  hit.position = vec3(0.0f);
  hit.normal = vec3(0.0f);
  hit.color = vec3(1.0f);
  hit.front = true;
  hit.object = NO_OBJECT;
  hit.members = 0u;
  hit.t_first = INFINITY_F;
  hit.first = uvec4(0u);
  return hit;
}

vec3 trace_shadow(Ray ray, INOUT(Tally) tally) { return vec3(1.0f); }
