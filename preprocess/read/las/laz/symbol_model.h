/// Adaptive probabilities of symbols for arithmetic decoding.
#pragma once
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <iterator>
#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace splatray {

/// How probabilities are scaled: 2^15 is certain (A. Said, Introduction to Arithmetic Coding, HPL-2004-76, 2004).
inline constexpr unsigned SYMBOL_BITS = 15;

/// Model of a bit: A. Said's adaptive binary model with LASzip's constants (M. Isenburg, LASzip, 2013).
struct BitModel {
  static constexpr unsigned BITS = 13;  ///< probabilities are of 2^13

  std::uint32_t zeros = 1;
  std::uint32_t total = 2;
  std::uint32_t zero_probability = 1U << (BITS - 1);
  std::uint32_t cycle = 4;         ///< bits between updates
  std::uint32_t until_update = 4;  ///< bits

  void update();
};

/// Which of 16 ascending numbers are at most `most`: as many ones from the lowest bit on.
[[nodiscard]] inline unsigned at_most(const std::uint16_t* numbers, std::uint16_t most) {
#if defined(__SSE2__)
  const __m128i bound = _mm_set1_epi16(static_cast<short>(most));
  const auto compare = [bound](const std::uint16_t* eight) {
    const __m128i excess = _mm_subs_epu16(_mm_loadu_si128(reinterpret_cast<const __m128i*>(eight)), bound);
    return _mm_cmpeq_epi16(excess, _mm_setzero_si128());
  };
  return static_cast<unsigned>(_mm_movemask_epi8(_mm_packs_epi16(compare(numbers), compare(numbers + 8))));
#else
  unsigned mask = 0;
  for (unsigned i = 0; i < 16; ++i) mask |= (numbers[i] <= most ? 1U : 0U) << i;
  return mask;
#endif
}

/// Model of up to N symbols: A. Said's adaptive model. Its search compares 16 symbols at once, as branches on what symbols are
/// cannot be predicted: all of few symbols, of many those from where a table says.
template <unsigned N>
class SymbolModel {
 public:
  explicit SymbolModel(unsigned symbols = N) : symbols_(static_cast<std::uint16_t>(symbols)) {}

  /// All symbols become alike again, when the model is next used.
  void reset() { until_update_ = 0; }

  [[nodiscard]] unsigned symbols() const { return symbols_; }

  /// To be called before find(): what reset() put off.
  void prepare() {
    if (until_update_ == 0) [[unlikely]]
      start();
  }

  /// The last symbol whose begin() is at most `scaled`.
  [[nodiscard, gnu::always_inline]] inline unsigned find(std::uint32_t scaled) const;
  /// The sum of the probabilities of all symbols before this one, of 2^15.
  [[nodiscard]] std::uint32_t begin(unsigned symbol) const { return begin_[symbol]; }

  /// Learns that a symbol came.
  void count(unsigned symbol) {
    ++count_[symbol];
    if (--until_update_ == 0) [[unlikely]]
      update();
  }

 private:
  static constexpr unsigned GROUP = 16;
  static constexpr bool HAS_TABLE = N > 64;
  static constexpr unsigned TABLE_BITS = N > 256 ? 7 : 6;
  static constexpr unsigned TABLE_SIZE = HAS_TABLE ? 1U << TABLE_BITS : 1;
  static constexpr unsigned TABLE_SHIFT = SYMBOL_BITS - TABLE_BITS;
  static constexpr unsigned PADDED = (N + GROUP - 1) / GROUP * GROUP + (HAS_TABLE ? GROUP : 0);
  static constexpr std::uint16_t NONE = 0xFFFF;  ///< begins behind all others

  void start();
  void update();

  std::uint32_t total_ = 0;
  std::uint16_t cycle_ = 0;         ///< symbols between updates
  std::uint16_t until_update_ = 0;  ///< symbols; 0 = not started
  std::uint16_t symbols_;
  std::uint16_t begin_[PADDED];
  std::uint16_t count_[N];
  std::uint16_t table_[TABLE_SIZE];  ///< the symbol at each multiple of 2^TABLE_SHIFT
};

inline void BitModel::update() {
  constexpr std::uint32_t MOST_COUNT = 1U << BITS;
  constexpr std::uint32_t MOST_CYCLE = 64;
  total += cycle;
  if (total > MOST_COUNT) {
    total = (total + 1) / 2;
    zeros = (zeros + 1) / 2;
    if (zeros == total) ++total;
  }
  zero_probability = (zeros * (0x80000000U / total)) >> (31 - BITS);
  cycle = std::min(cycle * 5 / 4, MOST_CYCLE);
  until_update = cycle;
}

template <unsigned N>
unsigned SymbolModel<N>::find(std::uint32_t scaled) const {
  const auto wanted = static_cast<std::uint16_t>(std::min(scaled, 0x7FFFU));
  if constexpr (HAS_TABLE) {
    unsigned from = table_[wanted >> TABLE_SHIFT];
    unsigned mask = at_most(begin_ + from, wanted);
    while (mask == 0xFFFF) [[unlikely]] {
        from += GROUP;
        mask = at_most(begin_ + from, wanted);
      }
    return from + static_cast<unsigned>(std::countr_one(mask)) - 1;
  }
  std::uint64_t mask = 0;
  for (unsigned i = 0; i < PADDED; i += GROUP) mask |= std::uint64_t{at_most(begin_ + i, wanted)} << i;
  return static_cast<unsigned>(std::countr_one(mask)) - 1;
}

template <unsigned N>
void SymbolModel<N>::start() {
  std::fill(std::begin(begin_), std::end(begin_), NONE);
  std::fill(std::begin(count_), std::end(count_), std::uint16_t{1});
  total_ = 0;
  cycle_ = symbols_;
  update();
  cycle_ = until_update_ = static_cast<std::uint16_t>((symbols_ + 6U) / 2);
}

template <unsigned N>
void SymbolModel<N>::update() {
  constexpr std::uint32_t MOST_COUNT = 1U << SYMBOL_BITS;
  total_ += cycle_;
  if (total_ > MOST_COUNT) {
    total_ = 0;
    for (unsigned i = 0; i < symbols_; ++i) {
      count_[i] = static_cast<std::uint16_t>((count_[i] + 1U) / 2);
      total_ += count_[i];
    }
  }
  const std::uint32_t scale = 0x80000000U / total_;
  std::uint32_t sum = 0;
  for (unsigned i = 0; i < symbols_; ++i) {
    begin_[i] = static_cast<std::uint16_t>((scale * sum) >> (31 - SYMBOL_BITS));
    sum += count_[i];
  }
  if constexpr (HAS_TABLE) {
    unsigned symbol = 0;
    for (unsigned i = 0; i < TABLE_SIZE; ++i) {
      while (begin_[symbol + 1] <= i << TABLE_SHIFT) ++symbol;
      table_[i] = static_cast<std::uint16_t>(symbol);
    }
  }
  const unsigned most_cycle = (symbols_ + 6U) * 8;
  cycle_ = static_cast<std::uint16_t>(std::min(cycle_ * 5U / 4, most_cycle));
  until_update_ = cycle_;
}

}  // namespace splatray
