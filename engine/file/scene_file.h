/// The scene file `.soct`: header, table of sections, sections, end marker. Little-endian. The array sections are the
/// GPU buffer images (shaders/layout.h).
///
/// Header, 288 bytes:
///   offset | type      | field
///        0 | char[4]   | magic "SOCT"
///        4 | uint32    | version: 14 where the coordinate system, or a station's noise or step, is known, else 13 where a normal field is a constant term, else 12 where splats have texture factors (texture_factors.h), or lights a range or a cone, else 11
///      |           | where a light has a size, else 10
///        8 | uint32    | endianness mark 0x01020304
///       12 | uint32    | bytes of header and section table together, 1760
///       16 | uint64    | bytes of the file
///       24 | uint64    | XXH3-64 of header and section table, taken with this field zero
///       32 | uint64    | splats = entries of the data pool
///       40 | uint64    | references = entries of the reference pool
///       48 | uint64    | node words
///       56 | uint64    | filled leaves = entries of Begin-End - 1
///       64 | uint32    | objects = materials
///       68 | uint32    | lights
///       72 | uint32    | optional pools, a bit each: 1 colour pool, 2 normal fields, 4 clip lines; 256: some of
///      |           | these are ellipses
///       76 | uint32    | 1: there is a camera, 0: none
///       80 | uint64    | bytes of strings
///       88 | float64[3]| root's lowest corner, world
///      112 | float64   | world length of a lattice unit
///      120 | uint32    | leaf size k
///      124 | uint32    | insertion policy (enum Insertion)
///      128 | uint32    | probes per leaf
///      132 | uint32    | radius rule (enum RadiusRule)
///      136 | float64   | radius scale
///      144 | uint64    | samples taken on meshes
///      152 | uint64    | seed
///      160 | float64[3]| up direction, world
///      184 | float64[3]| bounding box of the centres, minimum, world
///      208 | float64[3]| ... maximum
///      232 | float64   | surface area of the source meshes, world units^2, 0 = unknown
///      240 | uint32    | stations
///      244 | uint32    | surfaces: as many as objects, or 0
///      248 | uint8[32] | columns' types: 1 uint8, 2 uint16, 3 float32, 4 float64; 0 behind the last
///      280 | uint32    | sections, 46
///      284 | uint32    | bytes of a section entry, 32
///
/// Section entry, 32 bytes: uint32 id, uint32 bytes of an element, uint64 offset in the file, uint64 bytes, uint64 XXH3-64.
///   id | element                       | bytes | section
///    1 | uint32                        |     4 | node pool
///    2 | uint32                        |     4 | Begin-End
///    3 | uint32                        |     4 | slabs, one per filled leaf
///    4 | uint32                        |     4 | reference pool
///    5 | uvec4                         |    16 | data pool
///    6 | uint32                        |     4 | colour pool, beside the data pool
///    7 | uint32                        |     4 | normal fields, beside the data pool
///    8 | uint32                        |     4 | clip lines, beside the data pool
///    9 | Material                      |    48 | materials
///   10 | uint32 kind, uint32 zero, float64[3] position, float32[3] power, uint32 zero | 48 | lights, world (SceneLight)
///      | from version 11 on also float64 size, float64[3] half edges u, v |   104 |
///      | from version 12 on also float64[3] spot's axis, float64 inner angle, outer angle, range | 152 |
///   11 | float64[3] eye, target, up, float64 fov_y_deg, ortho_height | 88 | camera, world
///   12 | float64[3] the scanner's place, uint32 is it known, uint32 rows, columns of its grid, uint32 zero | 40 | stations
///      | from version 14 on also float64 noise, float64 step of the coordinates, world, 0 = unknown | 56 |
///   13 | char                          |     1 | names, each ended by a zero byte: objects', the environment's path,
///      |                               |       | stations', columns'; from version 14 on the coordinate system's text
///   14 | Surface                       |    80 | surfaces, beside the materials
///   15 | a column's type               | 1 - 8 | columns, beside the data pool; up to 46
/// Sections lie in this order, each at the next multiple of 16 bytes, gaps zero; the 8 bytes "SOCT.END" follow at the next
/// multiple of 16 and end the file.
#pragma once
#include <filesystem>

#include "engine/base/progress.h"
#include "engine/scene/scene.h"

namespace splatray {

/// The versions of files with what those before do not know: coordinate systems, noise and steps of scans; constant terms of normal fields; texture factors among the
/// columns, spots and lights with a range; lights that have a size. All others are of version 10, byte for byte.
inline constexpr std::uint32_t SCENE_FILE_VERSION = 14, LEANING_SCENE_FILE_VERSION = 13,
                               TEXTURED_SCENE_FILE_VERSION = 12, SIZED_SCENE_FILE_VERSION = 11,
                               PLAIN_SCENE_FILE_VERSION = 10;

/// Writes to a temporary name beside `path`, then renames. Throws Error (failed) when it cannot, (interrupted) when
/// `progress`, called with the stage "writing", says so; leaves nothing behind.
void write_scene(const Scene& scene, const std::filesystem::path& path, const Progress& progress = {});

/// Reads and checks a whole scene file. Refuses, as Error (input_unreadable) with path, found and expected: wrong magic, another
/// version (those before 10 are not read: build again), foreign endianness, truncation at any byte, extra bytes, checksum
/// mismatch, and whatever find_scene_defect (scene_check.h) finds. Error (interrupted) when `progress`, called with the stage
/// "reading", says so.
[[nodiscard]] Scene read_scene(const std::filesystem::path& path, const Progress& progress = {});

}  // namespace splatray
