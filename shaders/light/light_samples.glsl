// Lights as a path's vertex looks for them, and as a ray meets them. Needs `frame`, light_at(index), and the constants LIGHTS,
// SKY, SIZES, ENVIRONMENT.
#ifndef SPLATRAY_LIGHT_SAMPLES_GLSL
#define SPLATRAY_LIGHT_SAMPLES_GLSL
#include "light/sampling.glsl"
#include "light/sky.glsl"
#include "primitive/disc.glsl"

const uint NO_LIGHT = 0xFFFFFFFFu;

/// Light that may come from one direction.
struct LightSample {
  vec3 dir;
  float distance;  ///< of its source
  vec3 radiance;   ///< over the probability of its choice
  float pdf;       ///< that probability, per solid angle; 0 of lights without a size
  uint light;      ///< index of its source, NO_LIGHT of the environment
};

/// What a light without a size sends to a point, or one with a size from one of its points.
LightSample one_light_sample(Light light, vec3 position, vec2 random) {
  LightSample chosen;
  bool directional = light.kind == LIGHT_DIRECTIONAL;
  vec3 to_light = directional ? light.position : light.position - position;
  float distance_squared = max(dot(to_light, to_light), 1.0f);
  chosen.distance = sqrt(distance_squared);
  chosen.dir = to_light * (1.0f / chosen.distance);
  chosen.radiance = light.power / (directional ? 1.0f : distance_squared);
  chosen.pdf = 0.0f;
  if (SIZES && light.size > 0.0f) {
    if (light.kind == LIGHT_RECTANGLE) {
      to_light += light.edge_u * (2.0f * random.x - 1.0f) + light.edge_v * (2.0f * random.y - 1.0f);
      vec3 across = cross(light.edge_u, light.edge_v);  // a quarter of the area long
      distance_squared = dot(to_light, to_light);
      chosen.distance = sqrt(distance_squared);
      chosen.dir = to_light * (1.0f / chosen.distance);
      float facing = -dot(chosen.dir, across);
      chosen.pdf = facing > 0.0f ? distance_squared / (4.0f * facing) : 0.0f;
      chosen.radiance = facing > 0.0f ? light.power / chosen.pdf : vec3(0.0f);
    } else {
      float sine = sin(light.size);
      float sine_squared = directional ? sine * sine : light.size * light.size / distance_squared;
      float height = cone_height(sine_squared);
      vec3 axis = chosen.dir;
      chosen.dir = cone_sample(axis, height, random);
      chosen.pdf = 1.0f / (TWO_PI * height);
      float area = directional ? PI * sine * sine : PI * light.size * light.size;
      chosen.radiance = light.power / (area * chosen.pdf);
      // Where the ray enters the ball; inside it, where it leaves.
      float along = dot(axis, chosen.dir) * chosen.distance;
      float root = sqrt(max(along * along - distance_squared + light.size * light.size, 0.0f));
      chosen.distance = sine_squared < 1.0f ? along - root : along + root;
    }
  }
  chosen.distance = directional ? INFINITY_F : chosen.distance;
  return chosen;
}

/// The light of the table whose part of [0, 1) holds `at`.
uint find_light(float at) {
  uint low = 0u;
  uint high = frame.light_end;
  do {
    uint middle = (low + high) >> 1u;
    bool above = light_at(middle).before > at;
    low = above ? low : middle;
    high = above ? middle : high;
  } while (high - low > 1u);
  return low;
}

/// Light of one light, or of the environment, at a point. The first number chooses which, and what is left of it is used again,
/// so that the samples of each are even, too.
LightSample light_sample(vec3 position, vec2 random) {
  LightSample chosen;
  if (SKY && (!LIGHTS || random.x < frame.sky_share)) {
    chosen.dir = sky_sample(vec2(min(random.x / frame.sky_share, 0.99999994f), random.y), chosen.pdf);
    chosen.pdf *= frame.sky_share;
    chosen.radiance = environment_radiance(chosen.dir) / chosen.pdf;
    chosen.distance = INFINITY_F;
    chosen.light = NO_LIGHT;
  } else {
    float at = SKY ? (random.x - frame.sky_share) / (1.0f - frame.sky_share) : random.x;
    uint index = find_light(at);
    Light light = light_at(index);
    vec2 within = vec2(clamp((at - light.before) / light.share, 0.0f, 0.99999994f), random.y);
    float share = light.share * (1.0f - frame.sky_share);
    chosen = one_light_sample(light, position, within);
    chosen.radiance /= share;
    chosen.pdf *= share;
    chosen.light = index;
  }
  return chosen;
}

