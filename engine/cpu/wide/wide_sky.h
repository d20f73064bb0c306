/// shaders/light/environment.glsl and sky.glsl, for the CPU that this file is compiled for; after wide_maths.h. Choices are the same, numbers but
/// for rounding.

namespace splatray {
namespace {

constexpr float OF_WORD = 2.3283064e-10F;  // 2^-32
constexpr float TWO_PI_SQUARED = 19.7392088F;

Vectors vectors(const std::array<float, 3>& v) { return {of(v[0]), of(v[1]), of(v[2])}; }

Vectors in_environment(const WideLight& light, const Vectors& dir) {
  return {dot(dir, vectors(light.right)), dot(dir, vectors(light.up)), dot(dir, vectors(light.back))};
}

Vectors in_world(const WideLight& light, const Vectors& dir) {
  return vectors(light.right) * dir.x + vectors(light.up) * dir.y + vectors(light.back) * dir.z;
}

/// Column and row in the latitude-longitude image, 0..1.
struct SkyPlace {
  Lanes x, y;
};

/// environment_position.
SkyPlace place_of(const Vectors& dir) {
  return {angle_of(dir.x, hn::Neg(dir.z)) * of(0.15915494F) + of(0.5F),
          arc_cosine(clamp(dir.y, -1.0F, 1.0F)) * of(0.31830989F)};
}

/// environment_texel, times the factor.
Vectors radiance_at(const WideLight& light, const SkyPlace& place) {
  const auto width = static_cast<std::int32_t>(light.environment_width),
             height = static_cast<std::int32_t>(light.environment_height);
  const Lanes x = place.x * of(static_cast<float>(width)) - of(0.5F);
  const Lanes y = place.y * of(static_cast<float>(height)) - of(0.5F);
  const Lanes corner_x = hn::Floor(x), corner_y = hn::Floor(y);
  const Ints first = hn::Min(hn::Max(hn::ConvertTo(INT_TAG, corner_x), ints(-1)), ints(width - 1));
  const Ints row = hn::Min(hn::Max(hn::ConvertTo(INT_TAG, corner_y), ints(-1)), ints(height - 1));
  const Ints next = first + ints(1);
  const Ints left = hn::IfThenElse(first < ints(0), ints(width - 1), first);
  const Ints right = hn::IfThenElse(next < ints(width), next, ints(0));
  const Ints above = hn::Max(row, ints(0)) * ints(width),
             below = hn::Min(row + ints(1), ints(height - 1)) * ints(width);
  const auto* texels = reinterpret_cast<const float*>(light.environment);
  const auto mixed = [](Lanes a, Lanes b, Lanes share) { return a * (of(1.0F) - share) + b * share; };
  const auto channel = [&](std::size_t c) {
    const auto texel = [&](Ints index) { return hn::GatherIndex(TAG, texels + c, hn::ShiftLeft<2>(index)); };
    const Lanes share = x - corner_x;
    return mixed(mixed(texel(above + left), texel(above + right), share),
                 mixed(texel(below + left), texel(below + right), share), y - corner_y) *
           of(light.factor[c]);
  };
  return {channel(0), channel(1), channel(2)};
}

Words sky_word(const WideLight& light, Ints index) { return hn::GatherIndex(WORD_TAG, light.sky, index); }

/// sky_find.
Ints find_entry(const WideLight& light, Ints begin, std::uint32_t count, Words key) {
  Ints low = ints(0), high = ints(static_cast<std::int32_t>(count));
  for (std::uint32_t most = count; most > 1; most = (most + 1) / 2) {
    const Ints middle = hn::ShiftRight<1>(low + high);
    const auto known = high - low < ints(2);
    const auto above = hn::RebindMask(INT_TAG, sky_word(light, begin + middle) > key);
    low = hn::IfThenElse(hn::Or(above, known), low, middle);
    high = hn::IfThenElse(hn::AndNot(known, above), middle, high);
  }
  return low;
}

/// A row of the table, or a cell of it.
struct SkyEntry {
  Words word;
  Lanes share;  ///< sky_share
};

SkyEntry entry_at(const WideLight& light, Ints begin, std::uint32_t count, Ints entry) {
  const Ints last = ints(static_cast<std::int32_t>(count) - 1);
  const Words word = sky_word(light, begin + entry);
  const auto more = hn::RebindMask(WORD_TAG, entry < last);
  const Words next = hn::IfThenElseZero(more, sky_word(light, begin + hn::Min(entry + ints(1), last)));
  return {word, any_number(next - word) * of(OF_WORD)};
}

/// sky_again.
Lanes again(const SkyEntry& entry, Words key) {
  return hn::Min(any_number(key - entry.word) * of(OF_WORD) / entry.share, of(0.99999994F));
}

/// sky_cell_pdf.
Lanes cell_pdf(const WideLight& light, const SkyEntry& row, const SkyEntry& column, Lanes height) {
  const Lanes sine = hn::Sqrt(hn::Max(of(1.0F) - height * height, of(1e-12F)));
  return row.share * column.share * of(static_cast<float>(light.sky_width * light.sky_height)) /
         (of(TWO_PI_SQUARED) * sine);
}

Ints row_begin(const WideLight& light, Ints row) {
  return ints(static_cast<std::int32_t>(light.sky_height)) +
         row * ints(static_cast<std::int32_t>(light.sky_width));
}

/// Sets light_dir, radiance and light_pdf.
void sample_sky(const WideLight& light, Lanes random_x, Lanes random_y, std::uint32_t from,
                WideVertices& vertices) {
  const auto key_of = [](Lanes random) {
    return hn::ShiftLeft<8>(hn::BitCast(WORD_TAG, hn::ConvertTo(INT_TAG, random * of(16777216.0F))));
  };
  const Words key_row = key_of(random_y), key_column = key_of(random_x);
  const Ints row = find_entry(light, ints(0), light.sky_height, key_row), begin = row_begin(light, row);
  const Ints column = find_entry(light, begin, light.sky_width, key_column);
  const SkyEntry of_row = entry_at(light, ints(0), light.sky_height, row),
                 of_column = entry_at(light, begin, light.sky_width, column);
  const SkyPlace place{
      (hn::ConvertTo(TAG, column) + again(of_column, key_column)) / of(static_cast<float>(light.sky_width)),
      (hn::ConvertTo(TAG, row) + again(of_row, key_row)) / of(static_cast<float>(light.sky_height))};
  const SineCosine longitude = sine_cosine(of(6.28318531F) * (place.x - of(0.5F)));
  const Lanes cosine = sine_cosine(of(3.14159265F) * place.y).cosine;
  const Lanes sine = hn::Sqrt(positive(of(1.0F) - cosine * cosine));
  const Vectors own{sine * longitude.sine, cosine, hn::Neg(sine * longitude.cosine)};
  store(in_world(light, own), vertices.light_dir, from);
  store(radiance_at(light, place), vertices.radiance, from);
  store(cell_pdf(light, of_row, of_column, cosine), vertices.light_pdf, from);
}

/// sky_pdf of directions of the environment's own frame.
Lanes sky_pdf_at(const WideLight& light, const Vectors& own, const SkyPlace& place) {
  const auto cell = [](Lanes at, std::uint32_t count) {
    const Ints index = hn::ConvertTo(INT_TAG, at * of(static_cast<float>(count)));
    return hn::Max(hn::Min(index, ints(static_cast<std::int32_t>(count) - 1)), ints(0));
  };
  const Ints row = cell(place.y, light.sky_height), column = cell(place.x, light.sky_width);
  return cell_pdf(light, entry_at(light, ints(0), light.sky_height, row),
                  entry_at(light, row_begin(light, row), light.sky_width, column), own.y);
}

void escape(const WideLight& light, WideEscapes& escapes) {
  for (std::uint32_t from = 0; from < escapes.count; from += LANES) {
    const Vectors own = in_environment(light, load(escapes.dir, from));
    const SkyPlace place = place_of(own);
    store(radiance_at(light, place), escapes.radiance, from);
    store(light.sky_width > 0 ? sky_pdf_at(light, own, place) : of(0.0F), escapes.pdf, from);
  }
}

}  // namespace
}  // namespace splatray
