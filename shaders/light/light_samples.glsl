// Lights as a path's vertex looks for them, and as a ray meets them. Needs `frame`, light_at(index), what emitters.glsl needs,
// and the constants LIGHTS, SKY, SIZES, ENVIRONMENT, EMISSION.
#ifndef SPLATRAY_LIGHT_SAMPLES_GLSL
#define SPLATRAY_LIGHT_SAMPLES_GLSL
#include "light/emitters.glsl"
#include "light/falloff.glsl"
#include "light/sky.glsl"

const uint NO_LIGHT = 0xFFFFFFFFu;

/// Light that may come from one direction.
struct LightSample {
  vec3 dir;
  float distance;  ///< of its source
  vec3 radiance;   ///< over the probability of its choice
  float pdf;       ///< that probability, per solid angle; 0 of lights without a size
  uint light;      ///< index of its source, NO_LIGHT of the environment and of splats
  uvec4 splat;     ///< words of one that sends out light; NO_SPLAT of other sources. Its radiance is that of what is hit
};

/// What a light without a size sends to a point, or one with a size from one of its points.
LightSample one_light_sample(Light light, vec3 position, vec2 random) {
  LightSample chosen;
  bool directional = light.kind == LIGHT_DIRECTIONAL;
  vec3 to_light = directional ? light.position : light.position - position;
  float distance_squared = max(dot(to_light, to_light), 1.0f);
  chosen.distance = sqrt(distance_squared);
  chosen.dir = to_light * (1.0f / chosen.distance);
  float falloff = light.kind == LIGHT_POINT ? light_falloff(light, chosen.dir, distance_squared) : 1.0f;
  chosen.radiance = light.power * (falloff / (directional ? 1.0f : distance_squared));
  chosen.pdf = 0.0f;
  chosen.splat = NO_SPLAT;
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
      chosen.radiance = light.power * (falloff / (area * chosen.pdf));
      // Where the ray enters the ball; inside it, where it leaves.
      float along = dot(axis, chosen.dir) * chosen.distance;
      float root = sqrt(max(along * along - distance_squared + light.size * light.size, 0.0f));
      chosen.distance = sine_squared < 1.0f ? along - root : along + root;
    }
  }
  chosen.distance = directional ? INFINITY_F : chosen.distance;
  return chosen;
}

/// Where no light can arrive.
LightSample no_light_sample(Receiver receiver) {
  LightSample none;
  none.dir = receiver.normal;
  none.distance = INFINITY_F;
  none.radiance = vec3(0.0f);
  none.pdf = 1.0f;
  none.light = NO_LIGHT;
  none.splat = NO_SPLAT;
  return none;
}

/// Light of one light, splat or of the environment at a point. The third number chooses which, and what is left of it is used
/// again, so that the samples of each are even, too.
LightSample light_sample(Receiver receiver, vec3 random) {
  LightSample chosen = no_light_sample(receiver);
  float choice = random.z;
  if (SKY && (frame.light_nodes == 0u || choice < frame.sky_share)) {
    vec2 at = vec2(0.0f);
    chosen.dir = sky_sample(vec2(random), at, chosen.pdf);
    chosen.pdf *= frame.sky_share;
    chosen.radiance = environment_at(at) / chosen.pdf;
    return chosen;
  }
  choice = SKY ? min((choice - frame.sky_share) / (1.0f - frame.sky_share), 0.99999994f) : choice;
  uint leaf = NO_NODE;
  float share = light_share(receiver, leaf, choice) * (1.0f - frame.sky_share);
  uint content = leaf != NO_NODE ? light_node_at(leaf).content : 0u;
  uint index = content & LIGHT_NODE_INDEX;
  bool found = (content & LIGHT_NODE_LEAF) != 0u;
  bool emitter = (content & LIGHT_NODE_EMITTER) != 0u;
  if (EMISSION && found && emitter) {
    EmitterSample point = emitter_sample(index, receiver.position, vec2(random));
    chosen.dir = point.dir;
    chosen.pdf = point.pdf * share;
    chosen.radiance = vec3(1.0f / chosen.pdf);
    chosen.splat = point.words;
  } else if (LIGHTS && found && !emitter) {
    chosen = one_light_sample(light_at(index), receiver.position, vec2(random));
    chosen.radiance /= share;
    chosen.pdf *= share;
    chosen.light = index;
  }
  return chosen;
}

