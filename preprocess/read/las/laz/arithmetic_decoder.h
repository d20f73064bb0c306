/// Arithmetic decoding of bytes as LASzip codes them.
#pragma once
#include <bit>
#include <cstdint>
#include <span>

#include "preprocess/base/little_endian.h"
#include "preprocess/read/las/laz/symbol_model.h"

namespace splatray {

/// A. Said's decoder (Introduction to Arithmetic Coding, HPL-2004-76, 2004) of 32 bits, renormalised by bytes. Bytes that
/// were not coded by its like decode to something too: is_damaged() then finds it in most cases.
class ArithmeticDecoder {
 public:
  /// Begins with the first byte of `bytes`, which must outlive the decoding.
  void start(std::span<const unsigned char> bytes) {
    begin_ = next_ = bytes.data();
    end_ = begin_ + bytes.size();
    beyond_ = 0;
    length_ = 0xFFFFFFFF;
    value_ = 0;
    for (int i = 0; i < 4; ++i) value_ = (value_ << 8U) | next_byte();
    is_impossible_ = value_ >= length_;
    if (is_impossible_) value_ = 0;
  }

  template <unsigned N>
  [[nodiscard, gnu::always_inline]] unsigned symbol(SymbolModel<N>& model) {
    model.prepare();
    const std::uint32_t unit = length_ >> SYMBOL_BITS;
    const unsigned symbol = model.find(value_ / unit);
    const std::uint32_t begin = model.begin(symbol) * unit;
    const std::uint32_t end = symbol + 1 < model.symbols() ? model.begin(symbol + 1) * unit : length_;
    narrow(begin, end - begin);
    model.count(symbol);
    return symbol;
  }

  [[nodiscard]] unsigned bit(BitModel& model) {
    const std::uint32_t zero = model.zero_probability * (length_ >> BitModel::BITS);
    const bool is_one = value_ >= zero;
    if (!is_one) ++model.zeros;
    narrow(is_one ? zero : 0, is_one ? length_ - zero : zero);
    if (--model.until_update == 0) model.update();
    return is_one ? 1 : 0;
  }

  /// `count` <= 32 bits that are all alike in probability.
  [[nodiscard]] std::uint32_t bits(unsigned count) {
    constexpr unsigned MOST_AT_ONCE = 19;
    if (count > MOST_AT_ONCE) {
      const std::uint32_t low = bits(16);
      return (bits(count - 16) << 16U) | low;
    }
    const std::uint32_t unit = length_ >> count;
    const std::uint32_t value = value_ / unit;
    narrow(value * unit, unit);
    is_impossible_ |= (value >> count) != 0;
    return value & ((1U << count) - 1);
  }

  [[nodiscard]] std::uint64_t bits64() {
    const std::uint64_t low = bits(32);
    return (std::uint64_t{bits(32)} << 32U) | low;
  }

  /// Whether no coder can have written these bytes, or more was decoded than they hold.
  [[nodiscard]] bool is_damaged() const { return is_impossible_ || beyond_ > 0; }
  /// Whether all bytes were decoded and are not known to be damaged; what coders write is read to its very end.
  [[nodiscard]] bool is_complete() const { return !is_damaged() && next_ == end_; }
  void set_damaged() { is_impossible_ = true; }
  /// Bytes read so far; a whole stream is read to its end.
  [[nodiscard]] std::size_t consumed() const { return static_cast<std::size_t>(next_ - begin_); }

 private:
  std::uint32_t next_byte() {
    if (next_ < end_) [[likely]]
      return *next_++;
    ++beyond_;
    return 0;
  }

  /// Goes on with a part of the interval; whole bytes are read until its length is at least 2^24. How many cannot be
  /// predicted, so there is no branch on it.
  void narrow(std::uint32_t begin, std::uint32_t length) {
    value_ -= begin;
    const unsigned shift = static_cast<unsigned>(std::countl_zero(length)) & 24U;
    length_ = length << shift;
    if (end_ - next_ >= 4) [[likely]] {
      const std::uint64_t four = __builtin_bswap32(load<std::uint32_t>(next_));
      value_ = static_cast<std::uint32_t>((((std::uint64_t{value_} << 32U) | (four)) << shift) >> 32U);
      next_ += shift / 8;
    } else {
      for (unsigned i = 0; i < shift; i += 8) value_ = (value_ << 8U) | next_byte();
    }
  }

  const unsigned char* next_ = nullptr;
  const unsigned char* end_ = nullptr;
  const unsigned char* begin_ = nullptr;
  std::uint32_t value_ = 0;   ///< < length_
  std::uint32_t length_ = 0;  ///< >= 2^24
  std::uint32_t beyond_ = 0;  ///< bytes asked for behind the end
  bool is_impossible_ = false;
};

}  // namespace splatray
