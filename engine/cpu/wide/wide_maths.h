/// Functions of float32 for the CPU that this file is compiled for; after wide_blend.h. One definition for all CPUs, without fused products, so
/// the same bits on each. Polynomials: S. L. Moshier 1989, "Methods and Programs for Mathematical Functions" (Cephes), within 2 steps.

namespace splatray {
namespace {

using Ints = hn::Vec<IntTag>;
using LaneMask = hn::Mask<Tag>;

Ints ints(std::int32_t value) { return hn::Set(INT_TAG, value); }
Words words(std::uint32_t value) { return hn::Set(WORD_TAG, value); }
Lanes where(LaneMask mask, Lanes a, Lanes b) { return hn::IfThenElse(mask, a, b); }
Lanes positive(Lanes x) { return hn::Max(x, of(0.0F)); }
Vectors operator*(const Vectors& a, const Vectors& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
Vectors operator/(const Vectors& a, const Vectors& b) { return {a.x / b.x, a.y / b.y, a.z / b.z}; }
Vectors all(Lanes x) { return {x, x, x}; }
Vectors where(LaneMask mask, const Vectors& a, const Vectors& b) {
  return {where(mask, a.x, b.x), where(mask, a.y, b.y), where(mask, a.z, b.z)};
}
Vectors unit(const Vectors& v) { return v * inverse_sqrt(dot(v, v)); }

/// c[0] x^n + c[1] x^(n-1) + ... + c[n].
template <std::size_t COUNT>
Lanes polynomial(Lanes x, const float (&c)[COUNT]) {
  Lanes sum = of(c[0]);
  for (std::size_t i = 1; i < COUNT; ++i) sum = sum * x + of(c[i]);
  return sum;
}

struct SineCosine {
  Lanes sine, cosine;
};

/// Sine and cosine of angles of few turns, radians.
SineCosine sine_cosine(Lanes angle) {
  const Lanes quarters = hn::Round(angle * of(0.636619772F));
  Lanes x = angle - quarters * of(1.5703125F);
  x = x - quarters * of(4.837512969970703e-4F);
  x = x - quarters * of(7.54978995489e-8F);
  const Lanes z = x * x;
  const Lanes sine = polynomial(z, {-1.9515295891e-4F, 8.3321608736e-3F, -1.6666654611e-1F}) * z * x + x;
  const Lanes cosine =
      polynomial(z, {2.443315711809948e-5F, -1.388731625493765e-3F, 4.166664568298827e-2F}) * z * z -
      of(0.5F) * z + of(1.0F);
  const Ints quarter = hn::ConvertTo(INT_TAG, quarters);
  const LaneMask swapped = hn::RebindMask(TAG, (quarter & ints(1)) == ints(1));
  const auto sign = [](Ints bit) { return hn::BitCast(TAG, hn::ShiftLeft<30>(bit & ints(2))); };
  return {hn::Xor(where(swapped, cosine, sine), sign(quarter)),
          hn::Xor(where(swapped, sine, cosine), sign(quarter + ints(1)))};
}

/// The natural logarithm of numbers >= 2^-126.
Lanes logarithm(Lanes x) {
  const Ints bits = hn::BitCast(INT_TAG, x);
  const Lanes fraction = hn::BitCast(TAG, (bits & ints(0x007FFFFF)) | ints(0x3F000000));
  const LaneMask low = fraction < of(0.707106781F);
  const Lanes exponent =
      hn::ConvertTo(TAG, hn::ShiftRight<23>(bits) - ints(126)) - where(low, of(1.0F), of(0.0F));
  const Lanes m = where(low, fraction + fraction, fraction) - of(1.0F), z = m * m;
  const Lanes p = polynomial(
      m, {7.0376836292e-2F, -1.1514610310e-1F, 1.1676998740e-1F, -1.2420140846e-1F, 1.4249322787e-1F,
          -1.6668057665e-1F, 2.0000714765e-1F, -2.4999993993e-1F, 3.3333331174e-1F});
  const Lanes rest = p * m * z + exponent * of(-2.12194440e-4F) - of(0.5F) * z;
  return m + rest + exponent * of(0.693359375F);
}

/// The angle of (x, y) from the x axis, -pi..pi; 0 of no direction.
Lanes angle_of(Lanes y, Lanes x) {
  const Lanes wide = hn::Abs(x), high = hn::Abs(y);
  const Lanes slope = hn::Min(wide, high) / hn::Max(hn::Max(wide, high), of(1e-30F));  // 0..1
  const LaneMask steep = slope > of(0.414213562F);
  const Lanes t = where(steep, (slope - of(1.0F)) / (slope + of(1.0F)), slope), z = t * t;
  Lanes angle =
      polynomial(z, {8.05374449538e-2F, -1.38776856032e-1F, 1.99777106478e-1F, -3.33329491539e-1F}) * z * t +
      t + where(steep, of(0.785398163F), of(0.0F));
  angle = where(high > wide, of(1.57079633F) - angle, angle);
  angle = where(x < of(0.0F), of(3.14159265F) - angle, angle);
  return hn::CopySign(angle, y);
}

/// The arc cosine of -1..1.
Lanes arc_cosine(Lanes x) {
  const Lanes size = hn::Abs(x);
  const LaneMask outer = size > of(0.5F);
  const Lanes z = where(outer, of(0.5F) * (of(1.0F) - size), size * size);
  const Lanes root = where(outer, hn::Sqrt(z), size);
  const Lanes sine = polynomial(z, {4.2163199048e-2F, 2.4181311049e-2F, 4.5470025998e-2F, 7.4953002686e-2F,
                                    1.6666752422e-1F}) *
                         z * root +
                     root;
  const Lanes twice = sine + sine;
  return where(outer, where(x < of(0.0F), of(3.14159265F) - twice, twice),
               of(1.57079633F) - hn::CopySign(sine, x));
}

/// All 32 bits of words as numbers: both halves are exact, so that their sum alone is rounded.
Lanes any_number(Words word) {
  return number(hn::ShiftRight<16>(word)) * of(65536.0F) + number(masked(word, 0xFFFFU));
}

Lanes load(const OfPlaces<float>& values, std::uint32_t from) { return hn::Load(TAG, values.data() + from); }
Words load(const OfPlaces<std::uint32_t>& values, std::uint32_t from) {
  return hn::Load(WORD_TAG, values.data() + from);
}
Vectors load(const VectorsOfPlaces& v, std::uint32_t from) {
  return {load(v[0], from), load(v[1], from), load(v[2], from)};
}
void store(Lanes value, OfPlaces<float>& values, std::uint32_t from) {
  hn::Store(value, TAG, values.data() + from);
}
void store(const Vectors& v, VectorsOfPlaces& values, std::uint32_t from) {
  store(v.x, values[0], from), store(v.y, values[1], from), store(v.z, values[2], from);
}

}  // namespace
}  // namespace splatray
