#include "preprocess/read/las/laz/gps_time.h"

#include "preprocess/base/little_endian.h"
#include "preprocess/read/las/laz/pointwise_item.h"

namespace splatray {
namespace {

constexpr unsigned MOST_MULTIPLE = 500;
constexpr int LEAST_MULTIPLE = -10;
constexpr unsigned UNCHANGED = MOST_MULTIPLE - LEAST_MULTIPLE + 1;  ///< codes after the multiples
constexpr unsigned FAR_CASE = UNCHANGED + 1;                        ///< and behind it the other sequences
constexpr unsigned CODES = FAR_CASE + 4;

std::int32_t times(int multiple, std::int32_t difference) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(multiple) *
                                   static_cast<std::uint32_t>(difference));
}

/// Version 1: one sequence.
class GpsTime11V1 final : public PointwiseItem {
 public:
  void start(const unsigned char* first) override {
    time_ = load<std::uint64_t>(first);
    last_difference_ = 0;
    extremes_ = 0;
    multiple_.reset();
    after_zero_.reset();
    difference_.reset();
  }

  void read(ArithmeticDecoder& in, unsigned char* bytes) override {
    constexpr unsigned FAR_AFTER_ZERO = 2;
    if (last_difference_ == 0) {
      const unsigned code = in.symbol(after_zero_);
      if (code == 1) {
        last_difference_ = difference_.read(in, 0, 0);
        advance(last_difference_);
      }
      if (code == FAR_AFTER_ZERO) time_ = in.bits64();
    } else {
      read_multiple(in, in.symbol(multiple_));
    }
    store(bytes, time_);
  }

 private:
  static constexpr unsigned MULTIPLES = 512;

  void advance(std::int32_t difference) { time_ += static_cast<std::uint64_t>(std::int64_t{difference}); }

  void read_multiple(ArithmeticDecoder& in, unsigned code) {
    constexpr unsigned UNCHANGED_CODE = MULTIPLES - 1;
    constexpr unsigned FAR_CODE = MULTIPLES - 2;
    constexpr unsigned GREATEST = MULTIPLES - 3;
    constexpr unsigned MOST_EXTREMES = 3;
    if (code == UNCHANGED_CODE) return;
    if (code == FAR_CODE) {
      time_ = in.bits64();
      return;
    }
    const std::int32_t predicted =
        code == 0 ? last_difference_ / 4 : times(static_cast<int>(code), last_difference_);
    const unsigned context = code == 0 ? 2 : code == 1 ? 1 : code < 10 ? 3 : code < 50 ? 4 : 5;
    const std::int32_t difference = difference_.read(in, predicted, context);
    advance(difference);
    if (code == 0 || code == GREATEST) ++extremes_;
    if (code == 1 || extremes_ > MOST_EXTREMES) {
      last_difference_ = difference;
      extremes_ = 0;
    }
  }

  std::uint64_t time_ = 0;
  std::int32_t last_difference_ = 0;
  unsigned extremes_ = 0;
  SymbolModel<MULTIPLES> multiple_;
  SymbolModel<3> after_zero_;
  IntegerDecoder<32, 6> difference_;
};

class GpsTime11V2 final : public PointwiseItem {
 public:
  void start(const unsigned char* first) override { times_.start(load<std::uint64_t>(first)); }
  void read(ArithmeticDecoder& in, unsigned char* bytes) override { store(bytes, times_.read(in)); }

 private:
  GpsTimes times_{true};
};

}  // namespace

GpsTimes::GpsTimes(bool says_unchanged)
    : says_unchanged_(says_unchanged),
      multiple_(says_unchanged ? CODES : CODES - 1),
      after_zero_(says_unchanged ? 6 : 5) {}

void GpsTimes::start(std::uint64_t first) {
  multiple_.reset();
  after_zero_.reset();
  difference_.reset();
  sequences_ = {};
  sequences_[0].time = first;
  current_ = newest_ = 0;
}

/// A code as version 2 has them when the last difference was not zero.
unsigned GpsTimes::read_code(ArithmeticDecoder& in) {
  const unsigned skipped = says_unchanged_ ? 0 : 1;
  if (sequences_[current_].difference != 0) {
    const unsigned code = in.symbol(multiple_);
    return code < UNCHANGED ? code : code + skipped;
  }
  const unsigned code = in.symbol(after_zero_) + skipped;
  return code == 0 ? UNCHANGED : code == 1 ? 1 : code - 2 + FAR_CASE;
}

std::uint64_t GpsTimes::read(ArithmeticDecoder& in) {
  constexpr int MOST_CHANGES = 4;  // of the sequence; coders need one
  for (int i = 0; i < MOST_CHANGES; ++i) {
    const unsigned code = read_code(in);
    if (code <= FAR_CASE) {
      if (code < UNCHANGED) read_near(in, code);
      if (code == FAR_CASE) read_far(in);
      return sequences_[current_].time;
    }
    current_ = (current_ + code - FAR_CASE) % sequences_.size();
  }
  in.set_damaged();
  return sequences_[current_].time;
}

void GpsTimes::read_near(ArithmeticDecoder& in, unsigned code) {
  constexpr unsigned MOST_EXTREMES = 3;
  Sequence& sequence = sequences_[current_];
  const bool is_first = sequence.difference == 0;
  const int multiple = code <= MOST_MULTIPLE ? static_cast<int>(code)
                                             : static_cast<int>(MOST_MULTIPLE) - static_cast<int>(code);
  unsigned context = 0;
  if (!is_first) {
    if (multiple == 0) context = 7;
    if (multiple == 1) context = 1;
    if (multiple > 1) context = multiple < 10 ? 2 : code < MOST_MULTIPLE ? 3 : 4;
    if (multiple < 0) context = multiple > LEAST_MULTIPLE ? 5 : 6;
  }
  const std::int32_t difference = difference_.read(in, times(multiple, sequence.difference), context);
  sequence.time += static_cast<std::uint64_t>(std::int64_t{difference});
  const bool is_extreme = code == 0 || code == MOST_MULTIPLE || multiple == LEAST_MULTIPLE;
  if (code == 1) sequence.extremes = 0;
  if (is_extreme) ++sequence.extremes;
  if (is_first || sequence.extremes > MOST_EXTREMES) {
    sequence.difference = difference;
    sequence.extremes = 0;
  }
}

void GpsTimes::read_far(ArithmeticDecoder& in) {
  constexpr unsigned CONTEXT = 8;
  const auto high = static_cast<std::int32_t>(sequences_[current_].time >> 32U);
  const auto coded = static_cast<std::uint32_t>(difference_.read(in, high, CONTEXT));
  newest_ = (newest_ + 1) % sequences_.size();
  current_ = newest_;
  sequences_[current_] = {(std::uint64_t{coded} << 32U) | in.bits(32), 0, 0};
}

std::unique_ptr<PointwiseItem> make_gps_time11(unsigned version) {
  if (version == 1) return std::make_unique<GpsTime11V1>();
  return std::make_unique<GpsTime11V2>();
}

}  // namespace splatray
