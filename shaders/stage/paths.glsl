// Paths through the pixels of a dispatch: for each pixel and sample, camera -> path -> accumulation.
#ifndef SPLATRAY_PATHS_GLSL
#define SPLATRAY_PATHS_GLSL
#include "stage/pixels.glsl"

#ifdef LIT
#include "light/transport.glsl"
#else
#include "light/phong.glsl"
#endif

/// Of one path. Where the lights of a sample are spread over dispatches its rays are
/// counted once, the work of each dispatch always.
void add_counters(Path path, Tally tally) {
  bool once = frame.light_begin == 0u;
  count(COUNT_PRIMARY, once ? 1u : 0u);
  count(COUNT_HITS, once && path.coverage > 0.0f ? 1u : 0u);
  count(COUNT_SHADOW, path.shadow);
  count(COUNT_REFLECTED, once ? path.reflected : 0u);
  count(COUNT_REFRACTED, once ? path.refracted : 0u);
  count(COUNT_LEAKED, once ? path.leaked : 0u);
  count(COUNT_BOUNCE_LIMIT, once ? path.cut : 0u);
  count(COUNT_ENERGY_LOST, once ? uint(path.energy_lost * 1024.0f + 0.5f) : 0u);
#ifdef LIT
  count(COUNT_BELOW, path.below);
  count(COUNT_BELOW_ENERGY, uint(path.energy_below * 1024.0f + 0.5f));
#endif
  count(COUNT_LEAVES, tally.leaves);
  count(COUNT_NODE_STEPS, tally.node_steps);
  count(COUNT_TESTS, tally.tests);
  count(COUNT_LOST, tally.lost);
}

/// Whether the driver has stopped this thread's loops: Mesa's llvmpipe silently ends all loops of a thread after 65 535
/// iterations in all (LP_MAX_TGSI_LOOP_ITERATIONS). This one, which must run frame.loop_probe times, then runs once, or
/// twice where the compiler has moved its test. Not compared with the probe again, which compilers take for reached
/// behind the loop.
bool loops_were_cut() {
  uint iterations = 0u;
  do {
    iterations += 1u;
  } while (iterations < frame.loop_probe);
  return iterations < LOOP_PROBE / 2u;
}

/// Keeps a pixel's mean. A coverage that is not finite, and stays so, shows the host that it is wrong.
void keep_mean(uint place, vec4 mean) {
  accumulation[place] = loops_were_cut() ? vec4(vec3(mean), -INFINITY_F) : mean;
}

/// The samples of the dispatch at a pixel, whose mean is at a place in the accumulation. Called once in a program: drivers take
/// as long to read a second copy of the walk whether it is used or not.
void add_samples(uvec2 pixel, uint place) {
  uint pixel_number = pixel.y * frame.width + pixel.x;
  vec4 mean = mean_before(place);
#ifdef LIT
  vec4 albedo = OUTPUT == OUTPUT_BASE ? mean_before(albedo_place(place)) : vec4(0.0f);
#endif
  uint sample_index = frame.sample_begin;
  do {
    Tally tally = no_tally();
    Path path = path_start(sample_ray(pixel, sample_index));
    follow_path(path, pixel_number, sample_index, tally);
    mean = add_to_mean(mean, path.radiance, path.coverage, sample_index);
#ifdef LIT
    if (OUTPUT == OUTPUT_BASE) albedo = add_to_mean(albedo, path.base, path.coverage, sample_index);
#endif
    if (COUNTERS) add_counters(path, tally);
    sample_index += 1u;
  } while (sample_index < frame.sample_end);
  keep_mean(place, mean);
#ifdef LIT
  if (OUTPUT == OUTPUT_BASE) accumulation[albedo_place(place)] = albedo;
#endif
}

#endif
