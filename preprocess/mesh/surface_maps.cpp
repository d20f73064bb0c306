#include "preprocess/mesh/surface_maps.h"

#include <algorithm>
#include <utility>

#include "engine/scene/octahedral.h"
#include "preprocess/mesh/texture/texture.h"

namespace splatray {

float map_value(const SurfaceMap& map, const MapChannel& channel, glm::vec2 texcoord) {
  const bool is_color = channel.factor->color != nullptr;
  if (is_color) return map.texture->color(texcoord)[channel.channel];
  const float factor = channel.channel == 3 ? map.texture->alpha_factor : 1.0F;
  return factor * map.texture->numbers(texcoord)[channel.channel];
}

namespace {

/// Where a normal map's x leads on a triangle, and its y: to the right and up in its picture (glTF 2.0, normalTexture). Not unit;
/// zero where its texture coordinates lie in a line.
struct MapAxes {
  glm::dvec3 x{0.0}, y{0.0};
};
MapAxes axes_of(const Mesh& mesh, const SurfaceMap& map, const glm::uvec3& t) {
  const auto& p = mesh.vertices.position;
  const auto uv = [&](glm::uint vertex) { return glm::dvec2(map.texture->place((*map.texcoord)[vertex])); };
  const glm::dvec3 edge_1 = p[t.y] - p[t.x], edge_2 = p[t.z] - p[t.x];
  const glm::dvec2 uv_1 = uv(t.y) - uv(t.x), uv_2 = uv(t.z) - uv(t.x);
  const double determinant = uv_1.x * uv_2.y - uv_2.x * uv_1.y;
  if (determinant == 0.0) return {};
  return {(edge_1 * uv_2.y - edge_2 * uv_1.y) / determinant,
          (edge_1 * uv_2.x - edge_2 * uv_1.x) / determinant};
}

}  // namespace

MapSamples::MapSamples(const Mesh& mesh) : mesh_(mesh) {
  for (const SurfaceMap& map : mesh.maps) bytes_.resize(bytes_.size() + map.channels.size());
}

template <class ValueOf>
void MapSamples::add_at(const ValueOf& value_of, const glm::uvec3* triangle, const glm::vec3& normal) {
  std::size_t column = 0;
  const float alpha = mesh_.alpha.empty() ? 1.0F : value_of(mesh_.alpha);
  for (const SurfaceMap& map : mesh_.maps) {
    const glm::vec2 texcoord = value_of(*map.texcoord);
    for (const MapChannel& channel : map.channels) {
      const float thinned = channel.factor->column == COLUMN_OPACITY ? alpha : 1.0F;
      bytes_[column++].push_back(encode_factor(*channel.factor, thinned * map_value(map, channel, texcoord)));
    }
    if (map.normal_scale != 0.0F) add_normal(map, texcoord, triangle, normal);
  }
}

void MapSamples::add_normal(const SurfaceMap& map, glm::vec2 texcoord, const glm::uvec3* triangle,
                            const glm::vec3& normal) {
  normal_u_.push_back(ABSENT_NORMAL);
  normal_v_.push_back(ABSENT_NORMAL);
  if (triangle == nullptr) return;
  const glm::dvec3 n = glm::normalize(glm::dvec3(normal));
  const MapAxes axes = axes_of(mesh_, map, *triangle);
  const glm::dvec3 along = axes.x - n * glm::dot(n, axes.x);
  if (!(glm::length(along) > 0.0)) return;
  const glm::dvec3 x = glm::normalize(along);
  glm::dvec3 y = glm::cross(n, x);
  if (glm::dot(y, axes.y) < 0.0) y = -y;
  const glm::dvec3 stored = 2.0 * glm::dvec3(glm::vec3(map.texture->numbers(texcoord))) - 1.0;
  const double scale = static_cast<double>(map.normal_scale);
  const glm::dvec3 mapped = scale * (stored.x * x + stored.y * y) + std::max(stored.z, 0.0) * n;
  if (!(glm::length(mapped) > 0.0)) return;
  const glm::ivec2 code = octahedral_nearest(glm::normalize(mapped), NORMAL_MAP_SCALE) + NORMAL_MAP_SCALE;
  normal_u_.back() = static_cast<std::uint16_t>(code.x);
  normal_v_.back() = static_cast<std::uint16_t>(code.y);
}

void MapSamples::add(const glm::uvec3& triangle, const glm::vec3& weights, const glm::vec3& normal) {
  add_at(
      [&](const auto& of) {
        return weights.x * of[triangle.x] + weights.y * of[triangle.y] + weights.z * of[triangle.z];
      },
      &triangle, normal);
}

void MapSamples::add(glm::uint vertex, const glm::vec3& normal) {
  if (triangle_at_.empty() && !mesh_.maps.empty()) {
    triangle_at_.assign(mesh_.vertices.size(), nullptr);
    for (const glm::uvec3& triangle : mesh_.triangles)
      for (glm::length_t corner = 0; corner < 3; ++corner) triangle_at_[triangle[corner]] = &triangle;
  }
  add_at([&](const auto& of) { return of[vertex]; }, mesh_.maps.empty() ? nullptr : triangle_at_[vertex],
         normal);
}

std::vector<Column> MapSamples::take() {
  std::vector<Column> columns;
  auto bytes = bytes_.begin();
  for (const SurfaceMap& map : mesh_.maps)
    for (const MapChannel& channel : map.channels)
      columns.push_back({std::string(channel.factor->column), std::move(*bytes++)});
  if (normal_u_.empty()) return columns;
  columns.push_back({std::string(COLUMN_NORMAL_U), std::move(normal_u_)});
  columns.push_back({std::string(COLUMN_NORMAL_V), std::move(normal_v_)});
  return columns;
}

}  // namespace splatray
