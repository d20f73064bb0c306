/// What shaders/trace/shadow.glsl declares with HOST, by the wide tree. After wide_trace.h.

#ifdef LIT
/// The see-through sheets and panes that the shadow ray traced meets.
thread_local std::vector<Meeting> sheets_met;
#endif

Passing trace_shadow(Ray ray, Tally& tally) {
  Passing passing = all_passing();
  ray.to_light = true;
  if (!(ray.t_max >= 0.0f)) return passing;
  if (REGION) clip_to_region(ray);
  if (!(ray.t_max >= 0.0f)) return passing;
  bool ends = false;
  const bool some = some_pass();
#ifdef LIT
  std::vector<Meeting>& met_through = sheets_met;
  met_through.clear();
#endif
  visit_hits(ray, 0.0f, ray.t_max, /*by_tile=*/false, tally, [&](const Meeting& met) {
    if (!some) {
      ends = true;
      return -INFINITY_F;
    }
#ifdef LIT
    if (OPACITY || (PANES && is_pane(material_at(splat_object(met.words))))) {
      met_through.push_back(met);
      return INFINITY_F;
    }
#endif
    ends = meet_passing(met.splat, met.words, met.hit, ray, passing);
    return ends ? -INFINITY_F : INFINITY_F;
  });
#ifdef LIT
  if (!ends && (OPACITY || PANES)) {
    std::sort(met_through.begin(), met_through.end(), [](const Meeting& a, const Meeting& b) {
      return df_less(a.hit.t, b.hit.t) || (a.hit.t == b.hit.t && words_less(a.words, b.words));
    });
    for (const Meeting& met : met_through) (void)meet_passing(met.splat, met.words, met.hit, ray, passing);
  }
#endif
  end_passing(ends, passing);
  return passing;
}
