#include "preprocess/read/read_stl.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "preprocess/base/lower_case.h"
#include "preprocess/mesh/mesh_normals.h"
#include "preprocess/read/bytes/byte_reader.h"
#include "preprocess/read/float_precision.h"
#include "preprocess/read/text/next_word.h"
#include "preprocess/read/text/parse_number.h"

namespace splatray {
namespace {

constexpr std::uint64_t STL_HEADER_BYTES = 84;
constexpr std::size_t TRIANGLE_BYTES = 50;  ///< normal, three corners, a word of attributes
constexpr std::size_t NORMAL_BYTES = 12;
constexpr std::size_t MOST_STL_LINE_BYTES = 65536;  ///< that are read at once

std::uint64_t declared_bytes(const unsigned char* header) {
  std::uint32_t count = 0;
  std::memcpy(&count, header + 80, sizeof count);
  return STL_HEADER_BYTES + TRIANGLE_BYTES * std::uint64_t{count};
}

/// ASCII files begin with "solid", in any encoding, as some binary ones do; those have the size that they declare.
bool is_ascii(const std::filesystem::path& path) {
  ByteReader in(path);
  const std::uint64_t size = in.remaining();
  const auto length = static_cast<std::size_t>(std::min(size, STL_HEADER_BYTES));
  const unsigned char* bytes = in.take(length);
  std::string start(reinterpret_cast<const char*>(bytes), length);
  std::erase_if(start, [](char c) { return c == '\0' || static_cast<unsigned char>(c) > 127; });
  return lower_case(start).starts_with("solid") &&
         (length < STL_HEADER_BYTES || size != declared_bytes(bytes));
}

/// How many triangles a binary file has: at least as many as it says. More are read where whole triangles follow these, and noted.
std::uint64_t count_triangles(const std::filesystem::path& path, std::uint64_t size, std::uint64_t declared,
                              const ReadListener& listener) {
  const std::uint64_t said = (declared - STL_HEADER_BYTES) / TRIANGLE_BYTES;
  if (size < declared)
    throw_unreadable(path, "found " + std::to_string(size) + " bytes, expected " + std::to_string(declared) +
                               " for the " + std::to_string(said) + " triangles of a binary STL");
  const std::uint64_t more = size - declared;
  if (more == 0) return said;
  if (more % TRIANGLE_BYTES != 0) {
    listener.note(path, "the " + std::to_string(more) + " bytes behind its " + std::to_string(said) +
                            " triangles are no triangles and were left out");
    return said;
  }
  listener.note(path, "it says " + std::to_string(said) + " triangles, and " +
                          std::to_string(more / TRIANGLE_BYTES) + " more follow; all were read");
  return said + more / TRIANGLE_BYTES;
}

/// Three corners for each triangle.
std::vector<glm::dvec3> read_binary(const std::filesystem::path& path, const ReadListener& listener) {
  ByteReader in(path, &listener);
  const std::uint64_t size = in.remaining();
  const unsigned char* header = size < STL_HEADER_BYTES ? nullptr : in.take(STL_HEADER_BYTES);
  const std::uint64_t count =
      count_triangles(path, size, header == nullptr ? STL_HEADER_BYTES : declared_bytes(header), listener);
  std::vector<glm::dvec3> corners;
  corners.reserve(3 * static_cast<std::size_t>(count));
  bool has_attributes = false;
  for (std::uint64_t i = 0; i < count; ++i) {
    const unsigned char* bytes = in.take(TRIANGLE_BYTES);
    if (bytes == nullptr) {
      throw_unreadable(path, "it could not be read to its end");
    }
    float values[9];
    std::memcpy(values, bytes + NORMAL_BYTES, sizeof values);
    for (int corner = 0; corner < 3; ++corner) {
      corners.emplace_back(values[3 * corner], values[3 * corner + 1], values[3 * corner + 2]);
    }
    has_attributes = has_attributes || bytes[TRIANGLE_BYTES - 2] != 0 || bytes[TRIANGLE_BYTES - 1] != 0;
  }
  if (has_attributes) listener.note(path, "skipped its triangles' attributes, which may be colours");
  return corners;
}

/// Words of an ASCII file, on any lines; of those only `vertex` and the ends of facets matter.
class AsciiStl {
 public:
  AsciiStl(const std::filesystem::path& path, const ReadListener& listener) : in_(path, &listener) {}

