// A splat's 128 bits, and a ray's hit on its disc: first a float32 test that never loses a hit, then the
// exact decision.
#ifndef SPLATRAY_DISC_GLSL
#define SPLATRAY_DISC_GLSL
#include "lang/double_float.glsl"
#include "layout.h"
#include "lang/hit_numbers.h"

/// Cosine of a ray that leaves a sheet level, counted as upwards: normals that the ray grazes are made square to it, and
/// rounding shall not decide.
const float LEVEL = -0.000244140625f;

/// A ray in root space. Its exact origin is origin + origin_low (a double-float per axis).
struct Ray {
  vec3 origin;
  vec3 origin_low;
  vec3 dir;
  float t_min;        ///< hits need t > t_min
  float t_max;        ///< and t < t_max
  uint inside;        ///< mask of the dielectrics the ray is inside of
  bool to_light;      ///< PANES: looks for light, and so meets panes from both sides
  vec3 from_normal;   ///< secondary rays: blended normal of the sheet left, on the side its splats' normals point to
  uint from_object;   ///< secondary rays: object left; NO_OBJECT for primary rays
  bool bounded;       ///< REGION: meets only what the region keeps
  float t_drop_in;    ///< REGION: meets nothing with t from here
  float t_drop_out;   ///< to here
};

/// Centre, lattice units; exact.
vec3 splat_center(uvec4 words) {
  uint y = ((words.x & 0x7FFu) << 10u) | (words.y >> 22u);
  return vec3(float(words.x >> 11u), float(y), float(words.y & 0x1FFFFFu));
}

/// The direction of octahedral coordinates, |x| + |y| + |z| = scale; exact where all are integers.
vec3 octahedral(float x, float y, float scale) {
  float z = scale - abs(x) - abs(y);
  float fold = max(-z, 0.0f);
  return vec3(x >= 0.0f ? x - fold : x + fold, y >= 0.0f ? y - fold : y + fold, z);
}

/// Normal, |x| + |y| + |z| = OCT_SCALE; integers, exact.
vec3 splat_normal(uvec4 words) {
  return octahedral(float(words.z & 0xFFFFu) - float(OCT_SCALE), float(words.z >> 16u) - float(OCT_SCALE), float(OCT_SCALE));
}

/// The normal as it is stored, of length 1 to float32.
vec3 unit_normal(uvec4 words) {
  vec3 normal = splat_normal(words);
  return normal * inversesqrt(dot(normal, normal));
}

/// Squared radius, lattice units^2.
float splat_radius_squared(uvec4 words) { return uintBitsToFloat(((words.w & 0xFFFF0000u) >> 2u) | 0x40000000u); }

uint splat_object(uvec4 words) { return words.w & OBJECT_MASK; }

/// Total order of different splats that a ray meets at the same t: any fixed order of the words will do.
bool words_less(uvec4 a, uvec4 b) {
  if (a.w != b.w) return a.w < b.w;
  if (a.z != b.z) return a.z < b.z;
  if (a.x != b.x) return a.x < b.x;
  return a.y < b.y;
}

/// False only if the ray surely has no hit on the disc with t in [t_in, t_out): the plane's and the rim's
/// distance are widened by their float32 error, which grows as 1 / |n.d|. NaN (a ray in the disc's plane)
/// counts as maybe.
bool splat_maybe_hit(uvec4 words, vec3 origin, vec3 dir, float t_in, float t_out) {
  vec3 to_center = splat_center(words) - origin;
  vec3 normal = splat_normal(words);
  float inverse = 1.0f / dot(normal, dir);
  float t = dot(normal, to_center) * inverse;
  float slack = (PLANE_ERROR * float(OCT_SCALE)) * abs(inverse);
  vec3 from_center = dir * t - to_center;
  float outside = dot(from_center, from_center) - splat_radius_squared(words) * 1.03125f;
  return !(outside > 33.0f * slack * slack) && !(t + slack < t_in) && !(t - slack >= t_out);
}

/// A ray's meeting with a disc's plane, in double-float. HOST: computed in float64, at which processors are fast.
struct PlaneHit {
  vec2 t;             ///< ray parameter
  vec2 rho_squared;   ///< squared distance from the centre, lattice units^2
  vec3 from_center;   ///< rounded to float32 from more
  vec3 from_center_low;  ///< what that left out
  float facing;       ///< n.d: negative = front face
};

#ifdef HOST
vec2 two_floats(double x) {
  float high = float(x);
  return vec2(high, float(x - double(high)));
}

