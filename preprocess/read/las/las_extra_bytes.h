/// Attributes that programs add to the records of LAS files (ASPRS, LAS Specification 1.4 R15, "Extra Bytes VLR").
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace splatray {

/// One number of a record, with a name.
struct LasExtraBytes {
  std::string name;    ///< as stored; of vectors with "[0]", "[1]", "[2]" behind
  unsigned type = 0;   ///< 1 to 10: u8, i8, u16, i16, u32, i32, u64, i64, float, double
  std::size_t at = 0;  ///< bytes from the record's begin
  double scale = 1.0;  ///< value = scale * number + offset
  double offset = 0.0;
  /// Several fields may share a u8: number = (byte >> shift) & mask.
  unsigned shift = 0, mask = 0xFF;

  /// Bytes of the number.
  [[nodiscard]] std::size_t bytes() const;
  /// Whether floats hold every value.
  [[nodiscard]] bool fits_float() const;
  /// The value in a record.
  [[nodiscard]] double value(const unsigned char* record) const;
  /// Whether values may be rounded as a double: of integers that a double does not hold.
  [[nodiscard]] bool may_be_rounded(double value) const;
};

/// The attributes that `descriptors` (192 bytes each, of all such records of a file) describe, in records whose extra bytes
/// begin at `begin`. Those that reach beyond the records' `end` are left out: the header's length rules.
[[nodiscard]] std::vector<LasExtraBytes> las_extra_bytes(std::span<const unsigned char> descriptors,
                                                         std::size_t begin, std::size_t end);

/// The extra bytes of a file that are read.
struct LasExtras {
  std::vector<LasExtraBytes> columns;  ///< that become columns of their names
  /// Those that mean x, y and z of a normal by their names (known_columns; "normal[0]" to "normal[2]", too); all three or nothing.
  std::optional<std::array<LasExtraBytes, 3>> normal;
  std::optional<LasExtraBytes> radius;  ///< "radius", world units
};

/// Normals, radii and those that `asked` names; a vector's name asks for all its components. What no extra bytes have may be a further
/// field of the records of this point format (las_further_fields.h).
[[nodiscard]] LasExtras chosen_extra_bytes(unsigned point_format, const std::vector<LasExtraBytes>& all,
                                           const std::vector<std::string>& asked);

}  // namespace splatray
