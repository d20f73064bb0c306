// The pools that rays read, a row each, and nowhere else: numbers of bindings (layout.h), declarations and readers on devices
// (scene/bindings.glsl), on the host (engine/cpu/bindings_as_cpp.h) and in tests (tests/trace/twin.cpp), sections of the file,
// checks, uploads, JSON and panels (engine/scene/pool/pool_table.h) are made of these rows. A new row comes last of its kind in a
// scene's.
//   SPLATRAY_POOL(place, NAME, pool, Value, reader, ABOUT): a member of Scene of this name, in every scene
//   SPLATRAY_OPTIONAL_POOL(..., HAS, bit, ABOUT): that a scene may be without; shaders ask whether the pipeline HAS it, FEATURE_HAS
//   SPLATRAY_MADE_POOL(place, NAME, pool, Value, reader, ABOUT): made of the scene when it is uploaded
// `place` counts the rows, BIND_NAME follows from it; `Value` is uint or uvec4; ABOUT is what PoolTraits (pool_table.h) is made
// of.
#ifndef SPLATRAY_OPTIONAL_POOL
#define SPLATRAY_OPTIONAL_POOL(place, NAME, pool, Value, reader, HAS, bit, ABOUT) \
  SPLATRAY_POOL(place, NAME, pool, Value, reader, ABOUT)
#endif
#ifndef SPLATRAY_MADE_POOL
#define SPLATRAY_MADE_POOL(place, NAME, pool, Value, reader, ABOUT) SPLATRAY_POOL(place, NAME, pool, Value, reader, ABOUT)
#endif
SPLATRAY_POOL(0u, NODE_POOL, node_pool, uint, node_word, ("node pool", "node words", PoolLength::nodes))
SPLATRAY_POOL(1u, BEGIN_END, begin_end, uint, begin_end_at, ("Begin-End", "leaf ends", PoolLength::leaf_ends))
SPLATRAY_POOL(2u, SLAB_POOL, slab_pool, uint, slab_word, ("pool of slabs", "slabs", PoolLength::leaves))
SPLATRAY_POOL(3u, REFERENCE_POOL, reference_pool, uint, reference_word, ("reference pool", "references", PoolLength::references))
SPLATRAY_POOL(4u, DATA_POOL, data_pool, uvec4, splat_words, ("data pool", "splats", PoolLength::splats))
SPLATRAY_OPTIONAL_POOL(5u, COLOR_POOL, color_pool, uint, color_word, COLORS, 4u, ("colour pool", "colours", PoolLength::splats))
SPLATRAY_OPTIONAL_POOL(6u, FIELD_POOL, field_pool, uint, field_word, FIELDS, 8u,
                       ("pool of normal fields", "normal fields", PoolLength::splats))
SPLATRAY_OPTIONAL_POOL(7u, CLIP_POOL, clip_pool, uint, clip_word, CLIPS, 262144u,
                       ("pool of clip lines", "clip lines", PoolLength::splats))
SPLATRAY_MADE_POOL(8u, TEXTURE_POOL, texture_pool, uint, texture_word, ("texture pool", "texture words", PoolLength::splats))
SPLATRAY_MADE_POOL(9u, TOP_TABLE, top_table, uint, top_entry, ("top table", "cells", PoolLength::nodes))
#undef SPLATRAY_POOL
#undef SPLATRAY_OPTIONAL_POOL
#undef SPLATRAY_MADE_POOL
