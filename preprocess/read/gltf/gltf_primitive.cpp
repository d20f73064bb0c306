#include "preprocess/read/gltf/gltf_primitive.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <numeric>
#include <type_traits>

#include "preprocess/mesh/alpha_mask.h"
#include "preprocess/mesh/surface_maps.h"
#include "preprocess/mesh/texture/texture.h"
#include "preprocess/read/gltf/gltf_accessor.h"
#include "preprocess/read/gltf/gltf_attributes.h"
#include "preprocess/read/scan/stored_colors.h"

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

/// What a primitive's COLOR_0 says.
struct VertexColors {
  std::vector<glm::vec3> color;  ///< linear, 0..1; empty = none
  std::vector<float> alpha;      ///< 0..1; empty = 1 everywhere
};

/// Divides values that are beyond 0..1 though the specification wants them there, by what full is (ColorRange); NaN becomes 0.
void scale_colors(const GltfFile& file, std::size_t accessor, std::vector<glm::vec4>& colors,
                  std::vector<std::string>& notes) {
  ColorRange range(file.model.accessors[accessor].componentType == TINYGLTF_COMPONENT_TYPE_FLOAT);
  for (const glm::vec4& color : colors)
    for (int channel = 0; channel < 3; ++channel) range.add(static_cast<double>(color[channel]));
  const auto full = static_cast<float>(range.full());
  const bool is_odd = full != 1.0F || range.outliers() > 0;
  if (const std::string said = color_note(range); !said.empty() && is_odd)
    notes.push_back(file.path.string() + ": COLOR_0: " + said);
  for (glm::vec4& color : colors)
    for (int channel = 0; channel < 4; ++channel)
      color[channel] = std::max(0.0F, std::min(color[channel] / full, 1.0F));
}

VertexColors read_colors(const GltfFile& file, const tinygltf::Primitive& primitive, std::size_t vertex_count,
                         std::vector<std::string>& notes) {
  VertexColors read;
  const auto found = primitive.attributes.find("COLOR_0");
  if (found == primitive.attributes.end()) return read;
  const std::size_t accessor = file.checked(found->second, file.model.accessors.size(), "accessor");
  std::vector<glm::vec4> colors;
  if (file.model.accessors[accessor].type == TINYGLTF_TYPE_VEC4)
    colors = read_attribute<glm::vec4>(file, primitive, "COLOR_0", vertex_count);
  else
    for (const glm::vec3& color : read_attribute<glm::vec3>(file, primitive, "COLOR_0", vertex_count))
      colors.emplace_back(color, std::numeric_limits<float>::infinity());  // becomes 1
  scale_colors(file, accessor, colors, notes);
  for (const glm::vec4& color : colors) read.color.emplace_back(color);
  if (std::any_of(colors.begin(), colors.end(), [](const glm::vec4& color) { return color.w < 1.0F; }))
    for (const glm::vec4& color : colors) read.alpha.push_back(color.w);
  return read;
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

/// Lets the alpha of vertices, or of the material alone, cut out or thin a surface, beside that of its texture (glTF 2.0,
/// section 3.9.2: they are multiplied); one that has none gets a texture of one texel.
void add_alpha(const tinygltf::Primitive& primitive, std::vector<float> alpha, GltfMaterials& materials,
               Mesh& mesh) {
  if (!mesh.texture) {
    mesh.texture = materials.even_texture(primitive.material, !alpha.empty());
    if (mesh.texture) mesh.texcoord.assign(mesh.vertices.size(), glm::vec2(0.0F));
  }
  if (!mesh.texture || mesh.texture->alpha_cutoff == 0.0F || alpha.empty()) return;
  mesh.alpha = std::move(alpha);
  const auto is_opacity = [](const SurfaceMap& map) {
    return std::any_of(map.channels.begin(), map.channels.end(),
                       [](const MapChannel& channel) { return channel.factor->column == COLUMN_OPACITY; });
  };
  const bool is_mask = mesh.texture->alpha_cutoff > GltfMaterials::LEAST_ALPHA;
  if (is_mask || std::any_of(mesh.maps.begin(), mesh.maps.end(), is_opacity)) return;
  mesh.maps.push_back({mesh.texture, GltfMaterials::opacity_channel(), 0.0F,
                       std::make_shared<const std::vector<glm::vec2>>(mesh.texcoord)});
}

/// Leaves out the points that the material's alpha cuts out.
void cut_points(const Mesh& mesh, std::vector<glm::uint>& indices) {
  const AlphaMask mask(mesh);
  if (mask.any()) std::erase_if(indices, [&](glm::uint index) { return mask.cut_out(std::size_t{index}); });
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
  for (Column& column : points.columns) edit_values(column, select);
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
  VertexColors colors = read_colors(file, primitive, count, notes);
  mesh.vertices.color = std::move(colors.color);
  mesh.vertices.columns = read_added_attributes(file, primitive, count, notes);
  add_texture(file, primitive, materials, mesh);
  add_maps(file, primitive, materials, mesh);
  add_alpha(primitive, std::move(colors.alpha), materials, mesh);
  if (!mesh.texture) {
    const glm::vec3 base = materials.base_color(primitive.material);
    for (glm::vec3& color : mesh.vertices.color) {
      color *= base;
    }
  }
  std::vector<glm::uint> indices = indices_of(file, primitive, count);
  if (!is_points) {
    mesh.triangles = triangles_of(indices, mode);
    return mesh;
  }
  cut_points(mesh, indices);
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
  select_points(mesh.vertices, indices);
  for (Column& column : maps.take()) mesh.vertices.columns.push_back(std::move(column));
  return mesh;
}

}  // namespace splatray
