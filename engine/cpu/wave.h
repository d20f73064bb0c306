/// Paths of a tile side by side: from bounce to bounce their rays are traced one by one, and what they find is shaded together
/// (wide/wide_light.h). After picture_tile.h, with LIT. What is not plain is shaded by the shaders' text, path by path.

/// Samples of a pixel that are followed together.
constexpr uint WAVE_SAMPLES = WIDE_PLACES / GROUP_SIZE;

/// A path on its way.
struct WavePath {
  Path path;
  Hit hit;
  uint slot;  ///< of its pixel among the wave's
  uint sample;
  Tally tally;
};

/// A pixel of the group, and the mean of its samples.
struct WavePixel {
  uint number;  ///< in the whole picture
  uint slot;    ///< in the tile
  uint place;   ///< in the accumulation
  uvec2 at;
  vec4 mean, albedo;
};

/// The paths of a group's pixels.
struct Wave {
  WideLight light;
  std::array<WavePixel, GROUP_SIZE> pixels;
  uint pixel_count;
  std::array<WavePath, WIDE_PLACES> paths;
  std::array<uint, WIDE_PLACES> shaded, escaped;  ///< the paths of vertices and escapes
  WideVertices vertices;
  WideEscapes escapes;
};

/// Whether the dispatch's paths are followed in waves: sheets that are see-through and splats that send out light want rays in between. The
/// vectors count an environment's numbers, four a texel, in 31 bits.
bool runs_in_waves() {
  const bool paths = LOOK == LOOK_LIT || LOOK == LOOK_CLAY;
  const bool counted = std::uint64_t{bound->environment_width} * bound->environment_height < 1U << 29U;
  return paths && counted && !OPACITY && !EMISSION && (LIGHTS || SKY || ENVIRONMENT);
}

/// Whether a surface is what WideVertices are on.
bool is_plain(const Hit& hit, const Path& path) {
  if (LOOK == LOOK_CLAY) return true;
  if (TEXTURE_LAYER || TEXTURE_GLOW || TEXTURE_COLOR || TEXTURE_NORMAL) return false;
  const Material& material = materials[min(hit.object, bound->last_material)];
  return material.metallic == 0.0f && material.coat == 0.0f && (material.flags & MATERIAL_DIELECTRIC) == 0u &&
         (!LOBE_SPECULAR || material.roughness * material.roughness >= ALPHA_LEAST) && path.ray.inside == 0u;
}

void set_vector(const vec3& value, uint i, VectorsOfPlaces& values) {
  for (int axis = 0; axis < 3; ++axis) values[static_cast<uint>(axis)][i] = value[axis];
}
vec3 vector_at(const VectorsOfPlaces& values, uint i) { return {values[0][i], values[1][i], values[2][i]}; }

void add_vertex(uint path, Wave& wave) {
  const WavePath& of = wave.paths[path];
  WideVertices& vertices = wave.vertices;
  const uint i = vertices.count++;
  wave.shaded[i] = path;
  vertices.pixel[i] = wave.pixels[of.slot].number;
  vertices.sample[i] = of.sample;
  vertices.bounce[i] = of.path.bounce;
  vertices.object[i] = min(of.hit.object, bound->last_material);
  set_vector(of.hit.normal, i, vertices.normal);
  set_vector(of.path.ray.dir, i, vertices.dir);
  set_vector(LOOK == LOOK_CLAY ? vec3(CLAY_ALBEDO) : materials[vertices.object[i]].base * of.hit.color, i,
             vertices.base);
}

/// Takes what a path's ray has found: ends the path, shades it, or has it shaded with others.
void take_hit(uint index, Wave& wave) {
  WavePath& of = wave.paths[index];
  Path& path = of.path;
  if (SIZES && meet_lights(path, of.hit)) return;
  if (!of.hit.found) {
    if (!ENVIRONMENT || sees_background(path)) return meet_environment(path);
    set_vector(path.ray.dir, wave.escapes.count, wave.escapes.dir);
    wave.escaped[wave.escapes.count++] = index;
  } else if (path.bounce > frame.max_bounces || !is_plain(of.hit, path)) {
    EmissionSample none = no_emission_sample();
    shade_hit(path, of.hit, wave.pixels[of.slot].number, of.sample, none, of.tally);
  } else {
    path.coverage = path.bounce == 0u ? 1.0f : path.coverage;
    add_vertex(index, wave);
  }
}

/// Places behind the last one of a vector are looked at, too.
template <class Value>
void fill_up(uint count, OfPlaces<Value>& values) {
  for (uint i = count; i % WIDE != 0; ++i) values[i] = Value{};
}

/// The light that a vertex looks for: wide_sky.h has it, or a lamp.
LightSample chosen_light(const WideVertices& vertices, uint i, const Hit& hit) {
  const vec3 random = vector_at(vertices.light_random, i);
  const Receiver receiver = receiver_at(hit.position, hit.plane, hit.object);
  if (!SKY || (frame.light_nodes != 0u && random.z >= frame.sky_share)) return light_sample(receiver, random);
  LightSample sky = no_light_sample(receiver);
  sky.dir = vector_at(vertices.light_dir, i);
  sky.pdf = vertices.light_pdf[i] * frame.sky_share;
  sky.radiance = vector_at(vertices.radiance, i) / sky.pdf;
  return sky;
}

