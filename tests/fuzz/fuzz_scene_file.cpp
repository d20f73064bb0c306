// The target that reads scene files.
#include <algorithm>
#include <cmath>

#include "engine/file/scene_file.h"
#include "engine/scene/leaf/slab_check.h"
#include "engine/scene/splat.h"
#include "tests/fuzz/memory_folder.h"
#include "tests/fuzz/require.h"
#include "tests/fuzz/scene_form.h"
#include "tests/fuzz/targets.h"
#include "tests/trace/twin.h"

namespace splatray::testing {
namespace {

FuzzBytes view_of(const Bytes& bytes) {
  return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
}

/// Rays that enter the root from three sides and start inside it; the twin throws where an index leaves its pool.
void send_rays(const Scene& scene) {
  const auto edge = static_cast<float>(1U << LATTICE_BITS);
  std::vector<RayQuery> rays;
  for (const vec3 dir : {vec3(1.0F, 0.0F, 0.0F), vec3(0.6F, -0.64F, 0.48F), vec3(-0.36F, 0.48F, 0.8F)}) {
    for (const float back : {0.0F, edge}) {
      RayQuery ray{};
      ray.dir = dir;
      ray.origin = vec3(0.5F * edge) - back * dir;
      ray.from_object = NO_OBJECT;
      rays.push_back(ray);
    }
  }
  for (const RayHit& hit : twin_intersect(scene, rays, {}))
    require(hit.object == NO_OBJECT || hit.object < scene.materials.size(), "hits are of existing objects");
}

void check_scene(const Scene& scene) {
  require(scene.data_pool.size() <= scene.reference_pool.size(), "a reference per splat");
  for (const uvec4& words : scene.data_pool) {
    const Splat splat = unpack_splat(words);
    require(std::isfinite(splat.radius_squared) && splat.radius_squared > 0.0, "radii are finite");
    require(std::abs(glm::length(splat.normal) - 1.0) < 1e-6, "normals are unit vectors");
    require(splat.object < scene.materials.size(), "splats are of existing objects");
  }
  (void)find_slab_defect(scene);
  send_rays(scene);
}

}  // namespace

void fuzz_scene_file(FuzzBytes bytes) {
  static const MemoryFolder folder;
  const Bytes as_is(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  static const Bytes good = golden_bytes(15), good_old = golden_bytes(10);
  for (const Bytes& content : {as_is, with_form(as_is, good), with_old_form(as_is, good_old)}) {
    const std::filesystem::path path = folder.write("fuzzed.soct", view_of(content));
    read_or_refuse([&] { check_scene(read_scene(path)); });
  }
}

}  // namespace splatray::testing
