/// What shaders/trace/shadow.glsl declares with HOST, by the wide tree. After wide_trace.h.

vec3 trace_shadow(Ray ray, Tally& tally) {
  vec3 light = vec3(1.0f);
  if (!(ray.t_max >= 0.0f)) return light;
  uint passed = 0u;
  bool opaque = false;
  meetings.clear();
  visit_hits(ray, 0.0f, ray.t_max, tally, [&](const Meeting& met) {
    if (TINTED && pass_glass(met.words, light, passed)) return INFINITY_F;
#ifdef LIT
    if (OPACITY) {
      meetings.push_back(met);
      return INFINITY_F;
    }
#endif
    opaque = true;
    return -INFINITY_F;
  });
  if (opaque) return vec3(0.0f);
#ifdef LIT
  if (OPACITY) {
    std::sort(meetings.begin(), meetings.end(), [](const Meeting& a, const Meeting& b) {
      return df_less(a.hit.t, b.hit.t) || (a.hit.t == b.hit.t && words_less(a.words, b.words));
    });
    Sheets sheets = no_sheets();
    for (const Meeting& met : meetings) meet_sheet(sheets, met.splat, met.words, ray);
    light *= sheets.passed * sheet_passes(sheets.last) * sheet_passes(sheets.other);
  }
#endif
  return light;
}
