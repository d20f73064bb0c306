/// shaders/light/bsdf.glsl for plain surfaces (WideVertices), for the CPU that this file is compiled for; after wide_sky.h and wide_numbers.h. The
/// same but for rounding.
#include "shaders/lang/albedo_layout.h"

namespace splatray {
namespace {

constexpr float INVERSE_PI = 0.31830989F;

Lanes material_number(const WideLight& light, Ints object, std::size_t offset) {
  constexpr auto STRIDE = static_cast<std::int32_t>(sizeof(Material) / sizeof(float));
  const auto* numbers =
      reinterpret_cast<const float*>(reinterpret_cast<const char*>(light.materials) + offset);
  return hn::GatherIndex(TAG, numbers, object * ints(STRIDE));
}

Lanes schlick(Lanes cosine) {
  const Lanes x = clamp(of(1.0F) - cosine, 0.0F, 1.0F), squared = x * x;
  return squared * squared * x;
}

Lanes mean_of(const Vectors& color) { return (color.x + color.y + color.z) * of(1.0F / 3.0F); }

/// A place in the rows or columns of the albedo table: the entry before it, and how far on towards the next.
struct TablePlace {
  Ints entry;
  Lanes on;
};

TablePlace table_place(Lanes at, std::uint32_t entries) {
  const auto last = static_cast<float>(entries - 1);
  const Lanes x = clamp(at * of(last), 0.0F, last - 1e-3F), whole = hn::Floor(x);
  return {hn::ConvertTo(INT_TAG, whole), x - whole};
}

/// The layers of surfaces, as roughness says.
struct Roughness {
  Lanes alpha;
  Lanes log_width;  ///< log(1 + 1 / width) of albedo_place
  TablePlace row;
};

Roughness roughness_of(Lanes alpha) {
  const Lanes width = hn::Max(alpha, of(1e-3F));
  return {alpha, logarithm(of(1.0F) + of(1.0F) / width), table_place(hn::Sqrt(alpha), ALBEDO_ROWS)};
}

/// The factors of f0 and f90.
struct Factors {
  Lanes f0, f90;
};

Lanes table_number(const WideLight& light, Ints index, std::uint32_t offset) {
  return hn::GatherIndex(TAG, light.albedo + offset, index);
}

/// albedo_factors.
Factors factors_at(const WideLight& light, const Roughness& rough, Lanes cosine) {
  const Lanes width = hn::Max(rough.alpha, of(1e-3F));
  const TablePlace column =
      table_place(logarithm(of(1.0F) + cosine / width) / rough.log_width, ALBEDO_COLUMNS);
  const Ints entry = rough.row.entry * ints(ALBEDO_COLUMNS) + column.entry, index = entry + entry;
  const auto between = [&](std::uint32_t which) {
    const auto in_row = [&](std::uint32_t row) {
      const Lanes low = table_number(light, index, row + which),
                  high = table_number(light, index, row + which + 2);
      return low + (high - low) * column.on;
    };
    const Lanes low = in_row(0), high = in_row(2 * ALBEDO_COLUMNS);
    return low + (high - low) * rough.row.on;
  };
  const Lanes sum = between(0);
  const Lanes high = hn::Min(positive(schlick(cosine) * sum + between(1)), sum);
  return {sum - high, high};
}

/// albedo_means.
Factors means_of(const WideLight& light, const Roughness& rough) {
  const auto mean = [&](std::uint32_t which) {
    const Ints index = rough.row.entry + rough.row.entry;
    const Lanes low = table_number(light, index, ALBEDO_MEANS + which),
                high = table_number(light, index, ALBEDO_MEANS + which + 2);
    return low + (high - low) * rough.row.on;
  };
  return {mean(0), mean(1)};
}

/// Bsdf, as it is seen from a direction of its own frame.
struct Surfaces {
  Vectors to_eye;
  Vectors base, diffuse;
  Vectors f0, mirrored;
  Lanes f90;
  Lanes layer_chosen;
  Roughness rough;
  Lanes bound;  ///< ggx_bound
};

/// ggx_bound.
Lanes bound_of(const Vectors& to_eye, Lanes alpha) {
  const Lanes reach = of(1.0F) + hn::Sqrt(to_eye.x * to_eye.x + to_eye.y * to_eye.y);
  const Lanes alpha_squared = alpha * alpha, reach_squared = reach * reach;
  return (of(1.0F) - alpha_squared) * reach_squared / (reach_squared + alpha_squared * to_eye.z * to_eye.z);
}

/// bsdf_of and bsdf_seen.
Surfaces surfaces_at(const WideLight& light, const WideVertices& vertices, std::uint32_t from,
                     const Vectors& to_eye) {
  Surfaces surfaces;
  surfaces.to_eye = to_eye;
  surfaces.base = surfaces.diffuse = load(vertices.base, from);
  surfaces.layer_chosen = of(0.0F);
  if (!light.layered) return surfaces;
  const Ints object = hn::BitCast(INT_TAG, load(vertices.object, from));
  const auto field = [&](std::size_t offset) { return material_number(light, object, offset); };
  const Lanes roughness = field(offsetof(Material, roughness)), ior = field(offsetof(Material, layer_ior));
  const Lanes facing = (ior - of(1.0F)) / (ior + of(1.0F));
  const std::size_t color = offsetof(Material, specular_color);
  surfaces.f90 = field(offsetof(Material, specular));
  surfaces.f0 = Vectors{field(color), field(color + sizeof(float)), field(color + 2 * sizeof(float))} *
                (facing * facing * surfaces.f90);
  surfaces.f0 = {hn::Min(surfaces.f0.x, of(1.0F)), hn::Min(surfaces.f0.y, of(1.0F)),
                 hn::Min(surfaces.f0.z, of(1.0F))};
  surfaces.rough = roughness_of(roughness * roughness);
  surfaces.bound = bound_of(to_eye, surfaces.rough.alpha);
  const Factors factors = factors_at(light, surfaces.rough, to_eye.z),
                means = means_of(light, surfaces.rough);
  surfaces.mirrored = surfaces.f0 * factors.f0 + all(surfaces.f90 * factors.f90);
  const Vectors rest = all(of(1.0F)) - (surfaces.f0 * means.f0 + all(surfaces.f90 * means.f90));
  const Vectors passes{hn::Max(rest.x, of(1e-4F)), hn::Max(rest.y, of(1e-4F)), hn::Max(rest.z, of(1e-4F))};
  surfaces.diffuse = surfaces.base * ((all(of(1.0F)) - surfaces.mirrored) / passes);
  const Lanes scattered = mean_of(surfaces.diffuse * passes), mirrored = mean_of(surfaces.mirrored);
  surfaces.layer_chosen = hn::IfThenElseZero(mirrored > of(0.0F), mirrored / (mirrored + scattered));
  return surfaces;
}

/// What a surface sends on of light from one direction, times its cosine, and how often that direction is chosen.
struct SurfaceValue {
  Vectors value;
  Lanes pdf;
};

/// The layer's part of bsdf_value.
void add_layer(const Surfaces& surfaces, const Vectors& to_light, Lanes cosine, SurfaceValue& sum) {
  const Vectors& to_eye = surfaces.to_eye;
  const Vectors between = to_eye + to_light;
  const Vectors half_way = between * inverse_sqrt(hn::Max(dot(between, between), of(1e-30F)));
  const Lanes alpha = surfaces.rough.alpha, alpha_squared = alpha * alpha;
  const Lanes tangent =
      (half_way.x * half_way.x + half_way.y * half_way.y) / alpha_squared + half_way.z * half_way.z;
  const Lanes density = of(1.0F) / (of(3.14159265F) * alpha_squared * tangent * tangent);
  const auto stretch = [&](Lanes c) { return hn::Sqrt(alpha_squared + (of(1.0F) - alpha_squared) * c * c); };
  const Lanes visible = of(0.5F) / (cosine * stretch(to_eye.z) + to_eye.z * stretch(cosine));
  const Lanes flat = alpha_squared * (to_eye.x * to_eye.x + to_eye.y * to_eye.y);
  const Lanes seen = of(2.0F) * (surfaces.bound * to_eye.z + hn::Sqrt(flat + to_eye.z * to_eye.z));
  const Vectors reflectance =
      surfaces.f0 + (all(surfaces.f90) - surfaces.f0) * schlick(dot(to_light, half_way));
  const LaneMask above = to_light.z > of(0.0F);
  sum.value = sum.value + where(above, reflectance * (density * visible * cosine), all(of(0.0F)));
  sum.pdf = sum.pdf + hn::IfThenElseZero(above, surfaces.layer_chosen * (density / seen));
}

/// bsdf_value.
SurfaceValue value_at(const WideLight& light, const Surfaces& surfaces, const Vectors& to_light) {
  const Lanes cosine = positive(to_light.z), diffuse = cosine * of(INVERSE_PI);
  SurfaceValue sum{surfaces.diffuse, diffuse};
  if (light.layered) {
    const Factors factors = factors_at(light, surfaces.rough, cosine);
    sum.value = sum.value * (all(of(1.0F)) - surfaces.f0 * factors.f0 - all(surfaces.f90 * factors.f90));
    sum.pdf = (of(1.0F) - surfaces.layer_chosen) * diffuse;
  }
  sum.value = sum.value * diffuse;
  if (light.layered) add_layer(surfaces, to_light, cosine, sum);
  return sum;
}

/// A number in [0, 1) anew from one that is, or is not, below the share.
Lanes used_again(Lanes number, Lanes share, LaneMask below) {
  return clamp(where(below, number / share, (number - share) / (of(1.0F) - share)), 0.0F, 0.99999994F);
}

/// bsdf_direction.
Vectors direction_of(const WideLight& light, const Surfaces& surfaces, const Numbers& random) {
  const LaneMask layer = random.x < surfaces.layer_chosen;
  const Lanes x = light.layered ? used_again(random.x, surfaces.layer_chosen, layer) : random.x;
  const Lanes across = of(2.0F) * x - of(1.0F), down = of(2.0F) * random.y - of(1.0F);
  const LaneMask wide = hn::Abs(across) > hn::Abs(down);
  const Lanes radius = where(wide, across, down), other = where(wide, down, across);
  const Lanes eighth = of(0.78539816F) * hn::IfThenZeroElse(radius == of(0.0F), other / radius);
  const SineCosine turn =
      sine_cosine(where(layer, of(6.28318531F) * x, where(wide, eighth, of(1.57079633F) - eighth)));
  const Lanes u = radius * turn.cosine, v = radius * turn.sine;
  const Vectors diffuse{u, v, hn::Sqrt(positive(of(1.0F) - (u * u + v * v)))};
  if (!light.layered) return diffuse;
  const Lanes alpha = surfaces.rough.alpha;
  const Vectors& eye = surfaces.to_eye;
  const Vectors stretched = unit({eye.x * alpha, eye.y * alpha, eye.z});
  const Lanes below = surfaces.bound * stretched.z;
  const Lanes height = (of(1.0F) - random.y) * (of(1.0F) + below) - below;
  const Lanes sine = hn::Sqrt(positive(of(1.0F) - height * height));
  const Vectors facing = stretched + Vectors{sine * turn.cosine, sine * turn.sine, height};
  const Vectors facet = unit({facing.x * alpha, facing.y * alpha, hn::Max(facing.z, of(1e-9F))});
  return where(layer, facet * (of(2.0F) * dot(eye, facet)) - eye, diffuse);
}

/// Vectors of a surface's own frame (basis_of).
struct Frames {
  Vectors u, v, normal;
};

Frames frames_of(const Vectors& normal) {
  const auto& [x, y, z] = normal;
  const Lanes one = of(1.0F), side = where(z >= of(0.0F), one, of(-1.0F));
  const Lanes a = of(-1.0F) / (side + z), b = x * y * a;
  return {{one + side * x * x * a, side * b, hn::Neg(side) * x}, {b, side + y * y * a, hn::Neg(y)}, normal};
}

Vectors to_own(const Frames& frames, const Vectors& dir) {
  return {dot(dir, frames.u), dot(dir, frames.v), dot(dir, frames.normal)};
}

/// Sets the direction that paths go on in, its weight and its probability.
void choose_next(const WideLight& light, const Surfaces& surfaces, const Frames& frames,
                 const Numbers& random, std::uint32_t from, WideVertices& vertices) {
  const Vectors next = direction_of(light, surfaces, random);
  SurfaceValue of_next{surfaces.base, positive(next.z) * of(INVERSE_PI)};
  if (light.layered) {
    of_next = value_at(light, surfaces, next);
    of_next.value = where(of_next.pdf > of(0.0F), of_next.value * (of(1.0F) / of_next.pdf), all(of(0.0F)));
  }
  store(where(next.z > of(0.0F), of_next.value, all(of(0.0F))), vertices.weight, from);
  store(frames.u * next.x + frames.v * next.y + frames.normal * next.z, vertices.next_dir, from);
  store(of_next.pdf, vertices.next_pdf, from);
  store(random.w, vertices.next_random, from);
}

void scatter(const WideLight& light, WideVertices& vertices) {
  for (std::uint32_t from = 0; from < vertices.count; from += LANES) {
    const Frames frames = frames_of(load(vertices.normal, from));
    const Vectors dir = to_own(frames, load(vertices.dir, from));
    const Vectors to_eye{hn::Neg(dir.x), hn::Neg(dir.y), hn::Max(hn::Neg(dir.z), of(1e-6F))};
    const Surfaces surfaces = surfaces_at(light, vertices, from, to_eye);
    const SurfaceValue towards = value_at(light, surfaces, to_own(frames, load(vertices.light_dir, from)));
    store(towards.value, vertices.value, from);
    store(towards.pdf, vertices.value_pdf, from);
    const Words group = hn::ShiftLeft<1>(load(vertices.bounce, from)) + words(2);
    choose_next(light, surfaces, frames,
                sobol_numbers(load(vertices.pixel, from), load(vertices.sample, from), group, light.seed),
                from, vertices);
  }
}

/// Sets the numbers that choose lights and, where there is a sky table, directions towards it.
void sample(const WideLight& light, WideVertices& vertices) {
  for (std::uint32_t from = 0; from < vertices.count; from += LANES) {
    const Words group = hn::ShiftLeft<1>(load(vertices.bounce, from)) + words(1);
    const Numbers random =
        sobol_numbers(load(vertices.pixel, from), load(vertices.sample, from), group, light.seed);
    store({random.x, random.y, random.z}, vertices.light_random, from);
    if (light.sky_width > 0) sample_sky(light, random.x, random.y, from, vertices);
  }
}

}  // namespace
}  // namespace splatray
