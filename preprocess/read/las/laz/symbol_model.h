/// Adaptive probabilities of symbols for arithmetic decoding.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace splatray {

/// How probabilities are scaled: 2^15 is certain (A. Said, Introduction to Arithmetic Coding, HPL-2004-76, 2004).
inline constexpr unsigned SYMBOL_BITS = 15;

/// Of a bit: A. Said's adaptive binary model with LASzip's constants (M. Isenburg, LASzip, 2013).
struct BitModel {
  static constexpr unsigned BITS = 13;  ///< probabilities are of 2^13

  std::uint32_t zeros = 1;
  std::uint32_t total = 2;
  std::uint32_t zero_probability = 1U << (BITS - 1);
  std::uint32_t cycle = 4;         ///< bits between updates
  std::uint32_t until_update = 4;  ///< bits

  void update();
};

/// Of up to N symbols: A. Said's adaptive model, searched in two steps of up to 16 groups of 16 without branches.
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
  [[nodiscard]] unsigned find(std::uint32_t scaled) const;
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
  static constexpr unsigned GROUPS = (N + GROUP - 1) / GROUP;
  static constexpr unsigned PADDED_GROUPS = (GROUPS + GROUP - 1) / GROUP * GROUP;
  static constexpr std::uint16_t NONE = 0xFFFF;  ///< begins behind all others

  void start();
  void update();

  std::uint16_t begin_[GROUPS * GROUP];
  std::uint16_t group_begin_[PADDED_GROUPS];
  std::uint16_t count_[N];
  std::uint32_t total_ = 0;
  std::uint16_t cycle_ = 0;         ///< symbols between updates
  std::uint16_t until_update_ = 0;  ///< symbols; 0 = not started
  std::uint16_t symbols_;
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
  unsigned group = 0;
  if constexpr (GROUPS > 1) {
    std::uint16_t groups = 0;
    for (std::uint16_t begin : group_begin_)
      groups = static_cast<std::uint16_t>(groups + (begin <= wanted ? 1 : 0));
    group = (groups - 1U) * GROUP;
  }
  std::uint16_t found = 0;
  for (unsigned i = 0; i < GROUP; ++i)
    found = static_cast<std::uint16_t>(found + (begin_[group + i] <= wanted ? 1 : 0));
  return group + found - 1U;
}

template <unsigned N>
void SymbolModel<N>::start() {
  std::fill(std::begin(begin_), std::end(begin_), NONE);
  std::fill(std::begin(group_begin_), std::end(group_begin_), NONE);
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
  for (unsigned group = 0; group * GROUP < symbols_; ++group) group_begin_[group] = begin_[group * GROUP];
  const unsigned most_cycle = (symbols_ + 6U) * 8;
  cycle_ = static_cast<std::uint16_t>(std::min(cycle_ * 5U / 4, most_cycle));
  until_update_ = cycle_;
}

}  // namespace splatray
