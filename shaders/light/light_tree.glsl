// The tree of all lights and of all splats that send out light: one is chosen about as often as its light arrives at a point
// (Conty Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting"). Needs `frame`,
// light_texel(index), material_at(object) and the constant GLASS.
#ifndef SPLATRAY_LIGHT_TREE_GLSL
#define SPLATRAY_LIGHT_TREE_GLSL
#include "primitive/disc.glsl"

const uint NO_NODE = 0xFFFFFFFFu;
/// Backs of splats that shine to both sides count this much: of closed objects none is seen.
const float BACK_SHARE = 0.2f;

LightNode light_node_at(uint index) {
  uvec4 ball = light_texel(LIGHT_NODE_TEXELS * index);
  uvec4 cone = light_texel(LIGHT_NODE_TEXELS * index + 1u);
  uvec4 rest = light_texel(LIGHT_NODE_TEXELS * index + 2u);
  LightNode node;
  node.center = vec3(uintBitsToFloat(ball.x), uintBitsToFloat(ball.y), uintBitsToFloat(ball.z));
  node.radius = uintBitsToFloat(ball.w);
  node.axis = vec3(uintBitsToFloat(cone.x), uintBitsToFloat(cone.y), uintBitsToFloat(cone.z));
  node.cos_axis = uintBitsToFloat(cone.w);
  node.power = uintBitsToFloat(rest.x);
  node.cos_edge = uintBitsToFloat(rest.y);
  node.skip = rest.z;
  node.content = rest.w;
  return node;
}

/// Where light arrives.
struct Receiver {
  vec3 position;
  vec3 normal;   ///< unit; light from behind does not count
  bool through;  ///< unless it is one that light goes through
};

Receiver receiver_at(vec3 position, vec3 normal, uint object) {
  Receiver receiver;
  receiver.position = position;
  receiver.normal = normal;
  receiver.through = false;
  if (GLASS) receiver.through = (material_at(object).flags & MATERIAL_DIELECTRIC) != 0u;
  return receiver;
}

/// That of the surface that a ray left.
Receiver receiver_left(Ray ray) {
  vec3 normal = dot(ray.dir, ray.from_normal) < 0.0f ? -ray.from_normal : ray.from_normal;
  return receiver_at(ray.origin, normal, ray.from_object);
}

/// The cosine of an angle less another, both in [0, pi] and given by cosine and sine; 1 where the other is larger.
float cosine_less(float cosine, float sine, float other_cosine, float other_sine) {
  return cosine >= other_cosine ? 1.0f : cosine * other_cosine + sine * other_sine;
}

/// Cosine of the least angle beside straight ahead at which any of a node's light leaves it towards a point beside its axis by
/// the angle with the cosine `ahead`, from which the node is as wide as the angle of `cosine` and `sine`; 0 where none does.
float cosine_leaving(LightNode node, float ahead, float cosine, float sine) {
  float sine_axis = sqrt(max(1.0f - node.cos_axis * node.cos_axis, 0.0f));
  float beside = cosine_less(ahead, sqrt(max(1.0f - ahead * ahead, 0.0f)), node.cos_axis, sine_axis);
  float leaving = cosine_less(beside, sqrt(max(1.0f - beside * beside, 0.0f)), cosine, sine);
  float mean = ahead * 0.5f * (1.0f + node.cos_axis);
  float spread = 0.25f * min(sine_axis * sine_axis + (node.cos_axis < 0.0f ? 1.0f : 0.0f) + sine * sine, 1.0f);
  float about = 0.5f * (mean + sqrt(mean * mean + spread));
  return leaving >= node.cos_edge ? min(max(leaving, 0.0f), about) : 0.0f;
}

/// Importance of a node: an upper bound, up to a constant, of the light it can send; 0 only where it can send none (ibid., sec. 4).
float node_importance(LightNode node, Receiver receiver) {
  bool distant = (node.content & LIGHT_NODE_DISTANT) != 0u;
  vec3 to_node = distant ? node.center : node.center - receiver.position;
  float distance_squared = max(dot(to_node, to_node), 1e-12f);
  float radius_squared = node.radius * node.radius;
  bool within = radius_squared >= distance_squared;
  vec3 dir = to_node * inversesqrt(distance_squared);
  float sine_squared = min(radius_squared / distance_squared, 1.0f);
  float sine = sqrt(sine_squared);
  float cosine = sqrt(1.0f - sine_squared);
  float facing = dot(receiver.normal, dir);
  facing = receiver.through ? abs(facing) : facing;
  float arriving = cosine_less(facing, sqrt(max(1.0f - facing * facing, 0.0f)), cosine, sine);
  float leaving = cosine_leaving(node, -dot(node.axis, dir), cosine, sine);
  if ((node.content & LIGHT_NODE_TWO_SIDED) != 0u)
    leaving = max(leaving, BACK_SHARE * cosine_leaving(node, dot(node.axis, dir), cosine, sine));
  arriving = within ? 1.0f : arriving;
  leaving = within || distant ? 1.0f : leaving;
  return node.power * max(arriving, 0.0f) * leaving / max(max(distance_squared, radius_squared), 1.0f);
}

/// How often a leaf is chosen for a receiver; with `leaf` NO_NODE one that `random` chooses, which is left in [0, 1) anew. The
/// leaf is NO_NODE where no light can arrive.
float light_share(Receiver receiver, INOUT(uint) leaf, INOUT(float) random) {
  uint node = 0u;
  float share = frame.light_nodes > 0u ? 1.0f : 0.0f;
  bool chooses = leaf == NO_NODE;
  bool inner = frame.light_nodes > 1u;
  while (inner) {
    LightNode first = light_node_at(node + 1u);
    LightNode second = light_node_at(first.skip);
    float importance = node_importance(first, receiver);
    float all = importance + node_importance(second, receiver);
    float share_first = all > 0.0f ? importance / all : 0.0f;
    bool takes_first = chooses ? random < share_first : leaf < first.skip;
    float share_taken = takes_first ? share_first : 1.0f - share_first;
    random = takes_first ? random / share_taken : (random - share_first) / share_taken;
    random = clamp(random, 0.0f, 0.99999994f);
    share *= all > 0.0f ? share_taken : 0.0f;
    node = takes_first ? node + 1u : first.skip;
    inner = ((takes_first ? first.content : second.content) & LIGHT_NODE_LEAF) == 0u && share > 0.0f;
  }
  if (chooses) leaf = share > 0.0f ? node : NO_NODE;
  return share;
}

/// The share of a leaf that is known.
float light_share_of(Receiver receiver, uint leaf) {
  float random = 0.5f;
  return light_share(receiver, leaf, random);
}

/// Words of a splat that sends out light.
uvec4 emitter_words(uint emitter) { return light_texel(LIGHT_NODE_TEXELS * frame.light_nodes + emitter); }

/// About the irradiance of all lights and splats in the tree, mean of rgb.
float light_arriving(Receiver receiver) {
  LightNode first = light_node_at(min(1u, frame.light_nodes - 1u));
  float arriving = node_importance(first, receiver);
  if (frame.light_nodes > 1u) arriving += node_importance(light_node_at(first.skip), receiver);
  return arriving;
}

#endif
