/// shaders/lang/sobol.glsl, for the CPU that this file is compiled for; after wide_maths.h. The same bits.

namespace splatray {
namespace {

Words hash_of(Words x) {
  x = x ^ hn::ShiftRight<16>(x);
  x = x * words(0x7FEB352DU);
  x = x ^ hn::ShiftRight<15>(x);
  x = x * words(0x846CA68BU);
  return x ^ hn::ShiftRight<16>(x);
}

Lanes unit_number(Words x) { return number(hn::ShiftRight<8>(x)) * of(5.9604645e-8F); }

Words bits_reversed(Words x) {
  x = masked(hn::ShiftRight<1>(x), 0x55555555U) | hn::ShiftLeft<1>(masked(x, 0x55555555U));
  x = masked(hn::ShiftRight<2>(x), 0x33333333U) | hn::ShiftLeft<2>(masked(x, 0x33333333U));
  x = masked(hn::ShiftRight<4>(x), 0x0F0F0F0FU) | hn::ShiftLeft<4>(masked(x, 0x0F0F0F0FU));
  x = masked(hn::ShiftRight<8>(x), 0x00FF00FFU) | hn::ShiftLeft<8>(masked(x, 0x00FF00FFU));
  return hn::ShiftRight<16>(x) | hn::ShiftLeft<16>(x);
}

Words scrambled(Words x, Words seed) {
  x = x ^ (x * words(0x3D20ADEAU));
  x = x + seed;
  x = x * (hn::ShiftRight<16>(seed) | words(1));
  x = x ^ (x * words(0x05526C56U));
  return x ^ (x * words(0x53A22864U));
}

Words second_dimension(Words index) {
  index = index ^ hn::ShiftRight<16>(index);
  index = index ^ masked(hn::ShiftRight<8>(index), 0x00FF00FFU);
  index = index ^ masked(hn::ShiftRight<4>(index), 0x0F0F0F0FU);
  index = index ^ masked(hn::ShiftRight<2>(index), 0x33333333U);
  return index ^ masked(hn::ShiftRight<1>(index), 0x55555555U);
}

/// Four numbers of each place.
struct Numbers {
  Lanes x, y, z, w;
};

void number_pair(Words index_reversed, Words seed, Lanes& first, Lanes& second) {
  const Words index = bits_reversed(scrambled(index_reversed, seed));
  first = unit_number(bits_reversed(scrambled(index, hash_of(seed + words(1)))));
  second = unit_number(bits_reversed(scrambled(second_dimension(index), hash_of(seed + words(2)))));
}

/// sobol_sample.
Numbers sobol_numbers(Words pixel, Words sample, Words group, std::uint32_t seed) {
  const Words own = hash_of(pixel ^ hash_of(group + words(0x9E3779B9U * seed)));
  const Words index = bits_reversed(sample);
  Numbers numbers;
  number_pair(index, own, numbers.x, numbers.y);
  number_pair(index, hash_of(own), numbers.z, numbers.w);
  return numbers;
}

}  // namespace
}  // namespace splatray
