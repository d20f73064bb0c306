/// What shaders/trace/blend.glsl declares with HOST: rays traced by the wide tree, which finds the hits that the octree finds.
/// After the programs' text, in the same namespace.

/// A splat where a ray hits it.
struct Meeting {
  uint splat;
  uvec4 words;
  PlaneHit hit;
};

/// Directions below PARALLEL are parallel to the planes of an axis: a finite inverse keeps NaN out of the boxes.
float inverse_of(float dir) {
  return 1.0f / (abs(dir) < PARALLEL ? (dir < 0.0f ? -PARALLEL : PARALLEL) : dir);
}

/// What the walk has computed of a splat of its leaf.
PlaneHit hit_of(const WideWalk& walk, uint lane) {
  const dvec3 from_center(walk.from_center[0][lane], walk.from_center[1][lane], walk.from_center[2][lane]);
  PlaneHit hit;
  hit.t = two_floats(walk.t[lane]);
  hit.rho_squared = two_floats(walk.rho_squared[lane]);
  hit.from_center = vec3(from_center);
  hit.from_center_low = vec3(from_center - dvec3(hit.from_center));
  hit.facing = float(walk.facing[lane]);
  return hit;
}

/// Sets a ray's numbers for hits with t in [t_in, t_end).
void set_ray(const Ray& ray, float t_in, float t_end, WideWalk& walk) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<uint>(axis);
    walk.origin[i] = ray.origin[axis];
    walk.origin_low[i] = ray.origin_low[axis];
    walk.dir[i] = ray.dir[axis];
    walk.inverse[i] = inverse_of(ray.dir[axis]);
    walk.begin[i] = walk.origin[i] * walk.inverse[i];
  }
  walk.t_min = max(ray.t_min, t_in);
  walk.t_max = t_end;
}

/// What rays of the group's pixels may meet; null: they are traced one by one. And the pixel's place in it.
__attribute__((tls_model("initial-exec"))) thread_local WideTile* tile_now = nullptr;
__attribute__((tls_model("initial-exec"))) thread_local uint slot_now = 0;

/// Whether the tile knows what a ray meets: those from the camera have left no object.
bool is_of_tile(const Ray& ray) {
  return tile_now != nullptr && !tile_now->full && ray.from_object == NO_OBJECT;
}

/// Whether it goes through its pixel, as slot_now has it.
[[maybe_unused]] bool is_in_pixel(const Ray& ray, const WideTile& tile) {
  const dvec3 place = dvec3(ray.origin) - dvec3(tile.middle[0], tile.middle[1], tile.middle[2]) +
                      dvec3(ray.dir) * double(ROOT_SIZE);
  const auto along = [&](const std::array<float, 3>& axis) {
    return glm::dot(dvec3(axis[0], axis[1], axis[2]), place);
  };
  const double w = tile.w_begin + along(tile.w_ahead);
  const glm::dvec2 at(tile.scale[0] * along(tile.right) / w - slot_now % tile.width,
                      tile.scale[1] * along(tile.down) / w - slot_now / tile.width);
  // Where pixels are tiny, float32 has less of a ray than they ask for; the slack is in lattice units.
  const glm::dvec2 more = 0.01 + glm::dvec2(tile.scale[0], tile.scale[1]) * (tile.slack / w);
  return at.x > tile.first[0] - more.x && at.y > tile.first[1] - more.y && at.x < tile.last[0] + more.x &&
         at.y < tile.last[1] + more.y;
}

/// Whether the tile has found out that its pixel's rays meet nothing.
bool pixel_is_empty(const WideTile& tile) { return tile.boxes == 0 && tile.count[slot_now] == 0; }

/// Where a ray of the tile is in its pixel's list.
WideCursor cursor_of(const Ray& ray, const WideTile& tile) {
  assert(is_in_pixel(ray, tile));
  WideCursor cursor{slot_now, 0.0f, 0.0f};
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<uint>(axis);
    cursor.begin += tile.ahead[i] * (ray.origin[axis] - tile.middle[i]);
    cursor.per_t += tile.ahead[i] * ray.dir[axis];
  }
  return cursor;
}

