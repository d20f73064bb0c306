/// The stream of one field's values, over all packets.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "preprocess/read/e57/description.h"

namespace splatray {

/// Takes the bytes of packets and gives values. A value may begin in one packet and end in the next.
class FieldStream {
 public:
  explicit FieldStream(const E57Field& field) : field_(field) {}

  void append(std::span<const unsigned char> bytes);
  /// Values that are there. Only for fields with bits.
  [[nodiscard]] std::uint64_t available() const { return (8 * std::uint64_t{size_} - bit_) / field_.bits; }
  /// Decodes the next `count` values, which must be there.
  void decode(std::size_t count, double* values);

 private:
  static constexpr std::size_t PADDING = 8;  ///< bytes behind the last that may be loaded, not used

  const E57Field& field_;
  std::vector<unsigned char> bytes_;  ///< size_ of them and PADDING
  std::size_t size_ = 0;
  std::uint64_t bit_ = 0;  ///< the first that is not decoded
};

}  // namespace splatray
