#include "preprocess/read/ply/read_ply.h"

#include <algorithm>

#include "preprocess/base/quoted_list.h"
#include "preprocess/read/ply/ply_scan.h"
#include "preprocess/read/ply/ply_splats.h"
#include "preprocess/read/ply/ply_vertices.h"
#include "preprocess/read/scan/gaussian_capture.h"

namespace splatray {
namespace {

/// Reads the element that holds triangles: polygons as fans, strips with -1 as restart.
class FaceReader {
 public:
  FaceReader(PlyBody& in, std::uint64_t vertex_count, bool strips, std::vector<glm::uvec3>& triangles)
      : in_(in), vertex_count_(vertex_count), strips_(strips), triangles_(triangles) {}

  void read(const PlyElement& element, std::size_t list_index) {
    triangles_.reserve(triangles_.size() + element.count);
    for (std::uint64_t row = 0; row < element.count; ++row) {
      in_.begin_row();
      for (std::size_t i = 0; i < element.properties.size(); ++i) {
        if (i == list_index) {
          read_list(element.properties[i]);
        } else {
          in_.skip(element.properties[i]);
        }
      }
      in_.end_row();
    }
  }

 private:
  glm::uint index(PlyType type) {
    const double value = in_.number(type);
    if (!(value >= 0.0 && value < static_cast<double>(vertex_count_))) {
      in_.fail("a face uses vertex " + std::to_string(value) + ", expected less than " +
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

/// A declared count must fit into what is left of the file, before anything is allocated for it.
void check_count(const PlyBody& in, const PlyElement& element, PlyFormat format) {
  const std::uint64_t row_bytes = element.min_row_bytes(format);
  const std::uint64_t left = in.remaining() + (in.is_ascii() ? 1 : 0);
  if (row_bytes > 0 && element.count > left / row_bytes) {
    in.fail("the header declares " + std::to_string(element.count) + " rows of element '" + element.name +
            "' of at least " + std::to_string(row_bytes) + " bytes, but only " +
            std::to_string(in.remaining()) + " bytes are left");
  }
}

void skip_element(PlyBody& in, const PlyElement& element) {
  for (std::uint64_t row = 0; row < element.count; ++row) {
    in.begin_row();
    for (const PlyProperty& property : element.properties) {
      in.skip(property);
    }
    in.end_row();
  }
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

void refuse_gaussians(const PlyElement& vertices, const std::filesystem::path& path) {
  std::vector<std::string> names;
  for (const PlyProperty& property : vertices.properties) names.push_back(property.name);
  refuse_gaussian_ply(path, names);
}

void append_faces(PlyBody& in, const PlyElement& element, std::uint64_t vertex_count, int list, Mesh& mesh,
                  std::vector<std::string>& skipped) {
  FaceReader faces(in, vertex_count, element.name == "tristrips", mesh.triangles);
  faces.read(element, static_cast<std::size_t>(list));
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    if (static_cast<int>(i) != list) {
      skipped.push_back(element.name + "." + element.properties[i].name);
    }
  }
}

}  // namespace

Mesh read_ply(const std::filesystem::path& path, const ReadOptions& options, const ReadListener& listener) {
  ByteReader bytes(path, &listener);
  const PlyHeader header = read_ply_header(bytes);
  const PlyElement& vertices = vertex_element(header, path);
  refuse_gaussians(vertices, path);
  const bool point_set = !has_triangles(header);
  PlyBody in(bytes, header);
  Mesh mesh;
  std::vector<std::string> skipped;
  for (const PlyElement& element : header.elements) {
    if (element.properties.empty() && &element != &vertices) {
      continue;
    }
    check_count(in, element, header.format);
    const int list = find_index_list(element);
    if (&element == &vertices) {
      std::vector<std::string> attributes = options.scans.attributes;
      if (has_splats(header))
        for (const PlyProperty& property : element.properties) attributes.push_back(property.name);
      mesh.vertices = read_ply_vertices(in, element, point_set ? &attributes : nullptr, listener.notes);
    } else if (list >= 0 && is_triangles(element)) {
      append_faces(in, element, vertices.count, list, mesh, skipped);
    } else if (const auto grid = range_grid_form(header, element);
               point_set && list >= 0 && grid && mesh.vertices.size() > 0 && element.name == "range_grid") {
      read_range_grid(in, element, static_cast<std::size_t>(list), *grid, mesh.vertices);
    } else {
      skip_element(in, element);
      skipped.push_back(element.name);
    }
  }
  if (point_set) place_sensors(header, mesh.vertices), take_remarks(header, mesh.vertices);
  if (!skipped.empty()) {
    listener.note(path, "skipped elements " + quoted_list(skipped));
  }
  return mesh;
}

}  // namespace splatray
