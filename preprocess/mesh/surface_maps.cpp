#include "preprocess/mesh/surface_maps.h"

#include <utility>

#include "preprocess/mesh/texture.h"

namespace splatray {

float map_value(const SurfaceMap& map, const MapChannel& channel, glm::vec2 texcoord) {
  const bool is_color = channel.factor->color != nullptr;
  if (is_color) return map.texture->color(texcoord)[channel.channel];
  const float factor = channel.channel == 3 ? map.texture->alpha_factor : 1.0F;
  return factor * map.texture->numbers(texcoord)[channel.channel];
}

MapSamples::MapSamples(const Mesh& mesh) : maps_(mesh.maps) {
  for (const SurfaceMap& map : maps_) bytes_.resize(bytes_.size() + map.channels.size());
}

template <class TexcoordOf>
void MapSamples::add_at(const TexcoordOf& texcoord_of) {
  std::size_t column = 0;
  for (const SurfaceMap& map : maps_) {
    const glm::vec2 texcoord = texcoord_of(*map.texcoord);
    for (const MapChannel& channel : map.channels)
      bytes_[column++].push_back(encode_factor(*channel.factor, map_value(map, channel, texcoord)));
  }
}

void MapSamples::add(const glm::uvec3& triangle, const glm::vec3& weights) {
  add_at([&](const std::vector<glm::vec2>& uv) {
    return weights.x * uv[triangle.x] + weights.y * uv[triangle.y] + weights.z * uv[triangle.z];
  });
}

void MapSamples::add(glm::uint vertex) {
  add_at([&](const std::vector<glm::vec2>& uv) { return uv[vertex]; });
}

std::vector<Column> MapSamples::take() {
  std::vector<Column> columns;
  auto bytes = bytes_.begin();
  for (const SurfaceMap& map : maps_)
    for (const MapChannel& channel : map.channels)
      columns.push_back({std::string(channel.factor->column), std::move(*bytes++)});
  return columns;
}

}  // namespace splatray