/// The part of light that a ray met which counts, beside what vertices found by looking for it: the power heuristic (Veach 1997,
/// "Robust Monte Carlo Methods for Light Transport Simulation", sec. 9.2.4). `pdf` as Path has it.
float met_share(float pdf, float light_pdf) {
  if (pdf < 0.0f) return 0.0f;
  return pdf == 0.0f ? 1.0f : pdf * pdf / (pdf * pdf + light_pdf * light_pdf);
}

/// Where a ray meets a ball or rectangle of light: where it enters a ball or, from inside, leaves it. `pdf`: one_light_sample's
/// probability of the ray's direction.
struct LightMeeting {
  bool met;
  float t;
  float pdf;
};
LightMeeting meet_light(Light light, Ray ray) {
  LightMeeting meeting;
  vec3 to_light = light.position - ray.origin;
  if (light.kind == LIGHT_POINT) {
    float along = dot(to_light, ray.dir);
    vec3 beside = to_light - ray.dir * along;
    float inside_squared = light.size * light.size - dot(beside, beside);
    float root = sqrt(max(inside_squared, 0.0f));
    float sine_squared = light.size * light.size / max(dot(to_light, to_light), 1.0f);
    meeting.t = sine_squared < 1.0f ? along - root : along + root;
    meeting.met = inside_squared > 0.0f;
    meeting.pdf = 1.0f / (TWO_PI * cone_height(sine_squared));
  } else {
    vec3 across = cross(light.edge_u, light.edge_v);
    float facing = -dot(ray.dir, across);
    meeting.t = -dot(to_light, across) / facing;
    vec3 at = ray.dir * meeting.t - to_light;
    meeting.met = facing > 0.0f && abs(dot(at, light.edge_u)) < dot(light.edge_u, light.edge_u) &&
                  abs(dot(at, light.edge_v)) < dot(light.edge_v, light.edge_v);
    meeting.pdf = meeting.t * meeting.t / (4.0f * facing);
  }
  meeting.met = meeting.met && meeting.t > 0.0f && meeting.t < ray.t_max;
  return meeting;
}

/// Whether a ball or rectangle of light, other than the light with this index, is met by the ray: it hides what is behind it, as
/// paths find.
bool light_hides(Ray ray, uint but_for) {
  bool hides = false;
  uint index = 0u;
  do {
    Light light = light_at(index);
    if (light.kind != LIGHT_DIRECTIONAL && index != but_for) hides = hides || meet_light(light, ray).met;
    index += 1u;
  } while (index < frame.lights_sized);
  return hides;
}

/// Light of the lights with a size that the ray meets before t_max, which becomes where. Those at infinity come last in the
/// table, and count where nothing else is met. `pdf` as Path has it.
vec3 met_light(Ray ray, float pdf, INOUT(float) t_max) {
  vec3 light_met = vec3(0.0f);
  uint index = 0u;
  do {
    Light light = light_at(index);
    float share = light.share * (1.0f - frame.sky_share);
    if (light.kind == LIGHT_DIRECTIONAL) {
      float sine = sin(light.size);
      float height = cone_height(sine * sine);
      vec3 apart = ray.dir - light.position;
      bool met = t_max == INFINITY_F && 0.5f * dot(apart, apart) < height;
      light_met += met ? light.power / (PI * sine * sine) * met_share(pdf, share / (TWO_PI * height)) : vec3(0.0f);
    } else {
      ray.t_max = t_max;
      LightMeeting meeting = meet_light(light, ray);
      vec3 radiance = light.power;
      if (light.kind == LIGHT_POINT) radiance /= PI * light.size * light.size;
      light_met = meeting.met ? radiance * met_share(pdf, meeting.pdf * share) : light_met;
      t_max = meeting.met ? meeting.t : t_max;
    }
    index += 1u;
  } while (index < frame.lights_sized);
  return light_met;
}

#endif
