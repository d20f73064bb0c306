#include "preprocess/read/gltf/gltf_primitive.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <numeric>
#include <type_traits>

#include "preprocess/mesh/surface_maps.h"
#include "preprocess/mesh/texture/texture.h"
#include "preprocess/read/gltf/gltf_accessor.h"

namespace splatray {
namespace {

/// An attribute as vectors, empty when the primitive has none.
template <class Vector>
std::vector<Vector> read_attribute(const GltfFile& file, const tinygltf::Primitive& primitive,
                                   const std::string& name, std::size_t vertex_count) {
  const auto found = primitive.attributes.find(name);
  if (found == primitive.attributes.end()) {
    return {};
  }
  const std::vector<float> rows = read_floats(file, found->second, Vector::length(), name);
  std::vector<Vector> vectors(rows.size() / Vector::length());
  if (!rows.empty()) std::memcpy(vectors.data(), rows.data(), rows.size() * sizeof(float));
  if (vectors.size() != vertex_count) {
    file.fail(name + ": found " + std::to_string(vectors.size()) + " elements, POSITION has " +
              std::to_string(vertex_count));
  }
  return vectors;
}

/// COLOR_0 within 0..1, as the specification wants it; NaN becomes 0.
std::vector<glm::vec3> read_colors(const GltfFile& file, const tinygltf::Primitive& primitive,
                                   std::size_t vertex_count) {
  std::vector<glm::vec3> colors = read_attribute<glm::vec3>(file, primitive, "COLOR_0", vertex_count);
  for (glm::vec3& color : colors) {
    for (int channel = 0; channel < 3; ++channel) {
      color[channel] = std::max(0.0F, std::min(color[channel], 1.0F));
    }
  }
  return colors;
}

std::vector<glm::dvec3> read_positions(const GltfFile& file, const tinygltf::Primitive& primitive) {
  const auto found = primitive.attributes.find("POSITION");
  if (found == primitive.attributes.end()) {
    file.fail("a primitive has no POSITION attribute");
  }
  const std::vector<float> rows = read_floats(file, found->second, 3, "POSITION");
  std::vector<glm::dvec3> positions(rows.size() / 3);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    positions[i] = {rows[3 * i], rows[3 * i + 1], rows[3 * i + 2]};
  }
  return positions;
}

std::vector<glm::uvec3> triangles_of(const std::vector<glm::uint>& indices, int mode) {
  std::vector<glm::uvec3> triangles;
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    for (std::size_t i = 2; i < indices.size(); i += 3) {
      triangles.emplace_back(indices[i - 2], indices[i - 1], indices[i]);
    }
    return triangles;
  }
  for (std::size_t i = 2; i < indices.size(); ++i) {
    if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
      triangles.emplace_back(indices[0], indices[i - 1], indices[i]);
    } else if (i % 2 == 0) {
      triangles.emplace_back(indices[i - 2], indices[i - 1], indices[i]);
    } else {
      triangles.emplace_back(indices[i - 1], indices[i - 2], indices[i]);
    }
  }
  return triangles;
}

/// The material's textures of factors for which there are coordinates.
void add_maps(const GltfFile& file, const tinygltf::Primitive& primitive, GltfMaterials& materials,
              Mesh& mesh) {
  std::map<int, std::shared_ptr<const std::vector<glm::vec2>>> sets;
  for (const auto& [map, set] : materials.maps(primitive.material)) {
    if (set < 0)
      sets[set] = std::make_shared<const std::vector<glm::vec2>>(mesh.vertices.size(), glm::vec2(0.0F));
    else if (sets.count(set) == 0)
      sets[set] = std::make_shared<const std::vector<glm::vec2>>(read_attribute<glm::vec2>(
          file, primitive, "TEXCOORD_" + std::to_string(set), mesh.vertices.size()));
    if (sets[set]->empty()) continue;
    mesh.maps.push_back(map);
    mesh.maps.back().texcoord = sets[set];
  }
}

/// Keeps the vertices that an indexed POINTS primitive names, each in the order named.
void select_points(Points& points, const std::vector<glm::uint>& indices) {
  const auto select = [&](auto& values) {
    if (values.empty()) {
      return;
    }
    std::remove_reference_t<decltype(values)> selected;
    selected.reserve(indices.size());
    for (const glm::uint index : indices) {
      selected.push_back(values[index]);
    }
    values = std::move(selected);
  };
  select(points.position);
  select(points.normal);
  select(points.color);
}

std::vector<glm::uint> indices_of(const GltfFile& file, const tinygltf::Primitive& primitive,
                                  std::size_t vertex_count) {
  if (primitive.indices >= 0) {
    return read_indices(file, primitive.indices, vertex_count);
  }
  std::vector<glm::uint> indices(vertex_count);
  std::iota(indices.begin(), indices.end(), 0U);
  return indices;
}

void add_texture(const GltfFile& file, const tinygltf::Primitive& primitive, GltfMaterials& materials,
                 Mesh& mesh) {
  const std::shared_ptr<const Texture> texture = materials.base_texture(primitive.material);
  if (!texture) {
    return;
  }
  const std::string set = "TEXCOORD_" + std::to_string(materials.base_texcoord(primitive.material));
  mesh.texcoord = read_attribute<glm::vec2>(file, primitive, set, mesh.vertices.size());
  if (!mesh.texcoord.empty()) {
    mesh.texture = texture;
  }
}

}  // namespace

std::optional<Mesh> read_primitive(const GltfFile& file, const tinygltf::Primitive& primitive,
                                   GltfMaterials& materials, std::vector<std::string>& notes) {
  const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
  const bool is_points = mode == TINYGLTF_MODE_POINTS;
  if (!is_points && (mode < TINYGLTF_MODE_TRIANGLES || mode > TINYGLTF_MODE_TRIANGLE_FAN)) {
    notes.push_back(file.path.string() + ": skipped a primitive of lines");
    return std::nullopt;
  }
  Mesh mesh;
  mesh.vertices.position = read_positions(file, primitive);
  const std::size_t count = mesh.vertices.size();
  mesh.vertices.normal = read_attribute<glm::vec3>(file, primitive, "NORMAL", count);
  mesh.vertices.color = read_colors(file, primitive, count);
  add_texture(file, primitive, materials, mesh);
  add_maps(file, primitive, materials, mesh);
  if (!mesh.texture) {
    const glm::vec3 base = materials.base_color(primitive.material);
    for (glm::vec3& color : mesh.vertices.color) {
      color *= base;
    }
  }
  const std::vector<glm::uint> indices = indices_of(file, primitive, count);
  if (!is_points) {
    mesh.triangles = triangles_of(indices, mode);
    return mesh;
  }
  if (mesh.texture) {
    mesh.vertices.color.resize(count, glm::vec3(1.0F));
    for (std::size_t i = 0; i < count; ++i) {
      mesh.vertices.color[i] *= mesh.texture->color(mesh.texcoord[i]);
    }
    mesh.texture = nullptr;
    mesh.texcoord.clear();
  }
  MapSamples maps(mesh);
  for (const glm::uint index : indices) maps.add(index, glm::vec3(0.0F));
  mesh.vertices.columns = maps.take();
  select_points(mesh.vertices, indices);
  return mesh;
}

}  // namespace splatray