/// The part of light that a ray met which counts, beside what vertices found by looking for it: the power heuristic (Veach 1997,
/// "Robust Monte Carlo Methods for Light Transport Simulation", sec. 9.2.4). `pdf` as Path has it.
float mis_weight(float pdf, float light_pdf) {
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

/// The node of the light tree that comes after this one, on the way past all lights with a size that a ray may meet, and whether
/// it is the leaf of one.
uint next_sized_node(uint at, Ray ray, OUT(uint) light) {
  LightNode node = light_node_at(at);
  vec3 to_center = node.center - ray.origin;
  vec3 beside = to_center - ray.dir * dot(to_center, ray.dir);
  bool may_meet = dot(beside, beside) <= node.radius * node.radius * 1.0001f;
  bool leaf = (node.content & LIGHT_NODE_LEAF) != 0u;
  light = may_meet && leaf ? node.content & LIGHT_NODE_INDEX : NO_LIGHT;
  return may_meet && !leaf ? at + 1u : node.skip;
}

/// Whether a ball or rectangle of light, other than the light with this index, is met by the ray: it hides what is behind it, as
/// paths find.
bool light_hides(Ray ray, uint but_for) {
  bool hides = false;
  uint node = frame.nodes_sized_begin;
  while (node < frame.nodes_sized_end && !hides) {
    uint light = NO_LIGHT;
    node = next_sized_node(node, ray, light);
    if (light != NO_LIGHT && light != but_for) hides = meet_light(light_at(light), ray).met;
  }
  return hides;
}

/// How often a ray that left a surface was looked for in the direction of a light with a size, of all times that light was.
float light_chosen(Ray ray, float pdf, Light light) {
  if (pdf <= 0.0f) return 0.0f;
  return light_share_of(receiver_left(ray), light.node) * (1.0f - frame.sky_share);
}

/// Light of the lights with a size that the ray meets before t_max, which becomes where. Those at infinity come last in the
/// table, and count where nothing else is met. `pdf` as Path has it.
vec3 met_light(Ray ray, float pdf, INOUT(float) t_max) {
  vec3 light_met = vec3(0.0f);
  uint nearest = NO_LIGHT;
  float nearest_pdf = 0.0f;
  ray.t_max = t_max;
  uint node = frame.nodes_sized_begin;
  while (node < frame.nodes_sized_end) {
    uint light = NO_LIGHT;
    node = next_sized_node(node, ray, light);
    if (light != NO_LIGHT) {
      LightMeeting meeting = meet_light(light_at(light), ray);
      nearest = meeting.met ? light : nearest;
      nearest_pdf = meeting.met ? meeting.pdf : nearest_pdf;
      ray.t_max = meeting.met ? meeting.t : ray.t_max;
    }
  }
  if (nearest != NO_LIGHT) {
    Light light = light_at(nearest);
    vec3 radiance = light.power;
    if (light.kind == LIGHT_POINT) {
      vec3 to_light = light.position - ray.origin;
      float distance_squared = max(dot(to_light, to_light), 1.0f);
      radiance *= light_falloff(light, to_light * inversesqrt(distance_squared), distance_squared) /
                  (PI * light.size * light.size);
    }
    light_met = radiance * mis_weight(pdf, nearest_pdf * light_chosen(ray, pdf, light));
  }
  uint index = frame.lights_met;
  while (index < frame.lights_sized && ray.t_max == INFINITY_F) {
    Light light = light_at(index);
    float sine = sin(light.size);
    float height = cone_height(sine * sine);
    vec3 apart = ray.dir - light.position;
    if (0.5f * dot(apart, apart) < height) {
      float share = mis_weight(pdf, light_chosen(ray, pdf, light) / (TWO_PI * height));
      light_met += light.power / (PI * sine * sine) * share;
    }
    index += 1u;
  }
  t_max = ray.t_max;
  return light_met;
}

#endif
