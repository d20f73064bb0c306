#include "preprocess/pack_clouds.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>

#include "engine/base/release.h"
#include "engine/scene/clip.h"
#include "engine/scene/splat.h"
#include "preprocess/base/morton.h"
#include "preprocess/base/stage_memory.h"

namespace splatray {
namespace {

/// The normal field of a splat that has been packed.
std::uint32_t packed_field(const Cloud& cloud, std::size_t i, const glm::dvec3& packed_normal) {
  if (!cloud.field_words.empty()) return cloud.field_words[i];
  if (!cloud.shading.empty() && cloud.shading[i] != glm::vec3(0.0F)) {
    const glm::dvec3 shading(cloud.shading[i]);
    return pack_lean(shading / glm::dot(shading, packed_normal) - packed_normal, packed_normal);
  }
  const TangentFrame frame(glm::normalize(glm::dvec3(cloud.normal[i])));
  const glm::dvec3 slope = glm::dvec3(cloud.field[i]) * static_cast<double>(cloud.radius[i]);
  const glm::dmat3 matrix =
      slope.x * glm::outerProduct(frame.u, frame.u) + slope.z * glm::outerProduct(frame.v, frame.v) +
      slope.y * (glm::outerProduct(frame.u, frame.v) + glm::outerProduct(frame.v, frame.u));
  return pack_field(matrix, packed_normal);
}

/// The clip lines of a splat that has been packed.
std::uint32_t packed_clip(const Cloud& cloud, std::size_t i, const RootTransform& root, const uvec4& words) {
  if (cloud.clip.empty()) return CLIP_NONE;
  const PointClip& clip = cloud.clip[i];
  if (cloud.radius[i] > clip.reach) return CLIP_NONE;
  std::array<ClipEdge, 2> edges;
  for (std::size_t line = 0; line < clip.lines(); ++line) {
    const glm::dvec3 dir(clip.dir[line]);
    const glm::dvec3 to_line = dir * (clip.distance[line] * cloud.half_extent_world);
    edges[line] = {dir, root.to_root(cloud.place_world(i) + to_line)};
  }
  return pack_clip(words, std::span(edges).first(clip.lines()));
}

/// The same with the ellipse of a point that has one.
std::uint32_t packed_shape(const Cloud& cloud, std::size_t i, const RootTransform& root, const uvec4& words) {
  if (!cloud.clip_words.empty()) return cloud.clip_words[i];
  const std::uint32_t clip = packed_clip(cloud, i, root, words);
  if (!cloud.is_ellipse(i)) return clip;
  return pack_ellipse(words, glm::normalize(glm::dvec3(cloud.ellipse[i].short_axis)), cloud.ellipse[i].aspect,
                      clip);
}

bool all_whole(const std::vector<std::uint32_t>& clips) {
  return std::all_of(clips.begin(), clips.end(), [](std::uint32_t clip) { return clip == CLIP_NONE; });
}

bool all_flat(const std::vector<std::uint32_t>& fields) {
  return std::all_of(fields.begin(), fields.end(), [](std::uint32_t field) { return field == FIELD_FLAT; });
}

}  // namespace

SplatList pack_clouds(std::vector<Cloud> clouds, const RootTransform& root, bool number_points,
                      const Stage& stage) {
  std::size_t total = 0;
  bool has_colors = false;
  bool has_fields = false;
  bool has_clips = false;
  for (const Cloud& cloud : clouds) {
    total += cloud.size();
    has_fields = has_fields || !cloud.field.empty() || !cloud.field_words.empty();
    has_clips = has_clips || !cloud.clip.empty() || !cloud.ellipse.empty() || !cloud.clip_words.empty();
    has_colors = has_colors || !cloud.color.empty();
  }
  SplatList splats;
  const std::uint64_t further = has_colors + has_fields + has_clips + number_points;
  require_stage_memory(stage.name, total,
                       sizeof(splats.key[0]) + sizeof(splats.words[0]) + further * sizeof(std::uint32_t));
  splats.key.resize(total);
  splats.words.resize(total);
  if (has_colors) splats.color.resize(total, pack_color(glm::vec3(1.0F)));
  if (has_fields) splats.field.resize(total, FIELD_FLAT);
  if (has_clips) splats.clip.resize(total, CLIP_NONE);
  if (number_points) {
    splats.point.resize(total);
    std::iota(splats.point.begin(), splats.point.end(), 0U);
  }
  std::size_t first = 0;
  for (std::uint32_t object = 0; object < clouds.size(); ++object) {
    const Cloud cloud = std::move(clouds[object]);
    parallel_each(stage, cloud.size(), [&](std::size_t i) {
      const double radius = cloud.radius[i] * cloud.half_extent_world / root.unit_world;
      const uvec4 words = pack_splat({root.to_root(cloud.place_world(i)),
                                      glm::normalize(glm::dvec3(cloud.normal[i])), radius * radius, object});
      const Splat splat = unpack_splat(words);
      splats.words[first + i] = words;
      splats.key[first + i] = morton_key(glm::uvec3(splat.center));
      if (!cloud.field.empty() || !cloud.field_words.empty())
        splats.field[first + i] = packed_field(cloud, i, splat.normal);
      if (has_clips) splats.clip[first + i] = packed_shape(cloud, i, root, words);
    });
    std::copy(cloud.color.begin(), cloud.color.end(),
              splats.color.begin() + static_cast<std::ptrdiff_t>(cloud.color.empty() ? 0 : first));
    first += cloud.size();
  }
  if (all_flat(splats.field)) release(splats.field);
  if (all_whole(splats.clip)) release(splats.clip);
  return splats;
}

}  // namespace splatray
