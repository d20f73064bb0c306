// Directions towards objects that send out light, in which paths may go on beside those that surfaces choose: such light is found
// where a ray arrives, so that no splat of an object need be chosen, nor overlapping ones distinguished. Needs `frame` and
// light_at(index).
#ifndef SPLATRAY_GUIDE_GLSL
#define SPLATRAY_GUIDE_GLSL
#include "light/sampling.glsl"

/// How often a path goes on towards light, of those times at which its surface scatters; else as the surface chooses. One in two
/// costs at most twice the variance where there is nothing to find (Veach 1997, "Robust Monte Carlo Methods for Light Transport
/// Simulation", sec. 9.2.3).
const float GUIDED = 0.5f;

/// A ball with light in it, seen from a point.
struct GuideBall {
  vec3 axis;     ///< unit vector to its centre
  float height;  ///< cone_height of it
  float power;   ///< about what arrives of its light
};
GuideBall guide_ball(uint index, vec3 position) {
  Light light = light_at(frame.light_end + index);
  vec3 to_centre = light.position - position;
  float distance_squared = max(dot(to_centre, to_centre), 1e-6f);
  GuideBall ball;
  ball.axis = to_centre * inversesqrt(distance_squared);
  ball.height = cone_height(light.size * light.size / distance_squared);
  ball.power = light.share / max(distance_squared, light.size * light.size);
  return ball;
}

/// A direction into one of the balls. `choice` chooses which, in one pass: each takes the place of those before as often as it
/// should.
vec3 guide_sample(vec3 position, float choice, vec2 random) {
  GuideBall chosen = guide_ball(0u, position);
  float all = chosen.power;
  uint index = 1u;
  while (index < frame.emitters) {
    GuideBall ball = guide_ball(index, position);
    all += ball.power;
    float share = ball.power / all;
    bool taken = choice < share;
    choice = taken ? choice / share : (choice - share) / (1.0f - share);
    if (taken) chosen = ball;
    index += 1u;
  }
  return cone_sample(chosen.axis, chosen.height, vec2(random.x * 0.9999f, random.y));
}

/// The probability of a direction, per solid angle.
float guide_pdf(vec3 position, vec3 dir) {
  float sum = 0.0f;
  float all = 0.0f;
  uint index = 0u;
  do {
    GuideBall ball = guide_ball(index, position);
    vec3 apart = dir - ball.axis;
    all += ball.power;
    sum += 0.5f * dot(apart, apart) <= ball.height ? ball.power / (TWO_PI * ball.height) : 0.0f;
    index += 1u;
  } while (index < frame.emitters);
  return sum / all;
}

#endif
