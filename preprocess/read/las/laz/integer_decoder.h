/// Integers that were coded as differences from a prediction.
#pragma once
#include <array>
#include <cstdint>

#include "preprocess/read/las/laz/arithmetic_decoder.h"

namespace splatray {

/// How differences of up to `BITS` bits are coded, whose width in bits has a model of its own (M. Isenburg, LASzip, 2013,
/// integer compressor): their high eight bits by a model for each width, the others as they are.
template <unsigned BITS>
class DifferenceModels {
 public:
  using WidthModel = SymbolModel<BITS + 1>;

  DifferenceModels() {
    for (unsigned i = 0; i < BITS; ++i) high_[i] = SymbolModel<256>(1U << std::min(i + 1, HIGH_BITS));
  }

  void reset() {
    for (auto& model : high_) model.reset();
    low_ = {};
  }

  /// The next difference, modulo 2^32. A width w > 0 is of the numbers -(2^w - 1) to -2^(w-1) and 2^(w-1) + 1 to 2^w, a
  /// width of 0 of 0 and 1.
  [[nodiscard]] std::uint32_t read(ArithmeticDecoder& in, WidthModel& width_model) {
    constexpr unsigned WIDEST = 32;  ///< there is only one such number
    const unsigned width = width_ = in.symbol(width_model);
    if (width == 0) return in.bit(low_);
    if (width == WIDEST) return 0x80000000U;
    std::uint32_t code = in.symbol(high_[width - 1]);
    if (width > HIGH_BITS) {
      const unsigned raw = width - HIGH_BITS;
      code = (code << raw) | in.bits(raw);
    }
    // Code + 1 in the upper half, else code - (2^w - 1); which of them cannot be predicted.
    const std::uint32_t is_upper = code >> (width - 1);
    return code + is_upper - (((1U << width) - 1) & (is_upper - 1));
  }

  /// Width of the last difference, as read() has it.
  [[nodiscard]] unsigned width() const { return width_; }

 private:
  static constexpr unsigned HIGH_BITS = 8;

  std::array<SymbolModel<256>, BITS> high_;  ///< of the widths from 1 on
  BitModel low_;
  unsigned width_ = 0;
};

/// The sum modulo 2^32.
[[nodiscard]] inline std::int32_t add_wrapped(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
}

/// Integers as differences from a prediction, with contexts for the difference's width. `BITS` is 8, 16 or 32; results of
/// fewer than 32 bits are 0 to 2^BITS - 1.
template <unsigned BITS, unsigned CONTEXTS>
class IntegerDecoder {
 public:
  void reset() {
    for (auto& model : width_) model.reset();
    difference_.reset();
  }

  [[nodiscard]] std::int32_t read(ArithmeticDecoder& in, std::int32_t predicted, unsigned context) {
    constexpr std::uint32_t MASK = BITS == 32 ? 0xFFFFFFFF : (1U << (BITS % 32)) - 1;
    const std::uint32_t sum = static_cast<std::uint32_t>(predicted) + difference_.read(in, width_[context]);
    return static_cast<std::int32_t>(sum & MASK);
  }

  /// Bits that the last difference needed; contexts of what follows depend on it.
  [[nodiscard]] unsigned width() const { return difference_.width(); }

 private:
  std::array<typename DifferenceModels<BITS>::WidthModel, CONTEXTS> width_;
  DifferenceModels<BITS> difference_;
};

}  // namespace splatray
