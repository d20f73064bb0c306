#include "preprocess/read/e57/field_stream.h"

#include <algorithm>
#include <cstring>

namespace splatray {
namespace {

/// Numbers as they lie in the file.
template <typename Number>
void decode_numbers(const unsigned char* bytes, std::size_t count, double* values) {
  for (std::size_t i = 0; i < count; ++i) {
    Number number{};
    std::memcpy(&number, bytes + i * sizeof number, sizeof number);
    values[i] = static_cast<double>(number);
  }
}

/// The value of one integer's bits; sums are modulo 2^64, as two's complement has it.
double value_of(std::uint64_t bits, const E57Field& field) {
  const auto integer = static_cast<std::int64_t>(bits + static_cast<std::uint64_t>(field.minimum));
  return static_cast<double>(integer) * field.scale + field.offset;
}

/// Unpacks integers whose first bits are the lowest of the lowest byte. WIDE: a value and the bits before it in its first
/// byte may need more than 64 bits.
template <bool WIDE>
void unpack(const unsigned char* bytes, unsigned bit, std::size_t count, const E57Field& field,
            double* values) {
  const std::uint64_t mask = ~std::uint64_t{0} >> (64U - field.bits);
  const E57Field local = field;
  std::uint64_t at = bit;
  for (std::size_t i = 0; i < count; ++i, at += local.bits) {
    const unsigned char* first = bytes + at / 8;
    const unsigned shift = at % 8;
    std::uint64_t word = 0;
    std::memcpy(&word, first, sizeof word);
    word >>= shift;
    if constexpr (WIDE)
      if (shift > 0) word |= std::uint64_t{first[8]} << (64U - shift);
    values[i] = value_of(word & mask, local);
  }
}

}  // namespace

void FieldStream::append(std::span<const unsigned char> bytes) {
  const std::size_t used = bit_ / 8;
  if (used > 0 && used >= size_ - used) {
    std::memmove(bytes_.data(), bytes_.data() + used, size_ - used);
    size_ -= used;
    bit_ %= 8;
  }
  const std::size_t needed = size_ + bytes.size() + PADDING;
  if (bytes_.size() < needed) bytes_.resize(needed);
  std::memcpy(bytes_.data() + size_, bytes.data(), bytes.size());
  size_ += bytes.size();
}

void FieldStream::decode(std::size_t count, double* values) {
  const unsigned char* bytes = bytes_.data() + bit_ / 8;
  if (field_.bits == 0) {
    std::fill_n(values, count, value_of(0, field_));
  } else if (field_.kind == E57Field::Kind::float32) {
    decode_numbers<float>(bytes, count, values);
  } else if (field_.kind == E57Field::Kind::float64) {
    decode_numbers<double>(bytes, count, values);
  } else if (field_.bits <= 57) {
    unpack<false>(bytes, bit_ % 8, count, field_, values);
  } else {
    unpack<true>(bytes, bit_ % 8, count, field_, values);
  }
  bit_ += std::uint64_t{count} * field_.bits;
}

}  // namespace splatray
