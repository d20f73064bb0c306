/// Colours as LASzip codes them.
#pragma once
#include <array>
#include <cstdint>

#include "preprocess/read/las/laz/arithmetic_decoder.h"

namespace splatray {

using StoredRgb = std::array<std::uint16_t, 3>;

/// Colours by bytes that differ from the last colour's; green and blue are predicted from how red changed
/// (M. Isenburg, LASzip, 2013; item versions 2 to 4).
class RgbModels {
 public:
  void reset();
  /// Replaces the last colour by the next.
  void read(ArithmeticDecoder& in, StoredRgb& color);

 private:
  SymbolModel<128> changed_;
  std::array<SymbolModel<256>, 6> difference_;  ///< red low, red high, green low, ...
};

}  // namespace splatray
