#include "preprocess/read/ply/read_ply.h"

#include <algorithm>

#include "engine/base/number_text.h"
#include "preprocess/base/quoted_list.h"
#include "preprocess/base/splat_marks.h"
#include "preprocess/read/ply/ply_gaussians.h"
#include "preprocess/read/ply/ply_scan.h"
#include "preprocess/read/ply/ply_vertices.h"

namespace splatray {
namespace {

/// Reads the element that holds triangles: polygons as fans, strips with -1 as restart.
class FaceReader {
 public:
  FaceReader(PlyBody& in, std::uint64_t vertex_count, bool strips, std::vector<glm::uvec3>& triangles)
      : in_(in), vertex_count_(vertex_count), strips_(strips), triangles_(triangles) {}

  /// How many rows there are.
  std::uint64_t read(const PlyElement& element, std::size_t list_index) {
    triangles_.reserve(triangles_.size() + in_.most_rows(element));
    std::size_t before = 0;  // the row
    const std::uint64_t rows = in_.read_rows(element, [&] {
      before = triangles_.size();
      for (std::size_t i = 0; i < element.properties.size(); ++i) {
        if (i == list_index) {
          read_list(element.properties[i]);
        } else {
          in_.skip(element.properties[i]);
        }
      }
    });
    if (rows < element.count) triangles_.resize(before);
    return rows;
  }

 private:
  glm::uint index(PlyType type) {
    const double value = in_.number(type);
    if (!(value >= 0.0 && value < static_cast<double>(vertex_count_))) {
      in_.fail("found a face that uses vertex " + number_text(value) + ", expected less than " +
               std::to_string(vertex_count_));
    }
    return static_cast<glm::uint>(value);
  }

  void read_list(const PlyProperty& list) {
    const std::uint64_t length = in_.list_length(list);
    if (strips_) {
      read_strip(list, length);
      return;
    }
    glm::uvec3 fan{0};
    for (std::uint64_t i = 0; i < length; ++i) {
      const glm::uint next = index(list.type);
      if (i == 0) {
        fan.x = next;
      }
      fan.y = fan.z;
      fan.z = next;
      if (i >= 2) {
        triangles_.push_back(fan);
      }
    }
  }

  void read_strip(const PlyProperty& list, std::uint64_t length) {
    std::uint64_t in_strip = 0;
    glm::uvec3 last{0};
    for (std::uint64_t i = 0; i < length; ++i) {
      const double value = in_.number(list.type);
      if (value == -1.0) {
        in_strip = 0;
        continue;
      }
      if (!(value >= 0.0 && value < static_cast<double>(vertex_count_))) {
        in_.fail("a strip uses vertex " + std::to_string(value) + ", expected less than " +
                 std::to_string(vertex_count_));
      }
      last = {last.y, last.z, static_cast<glm::uint>(value)};
      ++in_strip;
      if (in_strip >= 3) {
        triangles_.push_back(in_strip % 2 == 1 ? last : glm::uvec3(last.y, last.x, last.z));
      }
    }
  }

  PlyBody& in_;
  std::uint64_t vertex_count_;
  bool strips_;
  std::vector<glm::uvec3>& triangles_;
};

/// Index of the list of vertex indices, -1 when the element has none.
int find_index_list(const PlyElement& element) {
  for (const char* name : {"vertex_indices", "vertex_index"}) {
    const int index = element.find(name);
    if (index >= 0 && element.properties[static_cast<std::size_t>(index)].is_list) {
      return index;
    }
  }
  return -1;
}

std::uint64_t skip_element(PlyBody& in, const PlyElement& element) {
  return in.read_rows(element, [&] {
    for (const PlyProperty& property : element.properties) in.skip(property);
  });
}

const PlyElement& vertex_element(const PlyHeader& header, const std::filesystem::path& path) {
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") {
      constexpr std::uint64_t MOST = 0xFFFFFFFFU;
      if (element.count > MOST) {
        throw_unreadable(path, "the header declares " + std::to_string(element.count) +
                                   " vertices, expected at most " + std::to_string(MOST));
      }
      return element;
    }
  }
  throw_unreadable(path, "the header has no element 'vertex'");
}

bool is_triangles(const PlyElement& element) { return element.name == "face" || element.name == "tristrips"; }