/// Calls visit(meeting) for the ray's hits with t in [t_in, t_end), all but those behind the least end that it returns, in no
/// strict order; `by_tile`: the ray is of the tile, and where that is full behind it, some may be missing.
template <class Visit>
void visit_hits(const Ray& ray, float t_in, float t_end, bool by_tile, Tally& tally, const Visit& visit) {
  const WideView& tree = bound->tree;
  WideWalk walk;
  set_ray(ray, t_in, t_end, walk);
  walk.stack[0] = {walk.t_min, tree.levels.levels, 0};
  walk.boxes_met = tree.levels.levels > 0 ? 1 : 0;
  WideCursor cursor{};
  if (by_tile) cursor = cursor_of(ray, *tile_now);
  while (uint met = by_tile ? bound->functions.step_tile(tree, *tile_now, cursor, walk)
                            : bound->functions.step(tree, walk)) {
    for (; met != 0; met &= met - 1) {
      const auto lane = static_cast<uint>(findLSB(met));
      Meeting meeting;
      meeting.splat = by_tile ? tile_now->part[cursor.part].splat[lane] : walk.leaf * WIDE + lane;
      meeting.words = splat_words(meeting.splat);
      meeting.hit = hit_of(walk, lane);
      if (ELLIPSES) meeting.hit = ellipse_hit(clip_word(meeting.splat), meeting.words, meeting.hit);
      if (hit_accepted(meeting.words, meeting.splat, meeting.hit, ray, t_in, INFINITY_F))
        walk.t_max = min(walk.t_max, visit(meeting));
    }
  }
  if (COUNTERS) {
    tally.leaves += walk.leaves;
    tally.node_steps += walk.nodes;
    tally.tests += walk.leaves * WIDE;
  }
}

/// Adds one; false where there are too many.
bool add_meeting(const Meeting& met, WideMeetings& all) {
  if (all.count == WIDE_MEETINGS) return false;
  const uint i = all.count++;
  all.t[i] = met.hit.t.x;
  all.t_low[i] = met.hit.t.y;
  all.rho_squared[i] = met.hit.rho_squared.x;
  for (int axis = 0; axis < 3; ++axis)
    all.from_center[static_cast<uint>(axis)][i] = met.hit.from_center[axis];
  all.normal[i] = met.words.z;
  all.radius_object[i] = met.words.w;
  all.splat[i] = met.splat;
  if (FIELDS) all.field[i] = field_word(met.splat);
  if (COLORS) all.color[i] = color_word(met.splat);
  return true;
}

/// Leaves out those with t of `end` and more.
void drop_behind(float end, WideMeetings& all) {
  uint kept = 0;
  const auto keep = [&](auto& values, uint from) { values[kept] = values[from]; };
  for (uint i = 0; i < all.count; ++i) {
    if (all.t[i] >= end) continue;
    for (auto* values : {&all.t, &all.t_low, &all.rho_squared}) keep(*values, i);
    for (auto* values : {&all.normal, &all.radius_object, &all.splat, &all.field, &all.color})
      keep(*values, i);
    for (OfMeetings<float>& values : all.from_center) keep(values, i);
    ++kept;
  }
  all.count = kept;
}

/// What a ray meets first, and how deep the window behind it is.
struct Found {
  First first;
  float depth;
  bool all;  ///< that may be of the cluster are among the meetings; else there were too many
};

/// Finds the first hit and, with BLEND_WINDOW, all meetings that may be of its cluster.
Found find_cluster(const Ray& ray, float kappa, bool by_tile, Tally& tally, WideMeetings& all) {
  Found found{no_first(), 0.0f, true};
  float end = ray.t_max, least_end = ray.t_max;
  all.count = 0;
  visit_hits(ray, -INFINITY_F, ray.t_max, by_tile, tally, [&](const Meeting& met) {
    const uvec4 before = found.first.words;
    take_first(met.splat, met.words, met.hit, found.first);
    if (BLEND == BLEND_ANY) return -INFINITY_F;
    if (BLEND == BLEND_NEAREST) return std::nextafter(found.first.t.x, INFINITY_F);
    if (found.first.words != before) {
      found.depth = window_depth(found.first, ray.dir, kappa);
      end = min(window_end(found.first, found.depth), ray.t_max);
      least_end = min(least_end, end);
    }
    if (!add_meeting(met, all)) {
      drop_behind(least_end, all);
      found.all = found.all && add_meeting(met, all);
    }
    return end;
  });
  // A first hit found later may have a window that reaches further than one that the walk has gone by.
  if (end > least_end) {
    drop_behind(least_end, all);
    visit_hits(ray, least_end, end, by_tile, tally, [&](const Meeting& met) {
      found.all = found.all && add_meeting(met, all);
      return end;
    });
  }
  return found;
}

