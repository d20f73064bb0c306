#include "preprocess/read/ply/ply_body.h"

#include <charconv>
#include <cstdlib>

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
  if (!is_ascii()) {
    return;
  }
  do {
    if (!in_.line(line_, MAX_ROW_BYTES)) {
      fail("the file ends here, expected more rows");
    }
    ++line_count_;
    drop_blanks(line_);
  } while (line_.empty());
}

void PlyBody::end_row() {
  drop_blanks(line_);
  if (is_ascii() && !line_.empty()) {
    fail("found '" + std::string(line_.substr(0, 20)) +
         "' after the last property, expected the end of the line");
  }
}

double PlyBody::ascii_number() {
  drop_blanks(line_);
  if (line_.empty()) {
    fail("the line ends early, expected another number");
  }
  const std::size_t sign = line_.front() == '+' ? 1 : 0;
  double value = 0.0;
  const auto [end, error] = std::from_chars(line_.data() + sign, line_.data() + line_.size(), value);
  if (error == std::errc::result_out_of_range) {
    value = std::strtod(std::string(line_.data(), end).c_str(), nullptr);
  }
  const bool ends_well = end == line_.data() + line_.size() || *end == ' ' || *end == '\t' || *end == '\r';
  if (error == std::errc::invalid_argument || !ends_well) {
    fail("found '" + std::string(line_.substr(0, 20)) + "', expected a number");
  }
  line_.remove_prefix(static_cast<std::size_t>(end - line_.data()));
  return value;
}

double PlyBody::number(PlyType type) {
  if (is_ascii()) {
    return ascii_number();
  }
  const unsigned char* bytes = in_.take(ply_type_bytes(type));
  if (bytes == nullptr) {
    fail("the file ends here, expected more rows");
  }
  return with_ply_type(
      type, [&](auto kind) { return static_cast<double>(load_ply_value<decltype(kind)>(bytes, swaps())); });
}

std::uint64_t PlyBody::list_length(const PlyProperty& list) {
  const double length = number(list.count_type);
  const std::uint64_t left = is_ascii() ? line_.size() : in_.remaining();
  const std::uint64_t entry_bytes = is_ascii() ? 2 : ply_type_bytes(list.type);
  if (!(length >= 0.0) || length * static_cast<double>(entry_bytes) > static_cast<double>(left) + 1.0) {
    fail("found an impossible length of list '" + list.name + "', only " + std::to_string(left) +
         " bytes follow");
  }
  return static_cast<std::uint64_t>(length);
}

void PlyBody::skip(const PlyProperty& property) {
  const std::uint64_t count = property.is_list ? list_length(property) : 1;
  if (!is_ascii()) {
    if (!in_.skip(count * ply_type_bytes(property.type))) {
      fail("the file ends here, expected more rows");
    }
    return;
  }
  for (std::uint64_t i = 0; i < count; ++i) {
    static_cast<void>(ascii_number());
  }
}

}  // namespace splatray
