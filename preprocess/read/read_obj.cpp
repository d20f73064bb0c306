#include "preprocess/read/read_obj.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "preprocess/base/quoted_list.h"
#include "preprocess/read/bytes/byte_reader.h"
#include "preprocess/read/scan/stored_colors.h"
#include "preprocess/read/text/next_word.h"
#include "preprocess/read/text/parse_number.h"

namespace splatray {
namespace {

constexpr std::size_t MOST_OBJ_LINE_BYTES = std::size_t{1} << 26U;
constexpr std::int64_t MOST_ELEMENTS = 0xFFFFFFFF;  ///< indices have 32 bits

/// What corners have indices of, in the order of a corner's parts.
enum CornerPart : std::size_t { VERTEX, TEXCOORD, NORMAL, KINDS };

bool read_number(std::string_view word, double& value) {
  if (!word.empty() && word.front() == '+') {
    word.remove_prefix(1);
  }
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error != std::errc::invalid_argument && end == word.data() + word.size();
}

/// A face's corner: indices of its vertex and normal from 1, 0 = no normal.
struct FaceCorner {
  std::uint32_t vertex = 0;
  std::uint32_t normal = 0;
};

/// What the lines of the file say.
struct ObjContent {
  std::vector<glm::dvec3> position;
  std::vector<glm::vec3> color;  ///< as stored, beside `position` or shorter: the others have none
  std::vector<glm::vec3> normal;
  std::vector<std::array<FaceCorner, 3>> triangles;
  std::set<std::string> skipped;  ///< what is there and not read
};

class ObjReader {
 public:
  ObjReader(const std::filesystem::path& path, const ReadListener& listener) : in_(path, &listener) {}

  ObjContent read() {
    for (std::string_view line; next_statement(line);) {
      const std::string_view keyword = next_word(line);
      face_.clear();
      read_words(keyword, line);
    }
    for (std::size_t kind = 0; kind < KINDS; ++kind) {
      if (highest_[kind] > counts_[kind]) {
        line_number_ = highest_line_[kind];
        fail_index(kind, std::to_string(highest_[kind]));
      }
    }
    return std::move(content_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw_unreadable(in_.path(), "line " + std::to_string(line_number_) + ": " + what);
  }

  [[noreturn]] void fail_index(std::size_t kind, const std::string& found) const {
    static const std::array<const char*, KINDS> NAMES{"vertices", "texture coordinates", "normals"};
    fail("found index " + found + ", expected at most the file's " + std::to_string(counts_[kind]) + " " +
         NAMES[kind]);
  }

  bool next_line(std::string_view& line) {
    if (!in_.line(line, MOST_OBJ_LINE_BYTES)) return false;
    ++line_number_;
    return true;
  }

  /// Takes away a backslash at the line's end, behind which the next one continues it; whether there was one.
  static bool drop_backslash(std::string_view& line) {
    const std::size_t last = line.find_last_not_of(" \t");
    if (last == std::string_view::npos || line[last] != '\\') return false;
    line = line.substr(0, last);
    return true;
  }

  /// The next line with those that continue it. A comment ends with its own, as names of folders may end it.
  bool next_statement(std::string_view& line) {
    if (!next_line(line)) return false;
    if (line.starts_with('#') || !drop_backslash(line)) return true;
    statement_ = line;
    for (bool continues = true; continues && next_line(line);) {
      continues = drop_backslash(line);
      (statement_ += ' ') += line;
    }
    line = statement_;
    return true;
  }

  void count(CornerPart kind) {
    if (++counts_[kind] > MOST_ELEMENTS) fail("found more than 4294967295 vertices or normals");
  }

  void note_skipped(std::string_view keyword) {
    constexpr std::pair<std::string_view, const char*> NOT_READ[] = {
        {"usemtl", "materials"}, {"l", "lines"}, {"curv", "curves"}, {"surf", "curved surfaces"}};
    for (const auto& [word, what] : NOT_READ)
      if (keyword == word) content_.skipped.insert(what);
  }

  void read_words(std::string_view keyword, std::string_view line) {
    if (keyword.size() > 2 || keyword == "l") note_skipped(keyword);
    if (keyword == "v") {
      read_vertex(line);
    } else if (keyword == "vt") {
      count(TEXCOORD);
    } else if (keyword == "vn") {
      read_normal(line);
    } else if (keyword == "f" || keyword == "l" || keyword == "p") {
      for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) {
        const FaceCorner corner = read_corner(word);
        if (keyword == "f") add_corner(corner);
      }
    }
  }

  /// The numbers that the line begins with, at most as many as there is room for; three of them must be there.
  template <std::size_t MOST>
  std::size_t read_numbers(std::string_view line, std::array<double, MOST>& values, const char* what) const {
    for (std::size_t count = 0; count < MOST; ++count) {
      const std::string_view word = next_word(line);
      if (read_number(word, values[count])) continue;
      if (count < 3)
        fail("found a " + std::string(what) + " of " + std::to_string(count) + " numbers, expected 3" +
             (word.empty() ? "" : ": " + no_number(word)));
      return count;
    }
    return MOST;
  }

  void read_vertex(std::string_view line) {
    std::array<double, 6> values{};
    const std::size_t numbers = read_numbers(line, values, "vertex");
    count(VERTEX);
    if (numbers == 6) {
      content_.color.resize(content_.position.size(), glm::vec3(1.0F));
      content_.color.emplace_back(values[3], values[4], values[5]);
    }
    content_.position.emplace_back(values[0], values[1], values[2]);
  }

