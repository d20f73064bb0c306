/// What shaders/trace/blend.glsl declares with HOST: rays traced by the wide tree, which finds the hits that the octree finds. After the
/// programs' text, in the same namespace.

/// A splat where a ray hits it.
struct Meeting {
  uint splat;
  uvec4 words;
  PlaneHit hit;
};

/// The hits of the ray traced that may be of its cluster, or of see-through sheets; kept for its memory.
thread_local std::vector<Meeting> meetings;

/// Directions below this are parallel to the planes of an axis: a finite inverse keeps NaN out of the boxes.
float inverse_of(float dir) { return 1.0f / (abs(dir) < PARALLEL ? (dir < 0.0f ? -PARALLEL : PARALLEL) : dir); }

/// Calls visit(meeting) for the ray's hits in [t_in, t_end), all but those behind the least end that it returns, in no strict order;
/// those behind it that it has met none the less.
template <class Visit>
void visit_hits(const Ray& ray, float t_in, float t_end, Tally& tally, const Visit& visit) {
  const WideView& tree = bound->tree;
  WideWalk walk;
  walk.origin = {ray.origin.x, ray.origin.y, ray.origin.z};
  walk.dir = {ray.dir.x, ray.dir.y, ray.dir.z};
  walk.inverse = {inverse_of(ray.dir.x), inverse_of(ray.dir.y), inverse_of(ray.dir.z)};
  walk.t_min = max(ray.t_min, t_in);
  walk.t_max = t_end;
  walk.stack[0] = {walk.t_min, tree.levels, 0};
  walk.boxes_met = tree.levels > 0 ? 1 : 0;
  while (true) {
    const WideStep step = bound->stepper(tree, walk);
    if (step.candidates == 0) break;
    for (uint left = step.candidates; left != 0; left &= left - 1) {
      const uint splat = step.leaf->splat[static_cast<uint>(findLSB(left))];
      const Meeting met{splat, splat_words(splat), {}};
      PlaneHit hit = meet_splat(splat, met.words, ray);
      if (hit_accepted(met.words, splat, hit, ray, t_in, INFINITY_F)) walk.t_max = min(walk.t_max, visit({splat, met.words, hit}));
    }
  }
  if (COUNTERS) {
    tally.leaves += walk.leaves;
    tally.node_steps += walk.nodes;
    tally.tests += walk.leaves * WIDE;
  }
}

/// Finds the first hit and, with BLEND_WINDOW, all that may be of its cluster. Returns the cluster's depth.
float find_cluster(const Ray& ray, float kappa, Tally& tally, First& first) {
  meetings.clear();
  float depth = 0.0f, end = ray.t_max, least_end = ray.t_max;
  visit_hits(ray, -INFINITY_F, ray.t_max, tally, [&](const Meeting& met) {
    const uint before = first.splat;
    const bool found = first.measure.x < INFINITY_F;
    take_first(met.splat, met.words, met.hit, true, first);
    if (BLEND == BLEND_NEAREST) return std::nextafter(first.t.x, INFINITY_F);
    meetings.push_back(met);
    if (!found || first.splat != before) {
      depth = window_depth(first, ray.dir, kappa);
      end = min(window_end(first, depth), ray.t_max);
      least_end = min(least_end, end);
    }
    return end;
  });
  // A first hit found later may have a window that reaches further than one that the walk has gone by.
  if (end > least_end) {
    std::erase_if(meetings, [&](const Meeting& met) { return met.hit.t.x >= least_end; });
    visit_hits(ray, least_end, end, tally, [&](const Meeting& met) {
      meetings.push_back(met);
      return end;
    });
  }
  return depth;
}

Hit trace_watching(Ray ray, float kappa, uvec4 watched, Tally& tally) {
  if (BLEND == BLEND_PAPER || BLEND == BLEND_LEAF) return trace_octree(ray, kappa, watched, tally);
  bool enters = true;
  float t_start = 0.0f;
  const float shift = clip_to_root(ray, enters, t_start);
  if (WATCHES) enters = enters && ray.t_max >= 0.0f;
  First first = no_first();
  Cluster cluster = empty_cluster();
  float depth = 0.0f;
  if (enters) depth = find_cluster(ray, kappa, tally, first);
  if (BLEND != BLEND_NEAREST && enters) {
    const Window window = window_of(first, ray, depth);
    for (const Meeting& met : meetings)
      add_to_cluster(met.splat, met.words, met.hit, ray, -INFINITY_F, INFINITY_F, window, watched, cluster);
  }
  return finish_hit(ray, first, cluster, depth, shift, watched);
}