/// Shades the vertices, and has their paths go on.
void shade_vertices(Wave& wave) {
  WideVertices& vertices = wave.vertices;
  fill_up(vertices.count, vertices.object);
  bound->functions.sample(wave.light, vertices);
  std::array<LightSample, WIDE_PLACES> lights;
  const bool lit = LIGHTS || SKY;
  for (uint i = 0; lit && i < vertices.count; ++i) {
    lights[i] = chosen_light(vertices, i, wave.paths[wave.shaded[i]].hit);
    set_vector(lights[i].dir, i, vertices.light_dir);
  }
  bound->functions.scatter(wave.light, vertices);
  for (uint i = 0; i < vertices.count; ++i) {
    auto& [path, hit, slot, sample, tally] = wave.paths[wave.shaded[i]];
    const vec3 base = vector_at(vertices.base, i);
    if (OUTPUT == OUTPUT_BASE && path.bounce == 0u) path.base = base;
    if (lit)
      take_light(path,
                 towards_light(hit, lights[i], vector_at(vertices.value, i), vertices.value_pdf[i],
                               path.ray.inside, takes_all_light(path.bounce)),
                 SHADOWS, tally);
    BsdfSample next;
    next.weight = vector_at(vertices.weight, i);
    next.pdf = vertices.next_pdf[i];
    next.event = BSDF_REFLECTED;
    go_on(path, hit, next, vector_at(vertices.next_dir, i), vertices.next_random[i],
          max(base.x, max(base.y, base.z)) > 0.0f);
  }
}

void end_escapes(Wave& wave) {
  bound->functions.escape(wave.light, wave.escapes);
  for (uint i = 0; i < wave.escapes.count; ++i)
    end_in_light(wave.paths[wave.escaped[i]].path, vector_at(wave.escapes.radiance, i),
                 wave.escapes.pdf[i] * frame.sky_share);
}

/// Follows all paths to their ends.
void follow_wave(uint count, Wave& wave) {
  bool any = count > 0u;
  while (any) {
    wave.vertices.count = wave.escapes.count = 0;
    for (uint i = 0; i < count; ++i) {
      WavePath& of = wave.paths[i];
      if (!of.path.alive) continue;
      slot_now = wave.pixels[of.slot].slot;
      of.hit = trace_nearest(of.path.ray, frame.kappa, of.tally);
      take_hit(i, wave);
    }
    if (wave.escapes.count > 0) end_escapes(wave);
    if (wave.vertices.count > 0) shade_vertices(wave);
    any = false;
    for (uint i = 0; i < count; ++i) any = any || wave.paths[i].path.alive;
  }
}

/// Adds samples [begin, end) of all pixels to their means.
void add_wave(uint begin, uint end, Wave& wave) {
  uint count = 0;
  for (uint slot = 0; slot < wave.pixel_count; ++slot)
    for (uint sample = begin; sample < end; ++sample)
      wave.paths[count++] = {
          path_start(sample_ray(wave.pixels[slot].at, sample)), {}, slot, sample, no_tally()};
  follow_wave(count, wave);
  for (uint i = 0; i < count; ++i) {
    const auto& [path, hit, slot, sample, tally] = wave.paths[i];
    WavePixel& pixel = wave.pixels[slot];
    pixel.mean = add_to_mean(pixel.mean, path.radiance, path.coverage, sample);
    if (OUTPUT == OUTPUT_BASE) pixel.albedo = add_to_mean(pixel.albedo, path.base, path.coverage, sample);
    if (COUNTERS) add_counters(path, tally);
  }
}

/// The pixels of the group that are in the picture.
void take_pixels(Wave& wave) {
  wave.pixel_count = 0;
  for (lane_now = 0; lane_now < GROUP_SIZE; ++lane_now) {
    uvec2 in_tile(0);
    if (!find_pixel(in_tile)) continue;
    const uvec2 at = in_tile + uvec2(frame.tile_x, frame.tile_y);
    const uint place = frame.tile_first + in_tile.y * frame.tile_width + in_tile.x;
    wave.pixels[wave.pixel_count++] = {at.y * frame.width + at.x,
                                       tile_slot(),
                                       place,
                                       at,
                                       mean_before(place),
                                       OUTPUT == OUTPUT_BASE ? mean_before(albedo_place(place)) : vec4(0.0f)};
  }
}

void run_wave(const KernelWork& work, uint group, Counts& counts) {
  thread_local std::unique_ptr<Wave> kept;
  if (!kept) kept = std::make_unique<Wave>();
  begin_group(work, group, counts);
  Wave& wave = *kept;
  take_pixels(wave);
  if (wave.pixel_count == 0u) return;
  wave.light = wide_light_of(work);
  tile_now = open_group_tile();
  for (uint begin = frame.sample_begin; begin < frame.sample_end; begin += WAVE_SAMPLES)
    add_wave(begin, min(begin + WAVE_SAMPLES, frame.sample_end), wave);
  tile_now = nullptr;
  for (uint slot = 0; slot < wave.pixel_count; ++slot) {
    const WavePixel& pixel = wave.pixels[slot];
    keep_mean(pixel.place, pixel.mean);
    if (OUTPUT == OUTPUT_BASE) accumulation[albedo_place(pixel.place)] = pixel.albedo;
  }
}
