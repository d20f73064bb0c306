/// The C++ side of shaders/scene/bindings.glsl, after shaders/lang/glsl_as_cpp.h in the same namespace. Hits are decided in
/// float64. LIT as there.
#define HOST

/// What the thread of the host works at. One word each, so that a library that is loaded late has room for them.
__attribute__((tls_model("initial-exec"))) thread_local const KernelWork* bound = nullptr;
__attribute__((tls_model("initial-exec"))) thread_local Counts* counted = nullptr;
__attribute__((tls_model("initial-exec"))) thread_local uint group_now = 0;
__attribute__((tls_model("initial-exec"))) thread_local uint lane_now = 0;

#define frame (bound->frame)
#define gl_LocalInvocationIndex lane_now

#define BLEND (bound->constants[SPEC_BLEND])
#define KERNEL (bound->constants[SPEC_KERNEL])
#define SIDE (bound->constants[SPEC_SIDE])
#define FACES (bound->constants[SPEC_FACES])
#define ORDER (bound->constants[SPEC_ORDER])
#define OUTPUT (bound->constants[SPEC_OUTPUT])
#define TOP_LEVELS (bound->constants[SPEC_TOP_LEVELS])

/// Whether the pipeline has a feature.
template <uint BIT>
struct Feature {
  operator bool() const {
    return (bound->constants[SPEC_FEATURES] & BIT) != 0U;
  }  // NOLINT: as a bool of GLSL
};
#define SPLATRAY_FEATURE(NAME, BIT) constexpr Feature<BIT> NAME;
#include "scene/features.glsl"
#ifdef LIT
#define LOOK (bound->constants[SPEC_LOOK])
#define TINTED (STRAIGHT && GLASS)
#define WATCHES EMISSION
#else
#define TINTED GLASS
#define PANES false
#define WATCHES false
#endif

/// An array as the shaders index it.
template <class Value, uint BINDING>
struct Bound {
  Value& operator[](uint index) const { return reinterpret_cast<Value*>(bound->bound[BINDING])[index]; }
};
constexpr Bound<vec4, BIND_ACCUMULATION> accumulation;
constexpr Bound<AovPixel, BIND_AOV> aov;
constexpr Bound<uint, BIND_GROUPS> group_list;
constexpr Bound<Material, BIND_MATERIALS> materials;
constexpr Bound<Light, BIND_LIGHTS> lights;
constexpr Bound<vec4, BIND_ENVIRONMENT> environment_texels;
#ifdef LIT
constexpr Bound<uint, BIND_LIGHT_TABLES> light_tables;
constexpr Bound<uvec4, BIND_LIGHT_TREE> light_tree;
#else
constexpr Bound<RayQuery, BIND_RAYS> rays;
constexpr Bound<RayHit, BIND_HITS> hits;
#endif

#define SPLATRAY_POOL(place, NAME, pool, Value, reader, ABOUT) \
  Value reader(uint index) { return Bound<Value, BIND_##NAME>()[index]; }
#include "pools.glsl"

float medium_at(uint bit) { return frame.media[bit >> 2U][static_cast<int>(bit & 3U)]; }
vec3 cut_eye() { return frame.cut_eye; }
vec4 region_plane(uint index) { return frame.region[index]; }
uint region_kept() { return frame.region_kept; }
uint region_dropped() { return frame.region_dropped; }
bool region_light() { return frame.region_light != 0U; }
vec3 absorption_at(uint bit) { return vec3(frame.absorption[bit]); }
uint splat_at(uint place) { return min(REFERENCES ? reference_word(place) : place, bound->last_splat); }
Material material_at(uint object) { return materials[min(object, bound->last_material)]; }
Light light_at(uint index) { return lights[index]; }
vec3 color_at(uint index) { return unpack_color(color_word(index)); }
#ifdef LIT
float albedo_at(uint index) { return uintBitsToFloat(light_tables[index]); }
uint sky_word(uint index) { return light_tables[ALBEDO_WORDS + index]; }
uvec4 light_texel(uint index) { return light_tree[index]; }
#endif

/// Bilinear; columns repeat, rows are clamped (engine/device/vulkan/texture.h).
vec3 environment_texel(vec2 position) {
  const int width = static_cast<int>(bound->environment_width);
  const int height = static_cast<int>(bound->environment_height);
  const vec2 at = position * vec2(width, height) - 0.5F;
  const vec2 corner = floor(at), share = at - corner;
  const int first = clamp(static_cast<int>(corner.x), -1, width - 1);  // whatever a direction is that is none
  const std::array<int, 2> columns{first < 0 ? width - 1 : first, first + 1 < width ? first + 1 : 0};
  const auto texel = [&](uint x, int y) {
    const int row = clamp(static_cast<int>(corner.y) + y, 0, height - 1);
    return vec3(environment_texels[static_cast<uint>(row * width + columns[x])]);
  };
  return mix(mix(texel(0, 0), texel(1, 0), share.x), mix(texel(0, 1), texel(1, 1), share.x), share.y);
}

void count(uint counter, uint amount) { (*counted)[counter] += amount; }

uint group_number() { return group_now; }

/// Has this thread of the host work at a group.
void begin_group(const KernelWork& work, uint group, Counts& counts) {
  bound = &work;
  counted = &counts;
  group_now = group;
}

/// Runs `thread` for each thread of a group.
template <class Thread>
void run_group(const KernelWork& work, uint group, Counts& counts, const Thread& thread) {
  begin_group(work, group, counts);
  for (lane_now = 0; lane_now < GROUP_SIZE; ++lane_now) thread();
}
