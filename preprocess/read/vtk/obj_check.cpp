#include "preprocess/read/vtk/obj_check.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>

#include "preprocess/read/byte_reader.h"

namespace splatray {
namespace {

constexpr std::size_t MAX_LINE_BYTES = std::size_t{1} << 26U;

/// The next word of a line, empty at its end.
std::string_view next_word(std::string_view& line) {
  const std::size_t begin = line.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) {
    line = {};
    return {};
  }
  const std::size_t end = std::min(line.find_first_of(" \t\r", begin), line.size());
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

bool is_number(std::string_view word) {
  if (!word.empty() && word.front() == '+') {
    word.remove_prefix(1);
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error != std::errc::invalid_argument && end == word.data() + word.size();
}

class ObjScan {
 public:
  ObjScan(const std::filesystem::path& path, const ReadListener& listener) : in_(path, &listener) {}

  ObjCheck scan() {
    std::string_view line;
    std::string keyword;
    bool continued = false;
    while (in_.line(line, MAX_LINE_BYTES)) {
      ++line_number_;
      const bool continues = !line.empty() && line.back() == '\\';
      line.remove_suffix(continues ? 1 : 0);
      if (!continued) {
        keyword = next_word(line);
      }
      read_words(keyword, line);
      continued = continues;
    }
    for (std::size_t kind = 0; kind < 3; ++kind) {
      if (highest_[kind] > counts_[kind]) {
        line_number_ = highest_line_[kind];
        fail_index(kind, std::to_string(highest_[kind]));
      }
    }
    return result_;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw_unreadable(in_.path(), "line " + std::to_string(line_number_) + ": " + what);
  }

  [[noreturn]] void fail_index(std::size_t kind, const std::string& found) const {
    static const std::array<const char*, 3> KINDS{"vertices", "texture coordinates", "normals"};
    fail("found index " + found + ", the file has " + std::to_string(counts_[kind]) + " " + KINDS[kind]);
  }

  void read_words(const std::string& keyword, std::string_view line) {
    if (keyword == "v") {
      read_vertex(line);
    } else if (keyword == "vt") {
      ++counts_[1];
    } else if (keyword == "vn") {
      ++counts_[2];
    } else if (keyword == "f" || keyword == "l" || keyword == "p") {
      for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) {
        read_corner(word);
      }
    }
  }

  void read_vertex(std::string_view line) {
    int numbers = 0;
    for (std::string_view word = next_word(line); is_number(word); word = next_word(line)) {
      ++numbers;
    }
    if (numbers < 3) {
      fail("found a vertex of " + std::to_string(numbers) + " numbers, expected 3");
    }
    ++counts_[0];
    result_.has_vertex_colors = result_.has_vertex_colors || numbers >= 6;
  }

  /// "v", "v/t", "v//n" or "v/t/n"; negative indices count back from the last one read.
  void read_corner(std::string_view corner) {
    for (std::size_t kind = 0; kind < 3; ++kind) {
      const std::size_t slash = corner.find('/');
      const std::string_view digits = corner.substr(0, slash);
      if (!digits.empty()) {
        check_index(kind, digits);
      } else if (kind == 0) {
        fail("found a corner without a vertex index");
      }
      if (slash == std::string_view::npos) {
        return;
      }
      corner.remove_prefix(slash + 1);
    }
    fail("found a corner of more than three indices");
  }

  void check_index(std::size_t kind, std::string_view digits) {
    std::int64_t index = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
    if (error != std::errc{} || end != digits.data() + digits.size()) {
      fail("found '" + std::string(digits.substr(0, 20)) + "', expected an index");
    }
    if (index == 0 || index < -counts_[kind]) {
      fail_index(kind, std::to_string(index));
    }
    if (index > highest_[kind]) {
      highest_[kind] = index;
      highest_line_[kind] = line_number_;
    }
  }

  ByteReader in_;
  ObjCheck result_;
  std::uint64_t line_number_ = 0;
  std::array<std::int64_t, 3> counts_{};   ///< vertices, texture coordinates, normals so far
  std::array<std::int64_t, 3> highest_{};  ///< greatest index used of each
  std::array<std::uint64_t, 3> highest_line_{};
};

}  // namespace

ObjCheck check_obj(const std::filesystem::path& path, const ReadListener& listener) {
  return ObjScan(path, listener).scan();
}

}  // namespace splatray
