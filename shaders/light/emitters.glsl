// Light of splats that send out light, sampled on the splats themselves. Where discs overlap, a ray that hits a cluster of n
// belongs to each of them by the share 1 / n: the shares sum to 1, so that each disc can be sampled as if it lay alone and counts
// by its share. Needs what light_tree.glsl needs.
#ifndef SPLATRAY_EMITTERS_GLSL
#define SPLATRAY_EMITTERS_GLSL
#include "light/light_tree.glsl"
#include "light/sampling.glsl"
#include "trace/blend.glsl"

/// A point of a splat that sends out light, as seen from elsewhere.
struct EmitterSample {
  uvec4 words;
  vec3 dir;   ///< towards the point
  float pdf;  ///< of the direction, per solid angle, were the disc alone
};
EmitterSample emitter_sample(uint emitter, vec3 position, vec2 random) {
  EmitterSample chosen;
  chosen.words = emitter_words(emitter);
  float radius_squared = splat_radius_squared(chosen.words);
  vec3 normal = unit_normal(chosen.words);
  Basis basis = basis_of(normal);
  vec2 at = disc_sample(random) * sqrt(radius_squared);
  vec3 to_point = splat_center(chosen.words) + basis.u * at.x + basis.v * at.y - position;
  float distance_squared = max(dot(to_point, to_point), 1e-6f);
  chosen.dir = to_point * inversesqrt(distance_squared);
  chosen.pdf = distance_squared / (PI * radius_squared * max(abs(dot(normal, chosen.dir)), 1e-6f));
  return chosen;
}

/// About how often the direction of this ray, which left a surface, is chosen for light of this mean radiance that it meets on
/// splats, per solid angle: as often as its light is of all that arrives, were the choice perfect. Multiple importance sampling
/// is right with any such guess that both those who look for that light and those who meet it make.
float emitters_pdf(Receiver receiver, Ray ray, float radiance) {
  return radiance * abs(dot(receiver.normal, ray.dir)) / max(light_arriving(receiver), 1e-30f);
}

#endif