/// What blending adds up beside normals, depth and colours, one meeting after the other.
void add_beside(const WideMeetings& all, [[maybe_unused]] const Ray& ray, uvec4 target, Cluster& cluster) {
  if (!WATCHES && !TEXTURE_LAYER && !TEXTURE_GLOW && !TEXTURE_COLOR && !TEXTURE_NORMAL) return;
  for (uint i = 0; i < all.count; ++i) {
    if (all.weight[i] == 0.0f) continue;
    const uvec4 words = splat_words(all.splat[i]);
    if (WATCHES) cluster.target_members += words == target ? 1u : 0u;
#ifdef LIT
    add_factors(cluster.factors, factors_at(all.splat[i]), all.weight[i]);
    if (TEXTURE_NORMAL)
      cluster.tilt +=
          ivec3(floor(tilt_at(all.splat[i], normal_against(words, ray.dir)) * all.weight[i] + vec3(0.5f)));
#endif
  }
}

Cluster blend_meetings(WideMeetings& all, const Found& found, const Ray& ray, uvec4 target) {
  const Window window = window_of(found.first, ray, found.depth);
  WideWindow wide;
  for (int axis = 0; axis < 3; ++axis) {
    wide.dir[static_cast<uint>(axis)] = ray.dir[axis];
    wide.normal[static_cast<uint>(axis)] = window.normal[axis];
  }
  wide.t = window.t.x;
  wide.t_low = window.t.y;
  wide.inverse_depth = window.inverse_depth;
  wide.back = window.back;
  wide.object = window.object;
  wide.fields = FIELDS;
  wide.leans = LEANS;
  wide.colors = COLORS;
  const WideSums sums = bound->functions.blend(all, wide);
  Cluster cluster = empty_cluster();
  cluster.weight = sums.weight;
  cluster.normal = {sums.normal[0], sums.normal[1], sums.normal[2]};
  cluster.depth = sums.depth;
  cluster.color = {sums.color[0], sums.color[1], sums.color[2]};
  cluster.members = sums.members;
  add_beside(all, ray, target, cluster);
  return cluster;
}

/// All that the ray hits, and what of it comes first.
Found count_hits(const Ray& ray, Tally& tally, Cluster& cluster) {
  Found found{no_first(), 0.0f, true};
  visit_hits(ray, -INFINITY_F, ray.t_max, /*by_tile=*/false, tally, [&](const Meeting& met) {
    take_first(met.splat, met.words, met.hit, found.first);
    cluster.members += 1u;
    return INFINITY_F;
  });
  return found;
}

/// What finish_hit makes of nothing found, as far as it is read.
Hit no_hit() {
  Hit hit{};
  hit.object = NO_OBJECT;
  hit.front = true;
  hit.t = hit.t_first = INFINITY_F;
  return hit;
}

/// A reference, as a copy would wait for the ray's numbers to be stored one by one.
Hit trace_watching(const Ray& given, float kappa, uvec4 target, Tally& tally) {
  const bool wide = !has_cluster() || (BLEND == BLEND_WINDOW && KERNEL == KERNEL_RIM);
  if (!wide) return trace_octree(given, kappa, target, tally);
  if (is_of_tile(given) && pixel_is_empty(*tile_now)) return no_hit();
  Ray ray = given;
  bool enters = true;
  float t_start = 0.0f;
  const float shift = clip_to_root(ray, enters, t_start);
  if (WATCHES) enters = enters && ray.t_max >= 0.0f;
  Found found{no_first(), 0.0f, true};
  Cluster cluster = empty_cluster();
  if (enters && BLEND == BLEND_COUNT) {
    found = count_hits(ray, tally, cluster);
  } else if (enters) {
    WideMeetings all;
    bool by_tile = false;
    do {
      by_tile = is_of_tile(given);
      found = find_cluster(ray, kappa, by_tile, tally, all);
    } while (by_tile && tile_now->full);
    if (!found.all) return trace_octree(given, kappa, target, tally);
    if (all.count > 0) cluster = blend_meetings(all, found, ray, target);
  }
  return finish_hit(ray, found.first, cluster, found.depth, shift, target);
}