  std::vector<glm::dvec3> read() {
    while (read_text()) {
      std::string_view text = text_;
      const std::string_view first = next_word(text);
      if (!is_inside_ && !first.empty() && !is_keyword(first))
        fail("found '" + std::string(first.substr(0, 20)) +
             "', expected a word of STL such as facet or vertex");
      bool is_name = false;
      for (std::string_view word = first; !word.empty(); word = next_word(text)) {
        if (is_name && word != "facet") continue;
        is_name = word == "solid" || word == "endsolid";
        if (word == "vertex") corners_.push_back(read_corner(text));
        if (word == "endfacet") end_facet();
      }
    }
    if (corners_.size() != 3 * facets_) {
      fail("the file ends within a facet");
    }
    return std::move(corners_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw_unreadable(in_.path(), "line " + std::to_string(line_number_) + ": " + what);
  }

  static bool is_keyword(std::string_view word) {
    const std::string_view known[] = {"solid", "facet", "outer", "vertex", "endloop", "endfacet", "endsolid"};
    return std::find(std::begin(known), std::end(known), word) != std::end(known);
  }

  /// Reads the next line, in lower case, or of a long one a part with whole facets; false at the end.
  bool read_text() {
    constexpr std::string_view FACETS_END = "endfacet";
    std::string_view more;
    is_inside_ = !rest_.empty();
    if (!in_.line(more, MOST_STL_LINE_BYTES)) return false;
    line_number_ += is_inside_ ? 0 : 1;
    text_ = std::exchange(rest_, "") + lower_case(std::string(more));
    if (!in_.line_is_open() || in_.remaining() == 0) return true;
    const std::size_t end = text_.rfind(FACETS_END);
    if (end == std::string::npos || end == 0)
      fail("found more than " + std::to_string(MOST_STL_LINE_BYTES) + " bytes without the end of a facet");
    rest_ = text_.substr(end);
    text_.resize(end);
    return true;
  }

  /// The three numbers that the text begins with, which are taken from it.
  glm::dvec3 read_corner(std::string_view& text) const {
    glm::dvec3 corner{0.0};
    for (int axis = 0; axis < 3; ++axis) {
      std::string_view word = next_word(text);
      word.remove_prefix(word.starts_with('+') ? 1 : 0);
      double value = 0.0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error != std::errc{} || end != word.data() + word.size()) {
        fail("of a vertex's three numbers, " + no_number(word));
      }
      corner[axis] = static_cast<float>(value);
    }
    return corner;
  }

  void end_facet() {
    ++facets_;
    if (corners_.size() != 3 * facets_) {
      fail("found a facet that has not three vertices");
    }
  }

  ByteReader in_;
  std::uint64_t line_number_ = 0;
  std::string text_;
  std::string rest_;        ///< of the line, behind `text_`
  bool is_inside_ = false;  ///< `text_` does not begin a line
  std::size_t facets_ = 0;
  std::vector<glm::dvec3> corners_;
};

/// The mesh of triangles that share equal corners.
Mesh joined(std::vector<glm::dvec3> corners) {
  const std::vector<glm::uint> weld = weld_positions(corners);
  std::vector<glm::uint> index(corners.size());
  Mesh mesh;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (weld[i] == i) {
      index[i] = static_cast<glm::uint>(mesh.vertices.position.size());
      mesh.vertices.position.push_back(corners[i]);
    } else {
      index[i] = index[weld[i]];
    }
  }
  mesh.triangles.reserve(corners.size() / 3);
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    const glm::uvec3 triangle(index[i], index[i + 1], index[i + 2]);
    if (triangle.x != triangle.y && triangle.y != triangle.z && triangle.z != triangle.x) {
      mesh.triangles.push_back(triangle);
    }
  }
  return mesh;
}

}  // namespace

Mesh read_stl(const std::filesystem::path& path, const ReadListener& listener) {
  std::vector<glm::dvec3> corners =
      is_ascii(path) ? AsciiStl(path, listener).read() : read_binary(path, listener);
  if (corners.size() > 0xFFFFFFFFU) {
    throw_unreadable(
        path, "found " + std::to_string(corners.size() / 3) + " triangles, expected at most 1431655765");
  }
  Mesh mesh = joined(std::move(corners));
  note_float_precision(mesh.vertices, path, listener);
  return mesh;
}

}  // namespace splatray
