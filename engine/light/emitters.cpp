#include "engine/light/emitters.h"

#include <algorithm>
#include <tuple>

#include "engine/light/emitter_area.h"
#include "engine/scene/scene_splat.h"
#include "engine/scene/texture_factors.h"

namespace splatray {
namespace {

auto order(const uvec4& words) { return std::tuple(words.w, words.z, words.x, words.y); }

}  // namespace

Emitters find_emitters(const Scene& scene, const std::vector<Material>& materials) {
  std::vector<vec3> of_objects;
  for (const Material& material : materials) of_objects.push_back(shown_emission(material));
  if (std::all_of(of_objects.begin(), of_objects.end(), [](const vec3& one) { return one == vec3(0.0F); }))
    return {};
  const SplatEmission emission(scene);
  const auto radiance = [&](std::size_t index) {
    const vec3 sent = emission.of(index, of_objects[splat_at(scene, index).object()]);
    return (sent.x + sent.y + sent.z) / 3.0F;
  };
  std::vector<std::size_t> indices;  // in the data pool
  for (std::size_t i = 0; i < splat_count(scene); ++i)
    if (radiance(i) > 0.0F) indices.push_back(i);
  const auto words = [&scene](std::size_t index) { return splat_at(scene, index).words(); };
  std::sort(indices.begin(), indices.end(),
            [&](std::size_t a, std::size_t b) { return order(words(a)) < order(words(b)); });
  // Rays cannot distinguish splats of the same words: together they are one.
  const auto end = std::unique(indices.begin(), indices.end(),
                               [&](std::size_t a, std::size_t b) { return words(a) == words(b); });
  indices.erase(end, indices.end());
  if (indices.empty()) return {};
  std::vector<Splat> splats;
  std::vector<std::uint32_t> clips;
  for (const std::size_t index : indices) {
    splats.push_back(splat_at(scene, index).in_root());
    if (!scene.clip_pool.empty()) clips.push_back(scene.clip_pool[index]);
  }
  const std::vector<float> areas = areas_alone(splats, clips);
  std::vector<Emitter> emitters;
  for (std::size_t i = 0; i < splats.size(); ++i)
    emitters.push_back({words(indices[i]), areas[i] * radiance(indices[i])});
  return std::make_shared<const std::vector<Emitter>>(std::move(emitters));
}

double emitted_irradiance(const Scene& scene, const Emitters& emitters) {
  if (!emitters) return 0.0;
  const glm::dvec3 center = scene.root.to_root(0.5 * (scene.bounds_min_world + scene.bounds_max_world));
  const double size = glm::distance(scene.bounds_min_world, scene.bounds_max_world) / scene.root.unit_world;
  double sum = 0.0;
  for (const Emitter& emitter : *emitters) {
    const glm::dvec3 apart = emitter.splat().center - center;
    const double distance_squared = std::max(glm::dot(apart, apart), 0.01 * size * size);
    sum += 0.25 * double(emitter.power) / distance_squared;
  }
  return sum;
}

}  // namespace splatray
