/// What shaders/trace/shadow.glsl declares with HOST, by the wide tree. After wide_trace.h.

#ifdef LIT
/// The see-through sheets that the shadow ray traced meets.
thread_local std::vector<Meeting> sheets_met;
#endif

vec3 trace_shadow(Ray ray, Tally& tally) {
  vec3 light = vec3(1.0f);
  if (!(ray.t_max >= 0.0f)) return light;
  if (REGION) clip_to_region(ray);
  if (!(ray.t_max >= 0.0f)) return light;
  uint passed = 0u;
  bool opaque = false;
#ifdef LIT
  std::vector<Meeting>& met_through = sheets_met;
  met_through.clear();
#endif
  visit_hits(ray, 0.0f, ray.t_max, /*by_tile=*/false, tally, [&](const Meeting& met) {
    if (TINTED && pass_glass(met.words, light, passed)) return INFINITY_F;
#ifdef LIT
    if (OPACITY) {
      met_through.push_back(met);
      return INFINITY_F;
    }
#endif
    opaque = true;
    return -INFINITY_F;
  });
  if (opaque) return vec3(0.0f);
#ifdef LIT
  if (OPACITY) {
    std::sort(met_through.begin(), met_through.end(), [](const Meeting& a, const Meeting& b) {
      return df_less(a.hit.t, b.hit.t) || (a.hit.t == b.hit.t && words_less(a.words, b.words));
    });
    Sheets sheets = no_sheets();
    for (const Meeting& met : met_through) meet_sheet(sheets, met.splat, met.words, met.hit, ray);
    light *= sheets.passed * sheet_passes(sheets.last) * sheet_passes(sheets.other);
  }
#endif
  return light;
}
