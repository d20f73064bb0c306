// Paths through the pixels of a dispatch: for each pixel and sample, camera -> path -> accumulation. On CPU devices
// (STAGED) also in wavefront stages (Laine, Karras and Aila 2013, "Megakernels Considered Harmful"), one ray of each path in
// each: lanes of CPU devices, which wait for each other's branches and loops, otherwise stay idle once their path has
// ended.
#ifndef SPLATRAY_PATHS_GLSL
#define SPLATRAY_PATHS_GLSL
#include "stage/pixels.glsl"

#ifdef LIT
#include "light/transport.glsl"
#else
#include "light/phong.glsl"
#endif

#ifdef STAGED
#include "stage/queue.glsl"
#endif

/// Of one path, or of what one stage added to it. Where the lights of a sample are spread over dispatches its rays are
/// counted once, the work of each dispatch always.
void add_counters(Path path, Tally tally) {
  bool once = frame.light_begin == 0u;
  bool first = once && STAGE != STAGE_NEXT;
  count(COUNT_PRIMARY, first ? 1u : 0u);
  count(COUNT_HITS, first && path.coverage > 0.0f ? 1u : 0u);
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

/// What a thread traces: a pixel and, in STAGE_NEXT, its queued path.
struct Work {
  uvec2 pixel;
  uint place;  ///< in the accumulation buffer
  Path path;
};

/// Whether this thread has something to trace, and what.
bool find_work(OUT(Work) work) {
  uvec2 in_tile = uvec2(0u);
  bool found = false;
#ifdef STAGED
  if (STAGE == STAGE_NEXT) {
    uint queued = group_number() * GROUP_SIZE + gl_LocalInvocationIndex;
    found = queued < frame.path_count;
    work.path = queued_path(min(queued, frame.path_count - 1u), work.place);
    uint index = work.place - frame.tile_first;
    in_tile.y = index / frame.tile_width;
    in_tile.x = index - in_tile.y * frame.tile_width;
  } else
#endif
  {
    found = find_pixel(in_tile);
    work.place = frame.tile_first + in_tile.y * frame.tile_width + in_tile.x;
  }
  work.pixel = in_tile + uvec2(frame.tile_x, frame.tile_y);
  return found;
}

/// The samples of the dispatch at a pixel; in a stage one ray of its one sample. Called once in a program: drivers take as long
/// to read a second copy of the walk whether it is used or not.
void add_samples(INOUT(Work) work) {
  uint pixel_number = work.pixel.y * frame.width + work.pixel.x;
  vec4 mean = STAGE == STAGE_NEXT ? vec4(0.0f) : mean_before(work.place);
  uint sample_index = frame.sample_begin;
  do {
    Tally tally = no_tally();
    if (STAGE != STAGE_NEXT) work.path = path_start(sample_ray(work.pixel, sample_index));
    follow_path(work.path, pixel_number, sample_index, tally);
#ifdef STAGED
    if (STAGE != STAGE_ALL && work.path.alive) queue_path(work.path, work.place);
#endif
    if (!work.path.alive) {
      if (STAGE == STAGE_NEXT) mean = accumulation[work.place];
      mean = add_to_mean(mean, work.path.radiance, work.path.coverage, sample_index);
    }
    if (COUNTERS) add_counters(work.path, tally);
    sample_index += 1u;
  } while (sample_index < frame.sample_end);
  if (STAGE != STAGE_NEXT || !work.path.alive) keep_mean(work.place, mean);
}

#endif
