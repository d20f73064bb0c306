/// The values of a PLY file's body, one after another, in any of its three formats.
#pragma once
#include <algorithm>
#include <bit>
#include <cstring>
#include <string>
#include <string_view>

#include "preprocess/read/byte_reader.h"
#include "preprocess/read/ply/ply_header.h"

namespace splatray {

static_assert(std::endian::native == std::endian::little, "the swap of big-endian files assumes this");

/// One binary value at any address; `swap` for big-endian files.
template <class T>
[[nodiscard]] T load_ply_value(const unsigned char* bytes, bool swap) {
  unsigned char ordered[sizeof(T)];
  std::memcpy(ordered, bytes, sizeof(T));
  if (swap) {
    std::reverse(ordered, ordered + sizeof(T));
  }
  T value;
  std::memcpy(&value, ordered, sizeof(T));
  return value;
}

/// Calls `body` with a value of the C++ type that `type` names.
template <class Body>
decltype(auto) with_ply_type(PlyType type, Body&& body) {
  switch (type) {
    case PlyType::int8:
      return body(std::int8_t{});
    case PlyType::uint8:
      return body(std::uint8_t{});
    case PlyType::int16:
      return body(std::int16_t{});
    case PlyType::uint16:
      return body(std::uint16_t{});
    case PlyType::int32:
      return body(std::int32_t{});
    case PlyType::uint32:
      return body(std::uint32_t{});
    case PlyType::float32:
      return body(float{});
    case PlyType::float64:
      break;
  }
  return body(double{});
}

/// Reads rows value by value. Every failure is an Error (input_unreadable) with the line (ASCII) or byte
/// offset (binary).
class PlyBody {
 public:
  PlyBody(ByteReader& in, const PlyHeader& header)
      : in_(in), format_(header.format), line_count_(header.line_count) {}

  /// Starts the next row; ASCII: a row is a line, blank lines are skipped.
  void begin_row();
  /// The next value of the row.
  [[nodiscard]] double number(PlyType type);
  /// The next value, a list's length, checked against what is left of the file.
  [[nodiscard]] std::uint64_t list_length(const PlyProperty& list);
  /// Ends the row; ASCII: nothing may be left on the line.
  void end_row();
  /// Reads over a property of any kind.
  void skip(const PlyProperty& property);

  [[nodiscard]] bool is_ascii() const { return format_ == PlyFormat::ascii; }
  [[nodiscard]] bool swaps() const { return format_ == PlyFormat::binary_big_endian; }
  [[nodiscard]] ByteReader& bytes() { return in_; }
  [[nodiscard]] const std::filesystem::path& path() const { return in_.path(); }
  [[nodiscard]] std::uint64_t remaining() const { return in_.remaining(); }
  /// Throws with the place.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  [[nodiscard]] double ascii_number();

  ByteReader& in_;
  PlyFormat format_;
  std::uint64_t line_count_;
  std::string_view line_;
};

}  // namespace splatray
