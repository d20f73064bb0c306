/// The header of a PLY file (Turk 1994, "The PLY Polygon File Format").
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "preprocess/read/bytes/byte_reader.h"

namespace splatray {

enum class PlyFormat { ascii, binary_little_endian, binary_big_endian };
/// `other`: of a name that is not known; in ASCII files alone, where it can be passed over.
enum class PlyType {
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  float16,
  float32,
  float64,
  other
};

/// Bytes of a value in a binary file; 0 of `other`.
[[nodiscard]] std::size_t ply_type_bytes(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;  ///< of the value, or of a list's entries
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  ///< of a list's length
};

struct PlyElement {
  std::string name;         ///< in lower case
  std::uint64_t count = 0;  ///< as declared: not to be trusted before min_row_bytes is checked
  std::vector<PlyProperty> properties;

  /// The least bytes a row takes in a file of this format.
  [[nodiscard]] std::uint64_t min_row_bytes(PlyFormat format) const;
  /// Index of a property, in any case, the one in the same case first; -1 when there is none.
  [[nodiscard]] int find(const std::string& property) const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;  ///< in file order
  std::vector<std::string> remarks;  ///< what follows `comment` and `obj_info`
  std::uint64_t line_count = 0;      ///< lines of the header, end_header included
};

/// Reads the header, whose keywords, types and names of elements may be in any case; `in` then stands on the first byte of
/// the body. Throws Error (input_unreadable) with the line.
[[nodiscard]] PlyHeader read_ply_header(ByteReader& in);

}  // namespace splatray
