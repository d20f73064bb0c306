/// Everything that crosses the C++/GLSL border, defined once: splat and node words, tables, frame parameters, binding
/// and specialization-constant numbers. Compiled as GLSL (GL_GOOGLE_include_directive) and as C++20 (with GLM).
///
/// Root space. The octree's root cube is [0, 2^LATTICE_BITS)^3. Splat centres are integer points of that lattice and
/// all cell planes are integers, so both are exact in float32. world = root_origin_world + root * root_unit_world
/// (RootTransform, float64); axes are not rotated, so directions and normals are the same in both spaces.
///
/// Splat, 128 bits (one uvec4).
///   word.bits | meaning
///   0.31..11  | centre x, lattice units, 21 bits
///   0.10..0   | centre y, upper 11 of 21 bits
///   1.31..22  | centre y, lower 10 of 21 bits
///   1.20..0   | centre z, 21 bits (1.21 is zero)
///   2.15..0   | normal, octahedral u + 32767, u in [-32767, 32767] (Cigolle et al. 2014, "A Survey of Efficient
///   2.31..16  | normal, octahedral v + 32767  Representations for Independent Unit Vectors"; here without final scaling)
///   3.31..16  | squared radius in lattice units^2, bits 29..14 of its float32, rounded up (2^-9 relative
///             | steps); bit 30 is always set and bit 31 clear, as 2 <= r^2 < 2^65
///   3.15..0   | object index, also the index of its material
///
/// Normal field, 32 bits beside a splat, only in scenes that curve: how the unit normal changes across the disc, as the
/// symmetric matrix [[uu, uv], [uv, vv]] in the tangent frame of the splat's normal (Duff et al. 2017, "Building an
/// Orthonormal Basis, Revisited"): at the offset (u, v) from the centre the normal is n + [[uu, uv], [uv, vv]] (u, v) / r.
///   bits 9..0 uu, 19..10 uv, 29..20 vv; each q + 512, q in [-511, 511], value = sign(q) (q / 511)^2 / 2
/// A disc that lies in the large facet of a mesh that is shaded smoothly has a constant term instead: bit 31 is set, and
/// everywhere on it the normal is n + lean_u u + lean_v v.
///   bits 14..0 lean_u, 29..15 lean_v; each q + 16383, q in [-16383, 16383], value = q / 16383
///
/// Clip lines, 32 bits beside a splat, only in scenes whose surfaces end or have creases: up to two lines of its plane that the
/// disc ends at (Zwicker et al. 2004, "Perspective Accurate Splatting"), 16 bits each, bits 15..0 and 31..16. Exact integers: of
/// the normal n as stored, |x| + |y| + |z| = OCT_SCALE, let e be the axis along which it is least (x before y before z), and h
/// the least integer with r < 2^h that r^2's exponent allows. A point at the offset x from the centre stays where m.x <= limit
/// for both lines:
///   bits 7..0 direction d: m = a (e cross n) + b OCT_SCALE e, a = |128 - d| - 64, b = |128 - (d + 192 & 255)| - 64
///   bits 15..8 distance q: limit = (q - 127) 2^h OCT_SCALE / 2; 255 cuts nothing off
/// In place of the second line there may be an ellipse, where points lie in lines (EWA splatting: Zwicker et al. 2001, "Surface
/// Splatting"): q of bits 31..24 is then below 127, which no line's is there. With m of the direction in bits 22..16 and the
/// code f of bits 31..23, the squared distance of a point from the centre is x.x + k (m.x)^2 wherever a disc's is x.x: the disc
/// shrinks along m.
///   k = (8 + (f & 7)) 2^((f >> 3) - 45)
///
/// Texture words, up to four beside a splat, only in scenes with textures beside the base colour's: what its surface's values are
/// multiplied by, q / 255, of colours' channels (q / 255)^2. A splat has those whose FEATURE_TEXTURE_* there is, in this order:
///   LAYER  7..0 metallic, 15..8 roughness, 23..16 transmission, 31..24 opacity
///   GLOW   7..0 emission's red, 15..8 green, 23..16 blue, 31..24 specular
///   COLOR  7..0 specular colour's red, 15..8 green, 23..16 blue, 31..24 clearcoat
///   NORMAL 31..24 clearcoat roughness; a normal map's normal, octahedral: 11..0 u + 2047, 23..12 v + 2047; 23..0 all ones:
///          the splat's own
///
/// Slab, 32 bits per filled leaf: two parallel planes; all that the leaf's discs have inside its cell lies between them
/// (Kay and Kajiya 1986, "Ray Tracing Complex Scenes"). A point p of a cell with centre c and half size h is between them
/// if low h <= a.(p - c) <= (low + thickness) h, where a is the axis, |x| + |y| + |z| = 1, x >= 0.
///   bits 4..0 axis, octahedral u, in [0, 31], 10..5 v + 31, v in [-31, 31] (axis times 31, as a splat's normal);
///   18..11 low: q + 128, value = q / 128; 23..19 thickness: t, value = (1 + (t & 3) / 4) 2^(t >> 2) / 112
/// Halves. The plane through c across the coordinate axis along which a is least (x before y before z) divides the cell,
/// and the leaf's list: first come splats that are on its lower side alone, then those on both, then those on its upper
/// side alone. In units of n / 16 splats, rounded up, of a list of n:
///   27..24 the first l + 1 hold all that reach the lower half, 31..28 all but the first r those that reach the upper
///
/// Node word, 32 bits. Bits 31..30 tag, bits 29..0 address (Goradia et al. 2010, sec. III-A).
///   NODE_INNER  : address of the first of 8 children in the node pool; child = x + 2y + 4z (Z-order)
///   NODE_FILLED : index into Begin-End; the leaf's splats are those of reference_pool[begin_end[a] .. begin_end[a+1]), its
///                 slab is slab_pool[a]
///   NODE_EMPTY  : how far the empty space around the leaf's cell reaches: a box without filled leaves, wider than the cell by so
///                 many of the cell's sizes on each side: bits 1..0 -x, 3..2 +x, 5..4 -y, 7..6 +y, 9..8 -z, 11..10 +z; 29..12 zero
///
/// Reference, 32 bits: index of a splat in the data pool, and of its colour, normal field and clip lines. A device may hold
/// copies of the splats, leaf by leaf, in place of references (SPEC_REFERENCES).
///
/// Top table, 32 bits for each cell of TOP_LEVELS below the root, x fastest, made from the node pool: descents begin here.
/// The node word of the deepest node that holds the cell and lies no deeper than TOP_LEVELS; that of a leaf has in bits
/// 29..27 of its address how many levels below the root it lies.
#ifndef SPLATRAY_LAYOUT_H
#define SPLATRAY_LAYOUT_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/glm.hpp>
namespace splatray {
using glm::ivec3;
using glm::uint;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
#define SPLATRAY_CONST inline constexpr uint
#else
#define SPLATRAY_CONST const uint
#endif

SPLATRAY_CONST LATTICE_BITS = 21u;
/// Deepest leaf level: a cell is then 2^(LATTICE_BITS - MAX_DEPTH) = 8 lattice units wide, still wider than the
/// inflation of the conservative leaf lists (LIST_INFLATION).
SPLATRAY_CONST MAX_DEPTH = 18u;
/// Leaf lists hold every splat whose disc comes this close to the cell, lattice units (2^-19 of the root).
SPLATRAY_CONST LIST_INFLATION = 4u;
/// No disc comes closer to the root's faces than this, lattice units, so that all hits lie strictly inside the root.
SPLATRAY_CONST ROOT_MARGIN = 16u;

SPLATRAY_CONST TOP_LEVELS_MOST = 7u;         ///< a top table of 8 MiB
SPLATRAY_CONST TOP_LEAF_SHIFT = 27u;         ///< bits 29..27: a leaf's level
SPLATRAY_CONST TOP_LEAF_MASK = 0xC7FFFFFFu;  ///< the leaf's node word

SPLATRAY_CONST NODE_TAG_SHIFT = 30u;
SPLATRAY_CONST NODE_ADDRESS_MASK = 0x3FFFFFFFu;
SPLATRAY_CONST NODE_INNER = 0u;
SPLATRAY_CONST NODE_FILLED = 1u;
SPLATRAY_CONST NODE_EMPTY = 2u;
SPLATRAY_CONST EMPTY_STEPS_MOST = 3u;  ///< on each side of an empty leaf
SPLATRAY_CONST EMPTY_STEPS_MASK = 0xFFFu;

SPLATRAY_CONST OCT_SCALE = 32767u;        ///< octahedral normals: |u| + |v| + |w| = OCT_SCALE
SPLATRAY_CONST OBJECT_MASK = 0xFFFFu;     ///< word 3: object index
SPLATRAY_CONST FIELD_FLAT = 0x20080200u;  ///< the normal field of a flat disc
SPLATRAY_CONST FIELD_SCALE = 511u;        ///< largest |q| of a normal field
SPLATRAY_CONST FIELD_LEANS = 0x80000000u;  ///< the normal field is a constant term
SPLATRAY_CONST LEAN_SCALE = 16383u;        ///< largest |q| of one
SPLATRAY_CONST TEXTURE_NORMAL_SCALE = 2047u;  ///< normal maps' normals: |u| + |v| + |w| = TEXTURE_NORMAL_SCALE
SPLATRAY_CONST CLIP_NONE = 0xFF00FF00u;   ///< clip lines that cut nothing off
SPLATRAY_CONST CLIP_STEPS = 64u;          ///< directions of clip lines: |a| + |b| = CLIP_STEPS
SPLATRAY_CONST CLIP_ZERO = 127u;          ///< q of a line through the centre; of second lines none is below
/// A slab that holds the whole cell, and halves that hold the whole list.
SPLATRAY_CONST SLAB_FULL = 0x0FF803E0u;
SPLATRAY_CONST SLAB_AXIS_SCALE = 31u;  ///< slab axes: |u| + |v| + |w| = SLAB_AXIS_SCALE
SPLATRAY_CONST SLAB_SCALE = 128u;      ///< q of the cell's half size
SPLATRAY_CONST SLAB_THINNEST = 112u;   ///< thinnest slabs in a cell's half size
SPLATRAY_CONST SLAB_SHARES = 16u;      ///< the split of a leaf's list is stored in sixteenths

/// Material flags.
SPLATRAY_CONST MATERIAL_DIELECTRIC = 1u;  ///< refracts and reflects by Fresnel
SPLATRAY_CONST MATERIAL_TWO_SIDED = 2u;   ///< both faces are hit; the normal is turned to the ray
SPLATRAY_CONST MATERIAL_HIDDEN = 4u;      ///< the object is not hit at all

/// What LOOK_PAPER sees of an object in place of Material's numbers, but for `ior` (Goradia et al. 2010). Colours are linear, 0..1.
struct Phong {
  vec3 diffuse;     ///< diffuse reflectance; multiplied by the splat's colour where the scene has colours
  float specular;   ///< Phong specular reflectance, 0..1 (energy-normalised lobe)
  vec3 tint;        ///< mirror: reflectance; dielectric: transmittance of each crossing
  float shininess;  ///< Phong exponent, >= 1
  float mirror;     ///< share of light mirrored, 0..1; the rest is shaded
  float unused_0, unused_1, unused_2;  ///< zero
};

/// One per object; index = the splat's object index. glTF 2.0's metallic-roughness material with the extensions KHR_materials_ior,
/// _specular, _clearcoat, _transmission, _volume and _emissive_strength. Colours are linear, 0..1. Dielectrics
/// (MATERIAL_DIELECTRIC) transmit.
struct Material {
  /// Base colour, times the splat's colour where the scene has colours. Light that goes into a dielectric and out again is tinted
  /// by it once.
  vec3 base;
  float metallic;       ///< 0..1
  vec3 specular_color;  ///< factor on the reflectance of what is no metal, seen face on
  float roughness;      ///< perceptual: the square root of GGX's alpha, 0..1
  vec3 emission;        ///< radiance sent out, >= 0, whatever the splat's colour
  float specular;       ///< factor on all of the reflectance of what is no metal, 0..1
  vec3 absorption;      ///< of dielectrics, per world unit (on the device: lattice unit), >= 0
  float transmission;   ///< of dielectrics: share of light not mirrored that goes through, 0..1
  float coat;           ///< clearcoat, 0..1
  float coat_roughness;
  float layer_ior;  ///< index of refraction where nothing is transmitted, >= 1
  float ior;        ///< inside dielectrics, > 0; 1 in thin panes: rays pass unbent, layer_ior reflects
  uint flags;       ///< MATERIAL_*
  /// The object's bit, 0..31, in a ray's mask of the dielectrics it is inside of; where they overlap, light runs in the one with
  /// the highest bit.
  uint mask_bit;
  uint unused_0, unused_1;  ///< zero
  Phong phong;
};

SPLATRAY_CONST LIGHT_DIRECTIONAL = 0u;
SPLATRAY_CONST LIGHT_POINT = 1u;
SPLATRAY_CONST LIGHT_RECTANGLE = 2u;

/// Lights that have a size come first in their table, of them those at infinity last.
struct Light {
  vec3 position;  ///< root space; directional: unit vector towards the light
  uint kind;      ///< LIGHT_*
  vec3 power;     ///< irradiance, intensity (of lattice units) or, rectangle, radiance
  float size;     ///< point: radius, lattice units; directional: angular, radians; 0: none
  vec3 edge_u;    ///< rectangle: half its edges, perpendicular, lattice units; it shines towards cross(u, v)
  uint node;      ///< its leaf of the light tree
  vec3 edge_v;
  float range_scale;  ///< point: 1 / range^4 of KHR_lights_punctual, lattice units; 0: no end
  vec3 spot_axis;     ///< point: unit vector in which a spot shines
  float spot_scale;   ///< 1 / (cosine of its inner angle - cosine of its outer); 0: in all directions
  float spot_cosine;  ///< of its outer angle
  uint unused_0, unused_1, unused_2;
};

/// A node of the light tree (engine/light/light_tree.h), depth first: an inner node's first child follows it, its second is the
/// one that the first's `skip` leads to. Three texels.
struct LightNode {
  vec3 center;   ///< of a ball that holds all below it, lattice units; distant: unit vector into the middle of all of them
  float radius;  ///< distant: sine of the angle about that which holds them, 1 and more: no bound
  vec3 axis;     ///< unit axis of a cone that holds the directions in which they shine straight ahead
  float cos_axis;  ///< cosine of its angle
  float power;     ///< radiance times area, intensity or, distant, irradiance of all below it; mean of rgb
  float cos_edge;  ///< cosine of how far from straight ahead any of them shines
  uint skip;       ///< the node behind all below this one
  uint content;    ///< LIGHT_NODE_*; of leaves the index of a light, or of an emitter, in bits 27..0
};
SPLATRAY_CONST LIGHT_NODE_TEXELS = 3u;
SPLATRAY_CONST LIGHT_NODE_LEAF = 0x80000000u;
SPLATRAY_CONST LIGHT_NODE_EMITTER = 0x40000000u;    ///< of leaves: a splat, else a light
SPLATRAY_CONST LIGHT_NODE_TWO_SIDED = 0x20000000u;  ///< something below it shines to both sides
SPLATRAY_CONST LIGHT_NODE_DISTANT = 0x10000000u;    ///< all below it are at infinity
SPLATRAY_CONST LIGHT_NODE_INDEX = 0x0FFFFFFFu;

/// Half-spaces whose intersection a region keeps, at most; a box has six.
SPLATRAY_CONST REGION_PLANES_MOST = 16u;
SPLATRAY_CONST REGION_BOX_PLANES = 6u;

/// Parameters of a dispatch; std140: every vec3 is followed by a scalar. Root space unless said.
struct FrameParams {
  vec3 origin_00;  ///< primary ray through pixel position (0, 0) (top left corner): point on the ray
  uint width;      ///< image size, pixels
  vec3 origin_dx;  ///< change of that point per pixel to the right
  uint height;
  vec3 origin_dy;  ///< ... per pixel down
  uint tile_x;     ///< first pixel of this dispatch
  vec3 dir_00;     ///< primary ray direction through (0, 0), not normalised
  uint tile_y;
  vec3 dir_dx;
  uint tile_width;  ///< pixels of this dispatch
  vec3 dir_dy;
  uint tile_height;
  float depth_offset;     ///< root units: distance eye - ray point where it does not depend on the pixel
  float depth_per_dir;    ///< distance eye - ray point in units of |dir| (1: the point is on a far plane)
  float t_min;            ///< where primary rays start, relative to the ray point, root units; may be -inf
  float root_unit_world;  ///< world length of one lattice unit
  uint sample_begin;      ///< samples of this dispatch: [sample_begin, sample_end)
  uint sample_end;
  uint mean_begin;  ///< the sample that the running mean of these begins with
  uint seed;
  uint max_bounces;     ///< secondary rays in a path, >= 0
  uint light_end;       ///< lights of this dispatch: [light_begin, light_end)
  float kappa;          ///< window depth in units of the first splat's radius
  float delta;          ///< SIDE_DELTA: least distance between a secondary ray's origin and a hit, root units
  vec3 environment;     ///< radiance factor of the texture, or the constant radiance
  uint tile_first;      ///< where accumulation and AOVs hold this dispatch's first pixel
  vec3 environment_up;  ///< unit vector the environment's +y (its pole) points to
  uint light_begin;     ///< from 1 on `environment` and `irradiance` are zero: another dispatch added them
  vec3 environment_right;  ///< unit vector the environment's +x points to; its +z is cross(right, up)
  uint group_count;        ///< groups of pixels of this dispatch
  vec4 irradiance[9];  ///< environment's irradiance / pi in 9 spherical harmonics of the environment's frame
                       ///< (Ramamoorthi, Hanrahan 2001), rgb
  vec4 media[8];       ///< index of refraction inside each bit of a ray's mask, 4 bits in each
  vec3 background;  ///< what primary rays that meet nothing see; x < 0: the environment
  float clamp;      ///< LOOK_LIT: most that light after the first bounce adds to a channel; 0: any
  // The rest is for LOOK_LIT and its like.
  vec3 lens_u;  ///< half axes of the lens, root units
  float focus;  ///< distance of the sharp plane from the eye, root units
  vec3 lens_v;
  float reach;        ///< LOOK_AO, LOOK_SCAN: how far away something darkens a point, root units
  uint lights_sized;  ///< lights that have a size
  uint sky_width;     ///< cells of the sky table (engine/scene/sky/sky_table.h)
  uint sky_height;
  float sky_share;  ///< how often a path's vertex chooses the environment, 0..1; else a light
  vec3 cut_eye;     ///< FACES_CUT: splats that face away from here are left out
  uint light_nodes;        ///< of the light tree; 0: there is none
  uint emitters;           ///< splats that send out light
  uint nodes_sized_begin;  ///< where the light tree has the lights that have a size and are not at infinity
  uint nodes_sized_end;
  uint lights_met;         ///< how many of the lights that have a size are not at infinity
  vec4 absorption[32];  ///< per lattice unit, inside each bit of a ray's mask
  uint region_kept;     ///< FEATURE_REGION: planes on whose inner side a ray meets splats
  uint region_dropped;  ///< planes on whose inner sides, all of them together, it meets none
  uint region_light;    ///< whether secondary rays, too, meet only what the region keeps
  uint loop_probe;      ///< LOOP_PROBE
  /// A panorama's turns of longitude and half turns of latitude per pixel, its axes ahead, to the right and down being dir_00, dir_dx
  /// and dir_dy; 0 where the rays are those of a plane.
  vec4 panorama;
  /// Planes n.x >= w, n a unit vector, root space: those kept, then those dropped.
  vec4 region[REGION_PLANES_MOST + REGION_BOX_PLANES];
};
SPLATRAY_CONST FUSED_ROWS = REGION_PLANES_MOST + REGION_BOX_PLANES;  ///< fused.comp.glsl: products in `region`

/// One ray of a query (rays.comp.glsl). Root space; the hits are those of exactly this ray.
struct RayQuery {
  vec3 origin;
  float t_min;       ///< hits need t > t_min
  vec3 dir;          ///< unit, to float32 rounding; t is in units of |dir|
  uint inside;       ///< mask of the dielectrics the ray is inside of
  vec3 from_normal;  ///< secondary rays: blended normal of the sheet left; else zero
  uint from_object;  ///< secondary rays: object left, NO_OBJECT for primary rays
  float t_max;       ///< hits need t < t_max; 0: a ray without end
  uint unused_0, unused_1, unused_2;
};

/// The answer. Misses have t = +inf, object = NO_OBJECT.
struct RayHit {
  vec3 normal;    ///< blended unit normal, turned against the ray
  float t;        ///< blended
  uvec4 first;    ///< the first splat (t0, i0), its four words
  float t_first;  ///< t0
  uint object;
  uint members;  ///< splats in the cluster
  uint color;    ///< blended colour, 8 bits a channel, square-root encoded, r lowest; 0 without colours
};
SPLATRAY_CONST NO_OBJECT = 0xFFFFFFFFu;

/// Per-pixel auxiliary outputs, of the ray through the pixel's centre.
struct AovPixel {
  vec3 normal;  ///< blended unit normal, world space; 0 on a miss
  float z;      ///< distance from the eye, world units; +inf on a miss
  uint object;  ///< NO_OBJECT on a miss
  /// Bit 0: the first splat's front face was hit; bits 31..1 distinguish splats (a hash of its words).
  uint splat;
  uint tests;  ///< splat tests of this ray; 0 without COUNTERS
  uint steps;  ///< node words read by this ray; 0 without COUNTERS
};

/// Counters, compiled in by COUNTERS only.
SPLATRAY_CONST COUNT_PRIMARY = 0u;
SPLATRAY_CONST COUNT_SHADOW = 1u;
SPLATRAY_CONST COUNT_REFLECTED = 2u;
SPLATRAY_CONST COUNT_REFRACTED = 3u;
SPLATRAY_CONST COUNT_LEAVES = 4u;         ///< leaves visited
SPLATRAY_CONST COUNT_NODE_STEPS = 5u;     ///< node words read
SPLATRAY_CONST COUNT_TESTS = 6u;          ///< splat tests
SPLATRAY_CONST COUNT_HITS = 7u;           ///< rays that hit
SPLATRAY_CONST COUNT_LOST = 8u;           ///< rays stopped after MAX_LEAVES leaves
SPLATRAY_CONST COUNT_LEAKED = 9u;         ///< rays that left the scene while inside a dielectric
SPLATRAY_CONST COUNT_NON_FINITE = 10u;    ///< samples with a non-finite colour
SPLATRAY_CONST COUNT_BOUNCE_LIMIT = 11u;  ///< paths cut by the bounce limit
SPLATRAY_CONST COUNT_ENERGY_LOST = 12u;   ///< sum of their throughput, in units of 1/1024
SPLATRAY_CONST COUNT_BELOW = 13u;         ///< directions chosen below the surface: light lost
SPLATRAY_CONST COUNT_BELOW_ENERGY = 14u;  ///< sum of their paths' throughput, in units of 1/1024
SPLATRAY_CONST COUNTER_COUNT = 15u;

/// Descriptor bindings (set 0).
SPLATRAY_CONST BIND_FRAME = 0u;
SPLATRAY_CONST BIND_MATERIALS = 1u;
SPLATRAY_CONST BIND_LIGHTS = 2u;
SPLATRAY_CONST BIND_ENVIRONMENT = 3u;
SPLATRAY_CONST BIND_ACCUMULATION = 4u;
SPLATRAY_CONST BIND_AOV = 5u;
SPLATRAY_CONST BIND_COUNTERS = 6u;
SPLATRAY_CONST BIND_RAYS = 7u;
SPLATRAY_CONST BIND_HITS = 8u;
SPLATRAY_CONST BIND_GROUPS = 9u;  ///< group list: 32 bits a group of pixels, column | row << 16 in the tile
SPLATRAY_CONST BIND_LIGHT_TABLES = 10u;  ///< words: the albedo table, then the sky table
SPLATRAY_CONST BIND_LIGHT_TREE = 11u;    ///< texels: the light tree, then the words of the splats that send out light
SPLATRAY_CONST BIND_POOLS = 12u;         ///< the first of the pools (pools.glsl), which come last

/// How many pools there are.
#define SPLATRAY_POOL(place, NAME, pool, Value, reader, ABOUT) +1u
SPLATRAY_CONST POOLS = 0u
#include "pools.glsl"
    ;
/// BIND_NODE_POOL and so on, and the FEATURE_* of those that a scene may be without.
#define SPLATRAY_POOL(place, NAME, pool, Value, reader, ABOUT) SPLATRAY_CONST BIND_##NAME = BIND_POOLS + place;
#define SPLATRAY_OPTIONAL_POOL(place, NAME, pool, Value, reader, HAS, bit, ABOUT) \
  SPLATRAY_CONST BIND_##NAME = BIND_POOLS + place; \
  SPLATRAY_CONST FEATURE_##HAS = bit;
#include "pools.glsl"

/// Specialization constants of a pipeline. What is off costs nothing.
SPLATRAY_CONST SPEC_FEATURES = 0u;    ///< sum of FEATURE_*
SPLATRAY_CONST SPEC_BLEND = 1u;       ///< BLEND_*
SPLATRAY_CONST SPEC_KERNEL = 2u;      ///< KERNEL_*
SPLATRAY_CONST SPEC_SIDE = 3u;        ///< SIDE_*
SPLATRAY_CONST SPEC_FACES = 4u;       ///< FACES_*
SPLATRAY_CONST SPEC_ORDER = 5u;       ///< ORDER_*
SPLATRAY_CONST SPEC_OUTPUT = 6u;      ///< OUTPUT_*
SPLATRAY_CONST SPEC_TOP_LEVELS = 7u;  ///< levels of the top table: it has 8^TOP_LEVELS entries
SPLATRAY_CONST SPEC_PAGE_SHIFT = 8u;  ///< a buffer of a pool that has several holds 2^PAGE_SHIFT elements
SPLATRAY_CONST SPEC_LOOK = 9u;        ///< LOOK_*
SPLATRAY_CONST SPEC_PAGES = 10u;      ///< and on: buffers of each pool less one, by its place
SPLATRAY_CONST SPEC_COUNT = SPEC_PAGES + POOLS;

/// What a scene and the settings need, one bit each; beside these the pools that some splat needs (pools.glsl).
SPLATRAY_CONST FEATURE_MIRRORS = 1u;        ///< some material mirrors
SPLATRAY_CONST FEATURE_GLASS = 2u;          ///< some material is a dielectric
SPLATRAY_CONST FEATURE_REFERENCES = 16u;    ///< the data pool is read through references
SPLATRAY_CONST FEATURE_LIGHTS = 32u;        ///< there are lights, and a material that scatters their light
SPLATRAY_CONST FEATURE_SHADOWS = 64u;       ///< shadow rays
SPLATRAY_CONST FEATURE_ENVIRONMENT = 128u;  ///< the environment is a texture, else constant
SPLATRAY_CONST FEATURE_COUNTERS = 256u;     ///< counters
SPLATRAY_CONST FEATURE_ELLIPSES = 524288u; ///< some splat is an ellipse
SPLATRAY_CONST FEATURE_LEANS = 33554432u;  ///< some normal field is a constant term
SPLATRAY_CONST FEATURE_REGION = 67108864u;  ///< rays meet only what a region keeps (trace/region.glsl)
SPLATRAY_CONST FEATURE_FUSED = 134217728u;  ///< fma() rounds once (stage/fused.comp.glsl)
SPLATRAY_CONST FEATURE_OPACITY = 16777216u;  ///< some splat is see-through, and has the texture word LAYER
SPLATRAY_CONST FEATURE_TEXTURE_LAYER = 1048576u;  ///< splats have this texture word
SPLATRAY_CONST FEATURE_TEXTURE_GLOW = 2097152u;
SPLATRAY_CONST FEATURE_TEXTURE_COLOR = 4194304u;
SPLATRAY_CONST FEATURE_TEXTURE_NORMAL = 8388608u;
// For LOOK_LIT and its like alone:
SPLATRAY_CONST FEATURE_SKY = 512u;          ///< the environment is chosen among the lights, by the sky table
SPLATRAY_CONST FEATURE_SIZES = 1024u;       ///< some light has a size, and can be met
SPLATRAY_CONST FEATURE_DIFFUSE = 2048u;     ///< some material scatters diffusely
SPLATRAY_CONST FEATURE_SPECULAR = 4096u;    ///< some material that is no metal has highlights
SPLATRAY_CONST FEATURE_METAL = 8192u;       ///< some material is a metal
SPLATRAY_CONST FEATURE_COAT = 16384u;       ///< some material has a clearcoat
SPLATRAY_CONST FEATURE_EMISSION = 32768u;   ///< some material sends out light
SPLATRAY_CONST FEATURE_LENS = 65536u;       ///< the lens has a size
SPLATRAY_CONST FEATURE_PANES = 268435456u;  ///< light of lights passes panes as paths do, some material is one
SPLATRAY_CONST FEATURE_STRAIGHT = 131072u;  ///< light of lights passes dielectrics unbent, tinted

SPLATRAY_CONST LOOK_PAPER = 0u;  ///< Phong, hard shadows, mirrors and glass (Goradia et al. 2010)
SPLATRAY_CONST LOOK_LIT = 1u;    ///< path tracing
SPLATRAY_CONST LOOK_CLAY = 2u;   ///< the same, everything diffuse and of albedo 0.8
SPLATRAY_CONST LOOK_AO = 3u;  ///< ambient occlusion: the share of the sky, by cosine, that nothing near hides
SPLATRAY_CONST LOOK_SCAN = 4u;  ///< the points' colours under ambient occlusion and the lights
SPLATRAY_CONST LOOK_BASE = 5u;  ///< base colours without light, for the denoiser
/// The same through the pixels' centres, darker where they face away, with the distance from the eye, world units, in place of
/// coverage: for pictures of what moves
SPLATRAY_CONST LOOK_SEEN = 6u;

SPLATRAY_CONST PAGES_MOST = 8u;  ///< of a pool: buffers one behind the other, where one cannot be as large

SPLATRAY_CONST OUTPUT_PICTURE = 0u;  ///< the mean of paths
SPLATRAY_CONST OUTPUT_AOV = 1u;      ///< no paths: AovPixel of the ray through each pixel's centre
SPLATRAY_CONST OUTPUT_BASE = 2u;  ///< the mean of paths, behind it that of their base colours: LOOK_LIT and its like

/// Iterations of a loop that shows whether a driver cuts loops short (stage/paths.glsl).
SPLATRAY_CONST LOOP_PROBE = 8u;

/// Most lights of a scene.
SPLATRAY_CONST LIGHTS_MOST = 4096u;
/// Most of them that have a size.
SPLATRAY_CONST LIGHTS_SIZED_MOST = 256u;

SPLATRAY_CONST BLEND_WINDOW = 0u;   ///< all splats behind the first within a window (trace/blend.glsl)
SPLATRAY_CONST BLEND_PAPER = 1u;    ///< Goradia et al. 2010, sec. IV-C1
SPLATRAY_CONST BLEND_NEAREST = 2u;  ///< first splat only
SPLATRAY_CONST BLEND_LEAF = 3u;  ///< first leaf only: the wrong blending of Goradia et al. 2010, Fig. 7 (a)
SPLATRAY_CONST BLEND_COUNT = 4u;  ///< of ray queries alone: no cluster, members = all splats that the ray hits
SPLATRAY_CONST BLEND_ANY = 5u;    ///< of ray queries alone: no cluster, and any splat that the ray hits in place of the first
SPLATRAY_CONST KERNEL_RIM = 0u;  ///< (1 - u^2)^2, zero at the rim
SPLATRAY_CONST KERNEL_GAUSSIAN = 1u;  ///< exp(-2 u^2)
SPLATRAY_CONST SIDE_SIDE = 0u;        ///< expected side per object and own-sheet exclusion
SPLATRAY_CONST SIDE_DELTA = 1u;       ///< minimum distance delta (Linsen et al. 2007), no sides
SPLATRAY_CONST SIDE_NONE = 2u;        ///< neither: the failures of Goradia et al. 2010, Fig. 9 and 10
SPLATRAY_CONST FACES_BOTH = 0u;       ///< every object is two-sided
SPLATRAY_CONST FACES_FRONT = 1u;      ///< every object is one-sided and none is a dielectric
SPLATRAY_CONST FACES_MIXED = 2u;
SPLATRAY_CONST FACES_OPAQUE = 3u;     ///< FACES_MIXED where dielectrics are shown as opaque: two-sided, too
SPLATRAY_CONST FACES_CUT = 4u;        ///< FACES_BOTH without the splats that face away from the eye, for all rays
SPLATRAY_CONST ORDER_Z = 0u;       ///< pixels of a group in Z-order (Goradia et al. 2010, sec. IV-A)
SPLATRAY_CONST ORDER_LINEAR = 1u;  ///< pixels of a group in a row
SPLATRAY_CONST GROUP_SIZE = 64u;   ///< threads in a group; ORDER_Z: 8 x 8 pixels

#ifdef __cplusplus
static_assert(sizeof(Material) == 144 && sizeof(Light) == 96 &&
              sizeof(LightNode) == 16 * LIGHT_NODE_TEXELS &&
              sizeof(RayQuery) == 64 && sizeof(RayHit) == 48 && sizeof(AovPixel) == 32 &&
              sizeof(FrameParams) == 1456);
}  // namespace splatray
#endif
#endif