  void read_normal(std::string_view line) {
    std::array<double, 3> values{};
    static_cast<void>(read_numbers(line, values, "normal"));
    count(NORMAL);
    content_.normal.emplace_back(values[0], values[1], values[2]);
  }

  /// "v", "v/t", "v//n" or "v/t/n"; negative indices count back from the last one read.
  FaceCorner read_corner(std::string_view text) {
    std::array<std::uint32_t, KINDS> indices{};
    for (std::size_t kind = 0; kind < KINDS; ++kind) {
      const std::size_t slash = text.find('/');
      const std::string_view digits = text.substr(0, slash);
      if (!digits.empty()) {
        indices[kind] = read_index(kind, digits);
      } else if (kind == VERTEX) {
        fail("found a corner without a vertex index");
      }
      if (slash == std::string_view::npos) {
        return {indices[VERTEX], indices[NORMAL]};
      }
      text.remove_prefix(slash + 1);
    }
    fail("found a corner of more than three indices");
  }

  std::uint32_t read_index(std::size_t kind, std::string_view digits) {
    std::int64_t index = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
    if (error != std::errc{} || end != digits.data() + digits.size()) {
      fail("found '" + std::string(digits.substr(0, 20)) + "', expected an index");
    }
    if (index == 0 || index < -counts_[kind] || index > MOST_ELEMENTS) {
      fail_index(kind, std::to_string(index));
    }
    if (index > highest_[kind]) {
      highest_[kind] = index;
      highest_line_[kind] = line_number_;
    }
    return static_cast<std::uint32_t>(index > 0 ? index : counts_[kind] + 1 + index);
  }

  void add_corner(const FaceCorner& corner) {
    if (face_.size() == 2) {
      content_.triangles.push_back({face_[0], face_[1], corner});
      face_[1] = corner;
    } else {
      face_.push_back(corner);
    }
  }

  ByteReader in_;
  ObjContent content_;
  std::vector<FaceCorner> face_;  ///< first and last corner of the face that is read
  std::string statement_;         ///< of several lines
  std::uint64_t line_number_ = 0;
  std::array<std::int64_t, KINDS> counts_{};   ///< read so far
  std::array<std::int64_t, KINDS> highest_{};  ///< greatest index used of each; the file may have it later
  std::array<std::uint64_t, KINDS> highest_line_{};
};

/// Gives corners their normals: a vertex has that of its first corner, and a double for each further one.
class CornerJoiner {
 public:
  CornerJoiner(Points& vertices, const std::vector<glm::vec3>& normals)
      : vertices_(vertices), normals_(normals), first_(vertices.size(), UNUSED) {
    vertices_.normal.resize(vertices_.size(), glm::vec3(0.0F));
  }

  std::uint32_t index(const FaceCorner& corner) {
    std::uint32_t& first = first_[corner.vertex - 1];
    if (first == UNUSED) {
      first = corner.normal;
      vertices_.normal[corner.vertex - 1] = normal(corner);
    }
    if (first == corner.normal) return corner.vertex - 1;
    const auto next = static_cast<std::uint32_t>(vertices_.size());
    const auto [found, is_new] =
        doubles_.try_emplace(std::uint64_t{corner.vertex} << 32U | corner.normal, next);
    if (is_new) {
      vertices_.position.push_back(glm::dvec3(vertices_.position[corner.vertex - 1]));
      vertices_.normal.push_back(normal(corner));
      if (!vertices_.color.empty()) vertices_.color.push_back(glm::vec3(vertices_.color[corner.vertex - 1]));
    }
    return found->second;
  }

 private:
  static constexpr std::uint32_t UNUSED = 0xFFFFFFFF;

  [[nodiscard]] glm::vec3 normal(const FaceCorner& corner) const {
    return corner.normal == 0 ? glm::vec3(0.0F) : normals_[corner.normal - 1];
  }

  Points& vertices_;
  const std::vector<glm::vec3>& normals_;
  std::vector<std::uint32_t> first_;  ///< number of the normal that a vertex has
  std::unordered_map<std::uint64_t, std::uint32_t> doubles_;
};

}  // namespace

Mesh read_obj(const std::filesystem::path& path, const ReadListener& listener) {
  ObjContent content = ObjReader(path, listener).read();
  if (!content.skipped.empty())
    listener.note(path, "skipped " + quoted_list({content.skipped.begin(), content.skipped.end()}));
  Mesh mesh;
  Points& vertices = mesh.vertices;
  vertices.position = std::move(content.position);
  if (!content.color.empty()) {
    content.color.resize(vertices.size(), glm::vec3(1.0F));
    if (const std::string said = decode_colors(content.color); !said.empty()) listener.note(path, said);
    vertices.color = std::move(content.color);
  }
  mesh.triangles.reserve(content.triangles.size());
  if (content.normal.empty()) {
    for (const auto& [a, b, c] : content.triangles)
      mesh.triangles.emplace_back(a.vertex - 1, b.vertex - 1, c.vertex - 1);
  } else if (content.triangles.empty() && content.normal.size() == vertices.size()) {
    vertices.normal = std::move(content.normal);  // a point set: a normal for each vertex
  } else {
    CornerJoiner joiner(vertices, content.normal);
    for (const auto& [a, b, c] : content.triangles) {
      const glm::uint first = joiner.index(a), second = joiner.index(b), third = joiner.index(c);
      mesh.triangles.emplace_back(first, second, third);
    }
  }
  if (vertices.size() > MOST_ELEMENTS) throw_unreadable(path, "found more than 4294967295 vertices");
  return mesh;
}

}  // namespace splatray
