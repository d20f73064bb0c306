/// What the fuzzers run: the one table of targets. A target reads bytes as one kind of file. An Error is how readers refuse
/// a file; anything else (another exception, a broken promise, a sanitizer's report) is a finding and ends the program.
#pragma once
#include <cstdint>
#include <span>
#include <string_view>

namespace splatray::testing {

using FuzzBytes = std::span<const std::uint8_t>;

/// read_scene on the bytes as they are, then on the same with the file's form and checksums put right, so that the
/// checks behind those are reached. What is read must unpack to finite splats and let rays walk it.
void fuzz_scene_file(FuzzBytes bytes);
/// read_input on a file with this extension; the points and triangles must be as preprocess/points.h says. Then build_and_show,
/// and read_input on it and a file of another format, some with points and some without, in both orders.
void fuzz_ply(FuzzBytes bytes);
void fuzz_obj(FuzzBytes bytes);
void fuzz_stl(FuzzBytes bytes);
void fuzz_vtp(FuzzBytes bytes);
/// The same on a legacy .vtk, or, where the bytes begin with `<`, a .vtu.
void fuzz_vtk(FuzzBytes bytes);
/// The same with the extra bytes that are called a, b, c and v; LAS or LAZ, by what the header says.
void fuzz_las(FuzzBytes bytes);
/// The same as the bytes are, and once more with the pages' checksums put right.
void fuzz_e57(FuzzBytes bytes);
void fuzz_pcd(FuzzBytes bytes);
/// The same on all bytes but the first, which says what file they are: `t` a .ptx, `s` a .pts, `b` a .bin, `c` a .txt
/// whose columns are asked for, anything else a .txt.
void fuzz_text(FuzzBytes bytes);
/// The same as for the others; .glb where the bytes begin like one, with a file points.ply beside it.
void fuzz_gltf(FuzzBytes bytes);
/// The same on all bytes but the first, which counts the extensions of formats() around: a format that has no target of its own
/// is fuzzed, too.
void fuzz_format(FuzzBytes bytes);
/// read_camera and read_camera_path; numbers must be finite, frames ascend.
void fuzz_camera(FuzzBytes bytes);
/// read_user_state: anything is read, nothing refused.
void fuzz_user_state(FuzzBytes bytes);
/// parse_command_line, which --from gives what a picture's metadata say.
void fuzz_command_line(FuzzBytes bytes);
/// read_environment and read_metadata on a .exr, .hdr or .png, by how the bytes begin.
void fuzz_image(FuzzBytes bytes);
/// join_tiles on one part of a picture, an EXR.
void fuzz_part(FuzzBytes bytes);

struct FuzzTarget {
  /// Of its folder in corpus/, its dictionary dictionaries/NAME.dict, and the argument of tests/fuzz/run.
  std::string_view name;
  void (*run)(FuzzBytes);
};

inline constexpr FuzzTarget FUZZ_TARGETS[] = {
    {"scene_file", fuzz_scene_file},
    {"ply", fuzz_ply},
    {"obj", fuzz_obj},
    {"stl", fuzz_stl},
    {"vtp", fuzz_vtp},
    {"vtk", fuzz_vtk},
    {"las", fuzz_las},
    {"e57", fuzz_e57},
    {"pcd", fuzz_pcd},
    {"text", fuzz_text},
    {"gltf", fuzz_gltf},
    {"format", fuzz_format},
    {"camera", fuzz_camera},
    {"user_state", fuzz_user_state},
    {"command_line", fuzz_command_line},
    {"image", fuzz_image},
    {"part", fuzz_part},
};

}  // namespace splatray::testing
