/// What the fuzzers run: one function per kind of file, which reads the bytes as such a file. An Error is how readers
/// refuse a file; anything else (another exception, a broken promise, a sanitizer's report) is a finding and ends the
/// program.
#pragma once
#include <cstdint>
#include <span>

namespace splatray::testing {

using FuzzBytes = std::span<const std::uint8_t>;

/// read_scene on the bytes as they are, then on the same with the file's form and checksums put right, so that the
/// checks behind those are reached. What is read must unpack to finite splats and let rays walk it.
void fuzz_scene_file(FuzzBytes bytes);
/// read_input on a .ply; the points and triangles must be as preprocess/points.h says.
void fuzz_ply(FuzzBytes bytes);
/// read_input on a .gltf, or .glb where the bytes begin like one, with a file points.ply beside it; else like fuzz_ply.
void fuzz_gltf(FuzzBytes bytes);

}  // namespace splatray::testing
