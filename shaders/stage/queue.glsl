// Paths between two stages: packed together, so that lanes have one whose neighbours' have ended. Needs
// path.glsl and counters[].
#ifndef SPLATRAY_QUEUE_GLSL
#define SPLATRAY_QUEUE_GLSL
#extension GL_KHR_shader_subgroup_ballot : require

layout(binding = BIND_PATHS) uniform usamplerBuffer paths;
layout(std430, binding = BIND_PATHS_QUEUED) writeonly buffer QueuedPaths { PathState queued_paths[]; };

/// Puts a path into the next stage's queue.
void queue_path(Path path, uint place) {
  // One atomic for all lanes: threads wait for each other at each.
  uvec4 lanes = subgroupBallot(true);
  uint first = 0u;
  if (subgroupElect()) first = atomicAdd(counters[COUNT_QUEUED], subgroupBallotBitCount(lanes));
  uint slot = subgroupBroadcastFirst(first) + subgroupBallotExclusiveBitCount(lanes);
  queued_paths[slot].origin = path.ray.origin;
  queued_paths[slot].place = place;
  queued_paths[slot].dir = path.ray.dir;
  queued_paths[slot].inside = path.ray.inside;
  queued_paths[slot].from_normal = path.ray.from_normal;
  queued_paths[slot].from_object = path.ray.from_object;
  queued_paths[slot].throughput = path.throughput;
  queued_paths[slot].radiance = path.radiance;
#ifdef LIT
  queued_paths[slot].pdf = path.pdf;
#endif
}

/// A path of this stage's queue.
Path queued_path(uint index, OUT(uint) place) {
  int texel = int(PATH_TEXELS * index);
  uvec4 origin = texelFetch(paths, texel);
  uvec4 dir = texelFetch(paths, texel + 1);
  uvec4 from = texelFetch(paths, texel + 2);
  place = origin.w;
  Path path = path_start(secondary_ray(uintBitsToFloat(origin.xyz), uintBitsToFloat(dir.xyz), dir.w,
                                       uintBitsToFloat(from.xyz), from.w));
  uvec4 throughput = texelFetch(paths, texel + 3);
  path.throughput = uintBitsToFloat(throughput.xyz);
#ifdef LIT
  path.pdf = uintBitsToFloat(throughput.w);
#endif
  path.radiance = uintBitsToFloat(texelFetch(paths, texel + 4).xyz);
  path.bounce = frame.path_bounce;
  path.coverage = 1.0f;
  return path;
}

#endif