/// As below, by float64: to about 2^-50.
PlaneHit splat_plane_hit(uvec4 words, vec3 origin, vec3 origin_low, vec3 dir) {
  PRECISE dvec3 to_center = (dvec3(splat_center(words)) - dvec3(origin)) - dvec3(origin_low);
  dvec3 n = dvec3(splat_normal(words));
  PRECISE double denominator = dot(n, dvec3(dir));
  PRECISE double t = dot(n, to_center) / denominator;
  PRECISE dvec3 from_center = dvec3(dir) * t - to_center;
  PRECISE double rho_squared = dot(from_center, from_center);
  PlaneHit hit;
  hit.t = two_floats(t);
  hit.rho_squared = two_floats(rho_squared);
  hit.from_center = vec3(from_center);
  hit.from_center_low = vec3(from_center - dvec3(hit.from_center));
  hit.facing = float(denominator);
  return hit;
}
#else
/// t = n.(c - o) / (n.d) and |o + t d - c|^2 to about 2^-44 of the distances involved.
PlaneHit splat_plane_hit(uvec4 words, vec3 origin, vec3 origin_low, vec3 dir) {
  vec3 center = splat_center(words);
  vec3 n = splat_normal(words);
  vec2 x = two_sum(center.x, -origin.x);
  vec2 y = two_sum(center.y, -origin.y);
  vec2 z = two_sum(center.z, -origin.z);
  x = quick_two_sum(x.x, x.y - origin_low.x);
  y = quick_two_sum(y.x, y.y - origin_low.y);
  z = quick_two_sum(z.x, z.y - origin_low.z);
  vec2 numerator = df_add(df_add(df_scale(x, n.x), df_scale(y, n.y)), df_scale(z, n.z));
  vec2 denominator =
      df_add(df_add(two_product(n.x, dir.x), two_product(n.y, dir.y)), two_product(n.z, dir.z));
  PlaneHit hit;
  hit.t = df_divide(numerator, denominator);
  vec2 from_x = df_add(df_scale(hit.t, dir.x), -x);
  vec2 from_y = df_add(df_scale(hit.t, dir.y), -y);
  vec2 from_z = df_add(df_scale(hit.t, dir.z), -z);
  hit.rho_squared = df_add(df_add(df_square(from_x), df_square(from_y)), df_square(from_z));
  hit.from_center = vec3(from_x.x, from_y.x, from_z.x);
  hit.from_center_low = vec3(from_x.y, from_y.y, from_z.y);
  hit.facing = denominator.x;
  return hit;
}
#endif

/// A clip line's normal, in the disc's plane or leaning to one side; integers, exact.
vec3 clip_normal(uint line, vec3 normal) {
  float a = abs(128.0f - float(line & 255u)) - float(CLIP_STEPS);
  float b = (abs(128.0f - float((line + 192u) & 255u)) - float(CLIP_STEPS)) * float(OCT_SCALE);
  vec3 size = abs(normal);
  bool is_x = size.x <= size.y && size.x <= size.z;
  bool is_y = size.y <= size.z;
  if (is_x) return vec3(b, -a * normal.z, a * normal.y);
  return is_y ? vec3(a * normal.z, b, -a * normal.x) : vec3(-a * normal.y, a * normal.x, b);
}

/// What a clip line lets the product of clip_normal and an offset from the centre be.
float clip_limit(uint line, uvec4 words) {
  float bound = uintBitsToFloat((127u + ((3u + (words.w >> 25u)) >> 1u)) << 23u);
  return (float((line >> 8u) & 255u) - float(CLIP_ZERO)) * (0.5f * float(OCT_SCALE)) * bound;
}

/// The product of a clip line's normal and a meeting's offset from the centre: two floats, on the host a double.
#ifdef HOST
double along_clip(uint line, uvec4 words, PlaneHit hit) {
  vec3 across = clip_normal(line, splat_normal(words));
  PRECISE double along = dot(dvec3(across), dvec3(hit.from_center) + dvec3(hit.from_center_low));
  return along;
}
#else
vec2 along_clip(uint line, uvec4 words, PlaneHit hit) {
  vec3 across = clip_normal(line, splat_normal(words));
  vec2 x = df_scale(vec2(hit.from_center.x, hit.from_center_low.x), across.x);
  vec2 y = df_scale(vec2(hit.from_center.y, hit.from_center_low.y), across.y);
  vec2 z = df_scale(vec2(hit.from_center.z, hit.from_center_low.z), across.z);
  return df_add(df_add(x, y), z);
}
#endif

/// Whether a meeting with the disc's plane is on the clip line's inner side.
bool line_keeps(uint line, uvec4 words, PlaneHit hit) {
#ifdef HOST
  return along_clip(line, words, hit) <= double(clip_limit(line, words));
#else
  return !df_less(vec2(clip_limit(line, words), 0.0f), along_clip(line, words, hit));
#endif
}

