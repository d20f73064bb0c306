/// Parts of a point's record that LASzip codes one after another, point by point (formats 0 to 5).
#pragma once
#include <cstddef>
#include <memory>

#include "preprocess/read/las/laz/arithmetic_decoder.h"

namespace splatray {

/// Decodes one part of each record. What LASzip calls an item (M. Isenburg, LASzip, 2013).
class PointwiseItem {
 public:
  PointwiseItem() = default;
  PointwiseItem(const PointwiseItem&) = delete;
  PointwiseItem& operator=(const PointwiseItem&) = delete;
  virtual ~PointwiseItem() = default;

  /// Begins a chunk, with the bytes that this part has in its first record.
  virtual void start(const unsigned char* first) = 0;
  /// Writes the bytes of the next record.
  virtual void read(ArithmeticDecoder& in, unsigned char* bytes) = 0;
};

/// Position, intensity, returns, class, angle, user data, source: 20 bytes. `version` is 1 or 2.
[[nodiscard]] std::unique_ptr<PointwiseItem> make_point10(unsigned version);
/// GPS time: 8 bytes.
[[nodiscard]] std::unique_ptr<PointwiseItem> make_gps_time11(unsigned version);
/// Red, green, blue: 6 bytes.
[[nodiscard]] std::unique_ptr<PointwiseItem> make_rgb12(unsigned version);
/// A pointer into waveform data: 29 bytes.
[[nodiscard]] std::unique_ptr<PointwiseItem> make_wavepacket13();
/// Extra bytes, `count` > 0.
[[nodiscard]] std::unique_ptr<PointwiseItem> make_bytes(unsigned version, std::size_t count);

}  // namespace splatray