bool has_triangles(const PlyHeader& header) {
  return std::any_of(header.elements.begin(), header.elements.end(),
                     [](const PlyElement& element) { return is_triangles(element) && element.count > 0; });
}

std::vector<SplatMark> marks_of(const PlyHeader& header) {
  std::vector<SplatMark> marks;
  for (const std::string& remark : header.remarks)
    if (auto mark = mark_of(remark)) marks.push_back(*std::move(mark));
  return marks;
}

std::uint64_t append_faces(PlyBody& in, const PlyElement& element, std::uint64_t vertex_count, int list,
                           Mesh& mesh, std::vector<std::string>& skipped) {
  FaceReader faces(in, vertex_count, element.name == "tristrips", mesh.triangles);
  const std::uint64_t rows = faces.read(element, static_cast<std::size_t>(list));
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    if (static_cast<int>(i) != list) {
      skipped.push_back(element.name + "." + element.properties[i].name);
    }
  }
  return rows;
}

/// The first element whose rows the file ends before.
struct Cut {
  const PlyElement* element = nullptr;
  std::uint64_t rows = 0;
  std::vector<std::string> lost{};  ///< those behind it

  void note(const PlyElement& one, std::uint64_t found) {
    if (found >= one.count) return;
    if (element == nullptr)
      *this = {&one, found};
    else
      lost.push_back(one.name);
  }

  void report(const std::filesystem::path& path, const ScanOptions& options,
              const ReadListener& listener) const {
    if (element == nullptr) return;
    const std::string found = "found " + std::to_string(rows) + " rows of element '" + element->name +
                              "', expected " + std::to_string(element->count) + " as the header says";
    if (options.strict) throw_unreadable(path, found);
    // Where a count is too high, what should have been the next element was read as this one.
    const std::string behind = lost.empty() ? ""
                                            : ", and nothing of " + quoted_list(lost) +
                                                  ": the file was cut off or the count is wrong";
    listener.note(path, found + "; those there are were read" + behind);
  }
};

}  // namespace

Mesh read_ply(const std::filesystem::path& path, const ReadOptions& options, const ReadListener& listener) {
  ByteReader bytes(path, &listener);
  const PlyHeader header = read_ply_header(bytes);
  const PlyElement& vertices = vertex_element(header, path);
  std::optional<PlyGaussians> gaussians;
  if (PlyGaussians::are_in(vertices)) gaussians.emplace();
  const bool point_set = gaussians || !has_triangles(header);
  const std::vector<SplatMark> marks = marks_of(header);
  PlyBody in(bytes, header);
  Mesh mesh;
  std::vector<std::string> skipped;
  Cut cut;
  for (const PlyElement& element : header.elements) {
    if (element.properties.empty() && &element != &vertices) {
      continue;
    }
    const int list = find_index_list(element);
    if (gaussians && PlyGaussians::takes(element)) {
      cut.note(element, gaussians->read(in, element));
    } else if (&element == &vertices) {
      std::vector<std::string> attributes = options.scans.attributes;
      if (has_splats(marks))
        for (const PlyProperty& property : element.properties) attributes.push_back(property.name);
      mesh.vertices = read_ply_vertices(in, element, point_set ? &attributes : nullptr, listener.notes);
      cut.note(element, mesh.vertices.size());
    } else if (list >= 0 && is_triangles(element) && !gaussians) {
      cut.note(element, append_faces(in, element, mesh.vertices.size(), list, mesh, skipped));
    } else if (const auto grid = range_grid_form(header, element);
               point_set && list >= 0 && grid && mesh.vertices.size() > 0 && element.name == "range_grid") {
      cut.note(element, read_range_grid(in, element, static_cast<std::size_t>(list), *grid, mesh.vertices));
    } else {
      cut.note(element, skip_element(in, element));
      skipped.push_back(element.name);
    }
  }
  in.finish();
  if (gaussians) {
    std::string note;
    mesh.vertices = gaussians->take(in, listener.progress, note);
    listener.note(path, note);
  }
  cut.report(path, options.scans, listener);
  if (point_set) place_sensors(header, mesh.vertices), take_marks(marks, mesh.vertices);
  if (!skipped.empty()) {
    listener.note(path, "skipped elements " + quoted_list(skipped));
  }
  return mesh;
}

}  // namespace splatray