/// Whether a splat's clip word has an ellipse in place of the second line; only where some splat of the scene has.
bool is_ellipse(uint clip) { return (clip >> 24u) < CLIP_ZERO; }

/// A meeting with the plane of a splat that may be an ellipse: its squared distance is what an ellipse takes it for (layout.h).
PlaneHit ellipse_hit(uint clip, uvec4 words, PlaneHit hit) {
  uint code = clip >> 23u;
  float factor = float(8u + (code & 7u)) * uintBitsToFloat((82u + (code >> 3u)) << 23u);
  uint direction = (clip >> 16u) & 0x7Fu;
#ifdef HOST
  PRECISE double along = along_clip(direction, words, hit);
  PRECISE double squared = double(hit.rho_squared.x) + double(hit.rho_squared.y) + double(factor) * (along * along);
  vec2 rho_squared = two_floats(squared);
#else
  vec2 rho_squared = df_add(df_scale(df_square(along_clip(direction, words, hit)), factor), hit.rho_squared);
#endif
  hit.rho_squared = is_ellipse(clip) ? rho_squared : hit.rho_squared;
  return hit;
}

/// One entry of a normal field, per radius.
float field_slope(uint bits) {
  float q = (float(bits & 0x3FFu) - 512.0f) * (1.0f / float(FIELD_SCALE));
  return 0.5f * q * abs(q);
}

/// One component of a constant term.
float field_lean(uint bits) { return (float(bits & 0x7FFFu) - float(LEAN_SCALE)) * (1.0f / float(LEAN_SCALE)); }

/// What a disc's normal field makes of a meeting with the disc's plane.
struct FieldPoint {
  vec3 normal;     ///< longer than 1; may point away from the ray
  float height;    ///< of the curved surface over the disc's plane, along the disc's normal, lattice units
};

/// The field's normal, and the height of the surface it belongs to, at an offset on the disc (layout.h). `normal` is the
/// disc's unit normal; `leans`: whether words may be constant terms.
FieldPoint field_point(uint word, bool leans, vec3 normal, vec3 from_center, float inverse_radius) {
  float side = normal.z >= 0.0f ? 1.0f : -1.0f;
  float a = -1.0f / (side + normal.z);
  vec3 u = vec3(1.0f + side * normal.x * normal.x * a, side * normal.x * normal.y * a, -side * normal.x);
  vec3 v = vec3(normal.x * normal.y * a, side + normal.y * normal.y * a, -normal.y);
  vec2 offset = vec2(dot(from_center, u), dot(from_center, v));
  float uv = field_slope(word >> 10u);
  vec2 lean = vec2(field_slope(word) * offset.x + uv * offset.y, uv * offset.x + field_slope(word >> 20u) * offset.y);
  lean *= inverse_radius;
  bool constant = leans && word >= FIELD_LEANS;
  if (constant) lean = vec2(field_lean(word), field_lean(word >> 15u));
  FieldPoint point;
  point.normal = normal + u * lean.x + v * lean.y;
  point.height = constant ? 0.0f : -0.5f * (lean.x * offset.x + lean.y * offset.y);
  return point;
}

/// Own-sheet exclusion: whether the disc belongs to the sheet that a secondary ray has
/// just left, i.e. same object, like normal, and either the ray's origin within the disc's thin slab and near
/// its rim, or the ray coming from behind it nearby: from below another layer of a noisy sheet. On a
/// two-sided object the slab takes normals either way round.
bool splat_of_sheet_left(uvec4 words, Ray ray, bool two_sided) {
  vec3 to_center = splat_center(words) - ray.origin;
  vec3 normal = splat_normal(words);
  float radius_squared = splat_radius_squared(words);
  float normal_squared = dot(normal, normal);
  float distance_squared = dot(to_center, to_center);
  float height = dot(normal, to_center);
  float like = dot(normal, ray.from_normal);
  bool in_slab = 4.0f * height * height < normal_squared * radius_squared && distance_squared < 1.5625f * radius_squared;
  bool leaves_upwards = dot(ray.from_normal, ray.dir) > LEVEL;
  bool from_behind = like > 0.0f && (dot(normal, ray.dir) > 0.0f) == leaves_upwards &&
                     distance_squared < 16.0f * radius_squared;
  bool similar = 4.0f * like * like > normal_squared && (two_sided || like > 0.0f);
  return splat_object(words) == ray.from_object && similar && (in_slab || from_behind);
}

#endif
