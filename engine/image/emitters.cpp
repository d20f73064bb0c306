#include "engine/image/emitters.h"

#include <algorithm>
#include <numbers>

#include "engine/scene/splat.h"
#include "engine/scene/texture_factors.h"

namespace splatray {
namespace {

/// Two balls take the place of one where both together have less than this share of its surface.
constexpr double WORTHWHILE = 0.7;

/// A splat that sends out light.
struct Glow {
  glm::dvec3 center;
  double radius;
  double power;
};
using Glows = std::span<Glow>;

struct Part {
  Emitter ball;
  Glows glows;
};

Part part_of(Glows glows) {
  glm::dvec3 low = glows.front().center, high = low;
  for (const Glow& glow : glows) {
    low = glm::min(low, glow.center);
    high = glm::max(high, glow.center);
  }
  Emitter ball;
  ball.center = 0.5 * (low + high);
  for (const Glow& glow : glows) {
    ball.radius = std::max(ball.radius, glm::distance(ball.center, glow.center) + glow.radius);
    ball.power += glow.power;
  }
  return {ball, glows};
}

/// Its two halves, parted at the middle of its longest axis.
std::pair<Part, Part> halves(const Part& part) {
  glm::dvec3 low = part.glows.front().center, high = low;
  for (const Glow& glow : part.glows) {
    low = glm::min(low, glow.center);
    high = glm::max(high, glow.center);
  }
  const glm::dvec3 size = high - low;
  const int axis = size.x >= std::max(size.y, size.z) ? 0 : (size.y >= size.z ? 1 : 2);
  const auto middle = std::partition(part.glows.begin(), part.glows.end(), [&](const Glow& glow) {
    return glow.center[axis] <= 0.5 * (low[axis] + high[axis]);
  });
  const auto first = static_cast<std::size_t>(middle - part.glows.begin());
  return {part_of(part.glows.first(first)), part_of(part.glows.subspan(first))};
}

double surface(const Part& part) { return part.ball.radius * part.ball.radius; }

/// Whether a part lies in parts that are worth two balls; parts of these parts are looked at too, as a ring's halves save little.
bool divide(const Part& part, int depth, std::vector<Part>& parts) {
  const auto is_point = [&](const Glow& glow) { return glow.center == part.glows.front().center; };
  if (depth == 0 || std::all_of(part.glows.begin(), part.glows.end(), is_point)) return false;
  const auto [first, second] = halves(part);
  std::vector<Part> inner;
  for (const Part& half : {first, second})
    if (!divide(half, depth - 1, inner)) inner.push_back(half);
  double sum = 0.0;
  for (const Part& one : inner) sum += surface(one);
  if (sum > WORTHWHILE * surface(part)) return false;
  parts.insert(parts.end(), inner.begin(), inner.end());
  return true;
}

}  // namespace

vec3 shown_emission(const ObjectLooks& objects, std::size_t object) {
  const bool hidden = (objects.materials[object].flags & MATERIAL_HIDDEN) != 0;
  return hidden ? vec3(0.0F) : objects.surfaces[object].emission;
}

std::vector<Emitter> find_emitters(const Scene& scene, const ObjectLooks& objects) {
  std::vector<vec3> radiance(objects.materials.size());
  for (std::size_t i = 0; i < radiance.size(); ++i) radiance[i] = shown_emission(objects, i);
  if (std::all_of(radiance.begin(), radiance.end(), [](const vec3& one) { return one == vec3(0.0F); }))
    return {};
  const SplatEmission emission(scene);
  std::vector<Glow> glows;
  for (std::size_t i = 0; i < scene.data_pool.size(); ++i) {
    const Splat splat = unpack_splat(scene.data_pool[i]);
    const vec3 sent = emission.of(i, radiance[splat.object]);
    const double mean = double(sent.x + sent.y + sent.z) / 3.0;
    if (mean <= 0.0) continue;
    glows.push_back(
        {splat.center, std::sqrt(splat.radius_squared), std::numbers::pi * splat.radius_squared * mean});
  }
  if (glows.empty()) return {};
  std::vector<Part> parts;
  const Part whole = part_of(glows);
  // Four times in two: EMITTERS_MOST.
  if (!divide(whole, 4, parts)) parts.push_back(whole);
  std::vector<Emitter> emitters;
  for (const Part& part : parts) emitters.push_back(part.ball);
  return emitters;
}

}  // namespace splatray
