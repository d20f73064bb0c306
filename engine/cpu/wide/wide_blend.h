/// Blending, for the CPU that this file is compiled for; after wide_step.h. What accumulate_candidates of
/// shaders/trace/cluster.glsl does for one splat after the other, by the same operations in the same order, so to the same bits.

namespace splatray {
namespace {

Lanes of(float value) { return hn::Set(TAG, value); }

Vectors operator*(const Vectors& a, Lanes b) { return {a.x * b, a.y * b, a.z * b}; }
Vectors operator+(const Vectors& a, const Vectors& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vectors operator-(const Vectors& a, const Vectors& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Lanes dot(const Vectors& a, const Vectors& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vectors vectors_of(const std::array<float, 3>& v) { return {of(v[0]), of(v[1]), of(v[2])}; }
Vectors load(const std::array<OfMeetings<float>, 3>& v, std::uint32_t from) {
  return {hn::Load(TAG, &v[0][from]), hn::Load(TAG, &v[1][from]), hn::Load(TAG, &v[2][from])};
}

Vectors turned_where(hn::Mask<Tag> mask, const Vectors& v) {
  return {hn::IfThenElse(mask, hn::Neg(v.x), v.x), hn::IfThenElse(mask, hn::Neg(v.y), v.y),
          hn::IfThenElse(mask, hn::Neg(v.z), v.z)};
}

Lanes inverse_sqrt(Lanes x) { return of(1.0F) / hn::Sqrt(x); }

/// To integers, rounded down: the sum of lanes.
std::int32_t sum_of(Lanes whole) {
  return hn::GetLane(hn::SumOfLanes(INT_TAG, hn::ConvertTo(INT_TAG, whole)));
}

Lanes field_slope(Words bits) {
  const Lanes q = (number(masked(bits, 0x3FFU)) - of(512.0F)) * of(1.0F / static_cast<float>(FIELD_SCALE));
  return of(0.5F) * q * hn::Abs(q);
}

Lanes field_lean(Words bits) {
  const float scale = static_cast<float>(LEAN_SCALE);
  return (number(masked(bits, 0x7FFFU)) - of(scale)) * of(1.0F / scale);
}

/// facet_at where there are normal fields, and constant terms where `leans`: sets the facet's normal, which is the plane's, and
/// returns how far behind the plane it is.
Lanes apply_field(Words word, bool leans, const Vectors& plane_normal, Lanes cosine,
                  const Vectors& from_center, Lanes inverse_radius, const Vectors& dir,
                  Vectors& facet_normal) {
  const Lanes one = of(1.0F), minus = of(-1.0F);
  const auto& [x, y, z] = plane_normal;
  const Lanes side = hn::IfThenElse(z >= of(0.0F), one, minus);
  const Lanes a = minus / (side + z);
  const Vectors u{one + side * x * x * a, side * x * y * a, hn::Neg(side) * x};
  const Vectors v{x * y * a, side + y * y * a, hn::Neg(y)};
  const Lanes along_u = dot(from_center, u), along_v = dot(from_center, v);
  const Lanes uv = field_slope(hn::ShiftRight<10>(word));
  Lanes lean_u = (field_slope(word) * along_u + uv * along_v) * inverse_radius;
  Lanes lean_v = (uv * along_u + field_slope(hn::ShiftRight<20>(word)) * along_v) * inverse_radius;
  Lanes height = of(-0.5F) * (lean_u * along_u + lean_v * along_v);
  if (leans) {
    const auto constant = hn::RebindMask(TAG, hn::TestBit(word, hn::Set(WORD_TAG, FIELD_LEANS)));
    height = hn::IfThenZeroElse(constant, height);
    lean_u = hn::IfThenElse(constant, field_lean(word), lean_u);
    lean_v = hn::IfThenElse(constant, field_lean(hn::ShiftRight<15>(word)), lean_v);
  }
  const auto away = cosine > of(0.0F);
  Vectors turned = turned_where(away, plane_normal + u * lean_u + v * lean_v);
  turned = turned - dir * hn::Max(dot(turned, dir), of(0.0F));
  facet_normal = turned * inverse_sqrt(dot(turned, turned));
  return height / hn::IfThenElse(away, hn::Max(cosine, of(MIN_COSINE)), hn::Min(cosine, of(-MIN_COSINE)));
}

/// df_add(t, -first).x.
Lanes behind_first(const WideMeetings& meetings, std::uint32_t from, const WideWindow& window) {
  const Lanes a = hn::Load(TAG, &meetings.t[from]), b = of(-window.t);
  const Lanes sum = a + b;
  const Lanes b_seen = sum - a;
  const Lanes a_seen = sum - b_seen;
  const Lanes lost = (a - a_seen) + (b - b_seen);
  return sum + (lost + (hn::Load(TAG, &meetings.t_low[from]) + of(-window.t_low)));
}

Lanes clamp(Lanes x, float low, float high) { return hn::Min(hn::Max(x, of(low)), of(high)); }

Lanes weight_at(Lanes u_squared, Lanes share) {
  const Lanes rim = hn::Max(of(1.0F) - u_squared, of(0.0F));
  const Lanes x = clamp(of(2.0F) - of(2.0F) * share, 0.0F, 1.0F);
  return hn::Max(rim * rim * (x * x * (of(3.0F) - of(2.0F) * x)), of(WEIGHT_LEAST));
}

Lanes color_channel(Words color, Lanes weight) {
  const Lanes root = number(masked(color, 0xFFU)) / of(255.0F);
  return root * root * weight + of(0.5F);
}

void blend_lanes(WideMeetings& meetings, std::uint32_t from, const WideWindow& window, WideSums& sums) {
  const Vectors dir = vectors_of(window.dir), from_center = load(meetings.from_center, from);
  const Lanes behind = behind_first(meetings, from, window);
  const Words radius_object = hn::Load(WORD_TAG, &meetings.radius_object[from]);
  const Lanes inverse_radius = inverse_sqrt(decode_radius_squared(radius_object));
  const Lanes u_squared = hn::Load(TAG, &meetings.rho_squared[from]) * (inverse_radius * inverse_radius);
  const Vectors stored = decode_normal(hn::Load(WORD_TAG, &meetings.normal[from]));
  const Vectors plane_normal = stored * inverse_sqrt(dot(stored, stored));
  const Lanes cosine = dot(plane_normal, dir);
  const auto back = cosine > of(0.0F);
  Vectors normal = turned_where(back, plane_normal);
  const Lanes inverse_depth = of(window.inverse_depth);
  Lanes share = behind * inverse_depth;
  const auto there = hn::RebindMask(TAG, hn::Iota(INT_TAG, static_cast<std::int32_t>(from)) <
                                             hn::Set(INT_TAG, static_cast<std::int32_t>(meetings.count)));
  const auto of_object =
      hn::RebindMask(TAG, masked(radius_object, OBJECT_MASK) == hn::Set(WORD_TAG, window.object));
  const auto same_side = window.back ? back : hn::Not(back);
  const auto like = hn::And(same_side, dot(plane_normal, vectors_of(window.normal)) > of(0.5F));
  const auto in_window = hn::And(share <= of(1.0F), share >= of(-1.0F));
  const auto member = hn::And(hn::And(there, of_object), hn::And(like, in_window));
  const Lanes weight = hn::IfThenElseZero(member, weight_at(u_squared, share) * of(WEIGHT_UNIT));
  Lanes beyond = of(0.0F);
  if (window.fields)
    beyond = apply_field(hn::Load(WORD_TAG, &meetings.field[from]), window.leans, plane_normal, cosine,
                         from_center, inverse_radius, dir, normal);
  share = hn::IfThenElseZero(member, clamp((behind + beyond) * inverse_depth, -1.0F, 1.0F));
  hn::Store(weight, TAG, &meetings.weight[from]);
  sums.weight += sum_of(weight + of(0.5F));
  sums.depth += sum_of(hn::Floor(weight * share + of(0.5F)));
  sums.normal[0] += sum_of(hn::Floor(hn::IfThenElseZero(member, normal.x * weight) + of(0.5F)));
  sums.normal[1] += sum_of(hn::Floor(hn::IfThenElseZero(member, normal.y * weight) + of(0.5F)));
  sums.normal[2] += sum_of(hn::Floor(hn::IfThenElseZero(member, normal.z * weight) + of(0.5F)));
  sums.members += static_cast<std::uint32_t>(hn::CountTrue(TAG, member));
  if (!window.colors) return;
  const Words color = hn::Load(WORD_TAG, &meetings.color[from]);
  sums.color[0] += sum_of(color_channel(color, weight));
  sums.color[1] += sum_of(color_channel(hn::ShiftRight<8>(color), weight));
  sums.color[2] += sum_of(color_channel(hn::ShiftRight<16>(color), weight));
}

WideSums blend(WideMeetings& meetings, const WideWindow& window) {
  WideSums sums;
  for (std::uint32_t from = 0; from < meetings.count; from += LANES)
    blend_lanes(meetings, from, window, sums);
  return sums;
}

}  // namespace
}  // namespace splatray
