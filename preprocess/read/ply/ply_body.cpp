#include "preprocess/read/ply/ply_body.h"

#include <algorithm>

#include "preprocess/read/text/parse_number.h"

namespace splatray {
namespace {

/// Longest ASCII row; a list of many indices may stand on one line.
constexpr std::size_t MAX_ROW_BYTES = std::size_t{1} << 26U;

void drop_blanks(std::string_view& text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t' || text.front() == '\r')) {
    text.remove_prefix(1);
  }
}

}  // namespace

void PlyBody::fail(const std::string& what) const {
  const std::string place =
      is_ascii() ? "line " + std::to_string(line_count_) : "byte offset " + std::to_string(in_.offset());
  throw_unreadable(in_.path(), place + ": " + what);
}

void PlyBody::begin_row() {
  drop_blanks(line_);
  begins_mid_line_ = !line_.empty();
  has_packed_rows_ = has_packed_rows_ || begins_mid_line_;
}

/// Whether the row is whole. One before others that ends where the file does may have lost digits.
bool PlyBody::end_row(bool is_last) {
  drop_blanks(line_);
  const bool is_cut = is_ascii() && !is_last && line_.empty() && in_.line_is_open() && in_.remaining() == 0;
  has_ended_ = has_ended_ || is_cut;
  return !has_ended_;
}

void PlyBody::finish() {
  if (!is_ascii() || has_ended_) return;
  begin_row();
  const bool is_left = begins_mid_line_;
  begins_mid_line_ = false;
  if (is_left || (has_packed_rows_ && !ascii_word().empty()))
    fail("numbers follow the last row, expected as many as the header has rows and properties");
}

/// Rows of twice the numbers that a line has would take two lines each, and be half as many as there are lines.
void PlyBody::check_cut(const PlyElement& element, std::uint64_t rows) const {
  const std::uint64_t lines = line_count_ - first_line_;
  if (is_ascii() && rows > 0 && rows < lines && lines == element.count)
    fail("found a line for each of " + std::to_string(lines) + " rows of element '" + element.name +
         "' with less numbers than the header has properties, expected as many");
}

std::uint64_t PlyBody::most_rows(const PlyElement& element) const {
  const std::uint64_t row_bytes = element.min_row_bytes(format_);
  const std::uint64_t left = in_.remaining() + line_.size() + (is_ascii() ? 1 : 0);
  return row_bytes == 0 ? element.count : std::min(element.count, left / row_bytes);
}

/// The next word, on whichever line; empty where the file ends.
std::string_view PlyBody::ascii_word() {
  for (drop_blanks(line_); line_.empty() && !has_ended_; drop_blanks(line_)) {
    if (begins_mid_line_ && in_.remaining() > 0)
      fail("the line ends within a row that begins behind another, expected whole rows on it");
    has_ended_ = !in_.line(line_, MAX_ROW_BYTES);
    if (has_ended_) line_ = {};
    line_count_ += has_ended_ ? 0 : 1;
    if (line_.size() == MAX_ROW_BYTES) fail("found a line of more than 64 MiB, expected shorter ones");
  }
  const std::size_t length = std::min(line_.find_first_of(" \t"), line_.size());
  const std::string_view word = line_.substr(0, length);
  line_.remove_prefix(length);
  return word;
}

double PlyBody::ascii_number() {
  const std::string_view word = ascii_word();
  double value = 0.0;
  const char* const end = word.data() + word.size();
  if (!word.empty() && parse_number(word.data(), end, value) != end) fail(no_number(word));
  return value;
}

double PlyBody::number(PlyType type) {
  if (is_ascii()) {
    return ascii_number();
  }
  const unsigned char* bytes = has_ended_ ? nullptr : in_.take(ply_type_bytes(type));
  has_ended_ = bytes == nullptr;
  if (has_ended_) return 0.0;
  return with_ply_type(
      type, [&](auto kind) { return static_cast<double>(load_ply_value<decltype(kind)>(bytes, swaps())); });
}

std::uint64_t PlyBody::list_length(const PlyProperty& list) {
  const double length = number(list.count_type);
  if (!(length >= 0.0)) fail("found a list '" + list.name + "' of " + std::to_string(length) + " entries");
  const double left = static_cast<double>(in_.remaining() + line_.size()) + 1.0;
  has_ended_ = has_ended_ || length * static_cast<double>(is_ascii() ? 2 : ply_type_bytes(list.type)) > left;
  return has_ended_ ? 0 : static_cast<std::uint64_t>(length);
}

void PlyBody::skip(const PlyProperty& property) {
  const std::uint64_t count = property.is_list ? list_length(property) : 1;
  if (!is_ascii()) {
    has_ended_ = has_ended_ || !in_.skip(count * ply_type_bytes(property.type));
    return;
  }
  for (std::uint64_t i = 0; i < count && !has_ended_; ++i) static_cast<void>(ascii_word());
}

}  // namespace splatray
