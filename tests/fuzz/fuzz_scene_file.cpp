// The target that reads scene files.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "engine/file/scene_file.h"
#include "engine/scene/leaf/slab_check.h"
#include "engine/scene/splat.h"
#include "tests/format/scene_bytes.h"
#include "tests/format/tiny_scene.h"
#include "tests/fuzz/memory_folder.h"
#include "tests/fuzz/require.h"
#include "tests/fuzz/targets.h"
#include "tests/trace/twin.h"

namespace splatray::testing {
namespace {

constexpr std::size_t ALIGNMENT = 16;
constexpr std::size_t SECTION_COUNT = (HEADER - TABLE) / ENTRY;
constexpr std::size_t COLUMN_TYPES = 248;  ///< offset in the header
constexpr std::size_t FIRST_COLUMN = SECTION_COUNT - COLUMNS_MOST;
constexpr std::uint32_t COLUMN_BYTES[] = {0, 1, 2, 4, 8};  ///< by type

FuzzBytes view_of(const Bytes& bytes) {
  return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
}

/// A good file, for what all files have in common.
const Bytes& good_file(const MemoryFolder& folder) {
  static const Bytes bytes = [&] {
    const std::filesystem::path path = folder.write("good.soct", {});
    write_scene(tiny_scene(), path);
    std::ifstream file(path, std::ios::binary);
    return Bytes(std::istreambuf_iterator<char>(file), {});
  }();
  return bytes;
}

/// Cuts a count of the header to what the bytes have room for. Returns it.
template <typename T>
std::size_t cut_count(Bytes& bytes, std::size_t offset, std::size_t element) {
  const T count = get<T>(bytes, offset) % static_cast<T>(bytes.size() / element + 1);
  put(bytes, offset, count);
  return count;
}

/// Cuts a word of flags to `mask`. Returns it.
std::uint32_t cut_flags(Bytes& bytes, std::size_t offset, std::uint32_t mask) {
  put(bytes, offset, get<std::uint32_t>(bytes, offset) & mask);
  return get<std::uint32_t>(bytes, offset);
}

/// The elements of each section, after the counts and flags have been cut.
std::vector<std::size_t> cut_counts(Bytes& bytes) {
  const std::size_t splats = cut_count<std::uint64_t>(bytes, 32, 16);
  const std::size_t references = cut_count<std::uint64_t>(bytes, 40, 4);
  const std::size_t nodes = cut_count<std::uint64_t>(bytes, 48, 4);
  const std::size_t leaves = cut_count<std::uint64_t>(bytes, 56, 4);
  const std::size_t objects = cut_count<std::uint32_t>(bytes, 64, 48);
  const std::size_t lights = cut_count<std::uint32_t>(bytes, 68, 48);
  const std::uint32_t attributes = cut_flags(bytes, 72, 7);
  const std::size_t cameras = cut_flags(bytes, 76, 1);
  const std::size_t strings = cut_count<std::uint64_t>(bytes, 80, 1);
  const std::size_t stations = cut_count<std::uint32_t>(bytes, 240, 40);
  const std::size_t surfaces = cut_count<std::uint32_t>(bytes, 244, 80);
  const std::size_t colors = (attributes & 1U) != 0 ? splats : 0;
  const std::size_t fields = (attributes & 2U) != 0 ? splats : 0;
  const std::size_t clips = (attributes & 4U) != 0 ? splats : 0;
  std::vector<std::size_t> counts{nodes, leaves + 1, leaves, references, splats,   colors,  fields,
                                  clips, objects,    lights, cameras,    stations, strings, surfaces};
  for (std::size_t i = 0; i < COLUMNS_MOST; ++i) {
    const auto type = get<std::uint8_t>(bytes, COLUMN_TYPES + i) % std::size(COLUMN_BYTES);
    put(bytes, COLUMN_TYPES + i, static_cast<std::uint8_t>(type));
    counts.push_back(type == 0 ? 0 : splats);
  }
  return counts;
}

/// The bytes with a scene file's form: magic, version, sizes, section table, gaps, end marker and checksums are put
/// right; counts are cut. All else stays, for the reader to judge. A good file stays what it is.
Bytes with_form(Bytes bytes, const Bytes& good) {
  bytes.resize(std::max(bytes.size(), HEADER));
  bytes.replace(0, 16, good, 0, 16);
  bytes.replace(TABLE - 8, 8, good, TABLE - 8, 8);
  const std::vector<std::size_t> counts = cut_counts(bytes);
  std::size_t end = HEADER;
  const auto pad = [&](std::size_t size) {
    const std::size_t aligned = (end + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    bytes.resize(std::max(bytes.size(), aligned + size));
    bytes.replace(end, aligned - end, aligned - end, '\0');
    return aligned;
  };
  for (std::size_t i = 0; i < SECTION_COUNT; ++i) {
    const std::size_t entry = TABLE + i * ENTRY;
    bytes.replace(entry, 8, good, entry, 8);
    if (i >= FIRST_COLUMN)
      put(bytes, entry + 4, COLUMN_BYTES[get<std::uint8_t>(bytes, COLUMN_TYPES + i - FIRST_COLUMN)]);
    const std::uint64_t size = counts.at(i) * get<std::uint32_t>(bytes, entry + 4);
    const std::uint64_t offset = pad(size);
    put<std::uint64_t>(bytes, entry + 8, offset);
    put<std::uint64_t>(bytes, entry + 16, size);
    end = offset + size;
  }
  const Bytes marker = good.substr(good.size() - 8);
  bytes.resize(pad(marker.size()));
  bytes += marker;
  put<std::uint64_t>(bytes, 16, bytes.size());
  reseal(bytes);
  return bytes;
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
  for (const Bytes& content : {as_is, with_form(as_is, good_file(folder))}) {
    const std::filesystem::path path = folder.write("fuzzed.soct", view_of(content));
    read_or_refuse([&] { check_scene(read_scene(path)); });
  }
}

}  // namespace splatray::testing
