/// GPS times as LASzip codes them.
#pragma once
#include <array>
#include <cstdint>

#include "preprocess/read/las/laz/integer_decoder.h"

namespace splatray {

/// Times as integers of their bits, predicted from up to four sequences that take turns: by multiples of the last
/// difference (M. Isenburg, LASzip, 2013; item versions 2 to 4).
class GpsTimes {
 public:
  /// `says_unchanged`: a code stands for "as before" (version 2); else it is said elsewhere (versions 3 and 4).
  explicit GpsTimes(bool says_unchanged);

  /// Begins with the bits of a first time.
  void start(std::uint64_t first);
  /// The bits of the next time.
  [[nodiscard]] std::uint64_t read(ArithmeticDecoder& in);

 private:
  struct Sequence {
    std::uint64_t time = 0;
    std::int32_t difference = 0;
    unsigned extremes = 0;  ///< differences since the last that were no small multiple
  };

  unsigned read_code(ArithmeticDecoder& in);
  void read_near(ArithmeticDecoder& in, unsigned multiple);
  void read_far(ArithmeticDecoder& in);

  bool says_unchanged_;
  SymbolModel<516> multiple_;
  SymbolModel<6> after_zero_;
  IntegerDecoder<32, 9> difference_;
  std::array<Sequence, 4> sequences_;
  unsigned current_ = 0;
  unsigned newest_ = 0;
};

}  // namespace splatray
