/// The values of a PLY file's body, one after another, in any of its three formats.
#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <string>
#include <string_view>

#include "preprocess/read/bytes/byte_reader.h"
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

/// A float of 16 bits (IEEE 754 binary16) as it is stored.
struct PlyHalf {
  std::uint16_t bits = 0;

  template <class Number>
  explicit operator Number() const {
    return static_cast<Number>(glm::unpackHalf1x16(bits));
  }
};

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
    case PlyType::int64:
      return body(std::int64_t{});
    case PlyType::uint64:
      return body(std::uint64_t{});
    case PlyType::float16:
      return body(PlyHalf{});
    case PlyType::float32:
      return body(float{});
    case PlyType::float64:
    case PlyType::other:  // in ASCII files alone, whose numbers are float64
      break;
  }
  return body(double{});
}

/// Reads rows value by value. The numbers of ASCII files may stand on any lines, as long as a line holds whole rows or a row
/// begins on a line of its own. What is wrong is an Error (input_unreadable) with the line (ASCII) or byte offset (binary);
/// where the file ends, values are 0, lists are empty, and end_row() says so.
class PlyBody {
 public:
  PlyBody(ByteReader& in, const PlyHeader& header)
      : in_(in), format_(header.format), line_count_(header.line_count) {}

  /// Reads at most `element.count` rows: `read_row` reads all values of one. How many the file has; `read_row` was called for
  /// one more where that is less, and the row's values are to be dropped.
  template <class ReadRow>
  std::uint64_t read_rows(const PlyElement& element, const ReadRow& read_row) {
    first_line_ = line_count_;
    for (std::uint64_t row = 0; row < element.count; ++row) {
      begin_row();
      read_row();
      if (!end_row(row + 1 == element.count)) return check_cut(element, row), row;
    }
    return element.count;
  }

  /// The next value of the row.
  [[nodiscard]] double number(PlyType type);
  /// The next value, a list's length; 0 where less than such a list is left of the file.
  [[nodiscard]] std::uint64_t list_length(const PlyProperty& list);
  /// To be called behind all elements: numbers that are left where lines hold more than one row are none of a row.
  void finish();
  /// Reads over a property of any kind; in ASCII files it may be any word.
  void skip(const PlyProperty& property);

  [[nodiscard]] bool is_ascii() const { return format_ == PlyFormat::ascii; }
  [[nodiscard]] bool swaps() const { return format_ == PlyFormat::binary_big_endian; }
  [[nodiscard]] ByteReader& bytes() { return in_; }
  [[nodiscard]] const std::filesystem::path& path() const { return in_.path(); }
  /// The most rows of an element that what is left of the file can hold, at most as many as it declares: for what is
  /// reserved for them.
  [[nodiscard]] std::uint64_t most_rows(const PlyElement& element) const;
  /// Throws with the place.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  [[nodiscard]] std::string_view ascii_word();
  [[nodiscard]] double ascii_number();
  void begin_row();
  [[nodiscard]] bool end_row(bool is_last);
  void check_cut(const PlyElement& element, std::uint64_t rows) const;

  ByteReader& in_;
  PlyFormat format_;
  std::uint64_t line_count_;
  std::string_view line_;  ///< what is left of it
  bool has_ended_ = false;
  std::uint64_t first_line_ = 0;  ///< before the element
  bool begins_mid_line_ = false;  ///< the row
  bool has_packed_rows_ = false;  ///< some row did
};

}  // namespace splatray
