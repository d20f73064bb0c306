// A path of light from the eye into the scene. LIT: by path tracing (transport.glsl), else phong.glsl.
#ifndef SPLATRAY_PATH_GLSL
#define SPLATRAY_PATH_GLSL
#include "primitive/disc.glsl"

/// A path, what it found and the rays it took.
struct Path {
  Ray ray;             ///< its next, while it is alive
  vec3 throughput;
  uint bounce;         ///< secondary rays behind it
  bool alive;
  vec3 radiance;
  float coverage;      ///< 1 when the primary ray hit something
  uint reflected;
  uint refracted;
  uint shadow;
  uint leaked;         ///< 1 when it left the scene while inside a dielectric
  uint cut;            ///< 1 when the bounce limit ended it
  float energy_lost;   ///< its throughput then
#ifdef LIT
  float pdf;           ///< of its direction, per solid angle; 0: nothing looked for lights before; < 0: lights met do not count
  uint below;          ///< directions chosen below the surface
  float energy_below;  ///< their throughput
  vec3 base;           ///< OUTPUT_BASE: base colour of what the primary ray met, 0..1; white of lights
#endif
};

Path path_start(Ray ray) {
  Path path;
  path.ray = ray;
  path.throughput = vec3(1.0f);
  path.bounce = 0u;
  path.alive = true;
  path.radiance = vec3(0.0f);
  path.coverage = 0.0f;
  path.reflected = 0u;
  path.refracted = 0u;
  path.shadow = 0u;
  path.leaked = 0u;
  path.cut = 0u;
  path.energy_lost = 0.0f;
#ifdef LIT
  path.pdf = 0.0f;
  path.below = 0u;
  path.energy_below = 0.0f;
  path.base = vec3(1.0f);
#endif
  return path;
}

#endif
