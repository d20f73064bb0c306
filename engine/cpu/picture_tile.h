/// The tile of a group's pixels. After shaders/stage/pixels.glsl and wide_trace.h, in their namespace.

/// Beyond so many sides of the root from its middle, float32 tells too little of where a camera's rays go.
constexpr double FARTHEST_TILE = 8.0;

/// Where in their pixels the rays of the dispatch go through.
struct RayPlaces {
  vec2 low, high;
};

RayPlaces ray_places() {
  const RayPlaces middle{vec2(0.5f), vec2(0.5f)}, all{vec2(0.0f), vec2(1.0f)};
  if (OUTPUT == OUTPUT_AOV) return middle;
#ifdef LIT
  return LOOK == LOOK_SEEN ? middle : all;
#else
  if (frame.sample_end - frame.sample_begin > 16u) return all;
  RayPlaces places{vec2(1.0f), vec2(0.0f)};
  for (uint sample = frame.sample_begin; sample < frame.sample_end; ++sample) {
    const vec2 place = pixel_sample(sample);
    places = {min(places.low, place), max(places.high, place)};
  }
  return places;
#endif
}

std::array<float, 3> floats_of(const dvec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// A plane whose product with (p - middle, 1) is at least 0 for all points seen, for points p that lie up to the slack beside it.
std::array<float, 4> tile_plane(const dvec3& normal, double begin, const dvec3& middle, double slack) {
  const auto [x, y, z] = floats_of(normal);
  const dvec3 rounded(x, y, z);
  const double more = 2.0 * slack * (std::abs(x) + std::abs(y) + std::abs(z));
  return {x, y, z, static_cast<float>(begin - glm::dot(rounded, middle) + more)};
}

/// Sets what the pixels of a tile see; false where float32 cannot say it, and of panoramas.
bool set_tile_camera(uvec2 first_pixel, uvec2 pixels, WideTile& tile) {
  if (frame.panorama.x > 0.0f) return false;  // its rays lie in no plane
  const glm::dvec2 half = 0.5 * glm::dvec2(pixels), at = glm::dvec2(first_pixel) + half;
  const dvec3 middle = dvec3(frame.origin_00) + dvec3(frame.origin_dx) * at.x + dvec3(frame.origin_dy) * at.y;
  const dvec3 dir = dvec3(frame.dir_00) + dvec3(frame.dir_dx) * at.x + dvec3(frame.dir_dy) * at.y;
  const bool perspective = frame.dir_dx != vec3(0.0f);
  const dvec3 right = perspective ? frame.dir_dx : frame.origin_dx;
  const dvec3 down = perspective ? frame.dir_dy : frame.origin_dy;
  // Takes p - middle apart: how far along the middle ray, and how far beside it in pixels times that.
  const glm::dmat3 parts = glm::transpose(glm::inverse(glm::dmat3(dir, right, down)));
  const double length = glm::length(parts[0]);
  const double distance = glm::length(middle - dvec3(0.5 * ROOT_SIZE)) / ROOT_SIZE;
  if (!(length > 0.0) || !(distance < FARTHEST_TILE)) return false;
  const dvec3 ahead = parts[0] / length, w_ahead = perspective ? ahead : dvec3(0.0);
  const double w_begin = perspective ? double(frame.depth_per_dir) / length : 1.0;
  const double slack = 2.0 + (distance + 2.0) * ROOT_SIZE * 16.0 * 0x1p-24;
  const RayPlaces places = ray_places();
  tile.middle = floats_of(middle);
  tile.ahead = floats_of(ahead);
  tile.w_ahead = floats_of(w_ahead);
  tile.w_begin = static_cast<float>(w_begin);
  tile.slack = static_cast<float>(slack);
  tile.width = pixels.x;
  tile.height = pixels.y;
  for (int axis = 0; axis < 2; ++axis) {
    const auto i = static_cast<uint>(axis);
    const double unit = glm::length(parts[1 + axis]), scale = perspective ? unit / length : unit;
    const dvec3 across = parts[1 + axis] / unit;
    if (!(scale > 1e-30 && scale < 1e30)) return false;
    (axis == 0 ? tile.right : tile.down) = floats_of(across);
    tile.scale[i] = static_cast<float>(scale);
    tile.first[i] = static_cast<float>(places.low[axis] - half[axis]);
    tile.last[i] = static_cast<float>(places.high[axis] - half[axis]);
    const double low = (tile.first[i] - 0.01) / scale;
    const double high = (tile.last[i] + double(pixels[axis]) - 1.0 + 0.01) / scale;
    tile.planes[2 * i] = tile_plane(across - low * w_ahead, -low * w_begin, middle, slack);
    tile.planes[2 * i + 1] = tile_plane(high * w_ahead - across, high * w_begin, middle, slack);
  }
  tile.planes[4] = tile_plane(w_ahead, w_begin, middle, slack);
  return true;
}

/// Opens the tile of this group; null where its rays are traced one by one: with counters, which count that, and through a lens.
WideTile* open_group_tile() {
  thread_local std::unique_ptr<WideTile> kept;
  bool single = COUNTERS || group_number() >= frame.group_count;
#ifdef LIT
  single = single || (LENS && OUTPUT != OUTPUT_AOV);
#endif
  if (single) return nullptr;
  if (!kept) kept.reset(new WideTile);  // NOLINT: not filled with zeros, as make_unique does
  const uint word = group_list[group_number()];
  const uvec2 pixels = ORDER == ORDER_LINEAR ? uvec2(GROUP_SIZE, 1u) : uvec2(8u);
  const uvec2 first = uvec2(word & 0xFFFFu, word >> 16u) * pixels + uvec2(frame.tile_x, frame.tile_y);
  if (!set_tile_camera(first, pixels, *kept)) return nullptr;
  bound->functions.open_tile(bound->tree, *kept);
  return kept.get();
}

/// The place of this thread's pixel in the tile.
uint tile_slot() {
  const uvec2 in_group = tile_pixel(0u);
  return ORDER == ORDER_LINEAR ? in_group.x : in_group.y * 8u + in_group.x;
}

#ifndef LIT
/// Ends a pixel whose rays are known to meet nothing, without tracing them; false for others.
bool show_background(uvec2 in_tile) {
  if (tile_now == nullptr || tile_now->full || !pixel_is_empty(*tile_now) || OUTPUT == OUTPUT_AOV)
    return false;
  const bool alike = frame.background.x >= 0.0f || !ENVIRONMENT;
  const uvec2 pixel = in_tile + uvec2(frame.tile_x, frame.tile_y);
  const uint place = frame.tile_first + in_tile.y * frame.tile_width + in_tile.x;
  vec4 mean = mean_before(place);
  for (uint sample = frame.sample_begin; sample < frame.sample_end; ++sample) {
    const vec3 dir = alike ? vec3(0.0f) : sample_ray(pixel, sample).dir;
    mean = add_to_mean(mean, background_radiance(dir), 0.0f, sample);
  }
  keep_mean(place, mean);
  return true;
}
#endif
