/// The scene file `.soct`: header, table of named sections, sections, end marker. Little-endian. Its arrays are the GPU buffer
/// images (shaders/layout.h).
///
/// Header, 48 bytes:
///   offset | type    | field
///        0 | char[4] | magic "SOCT"
///        4 | uint32  | version, 15
///        8 | uint32  | endianness mark 0x01020304
///       12 | uint32  | bytes of header and section table together
///       16 | uint64  | bytes of the file
///       24 | uint64  | XXH3-64 of header and section table, taken with this field zero
///       32 | uint32  | sections
///       36 | uint32  | bytes of a section entry, 64
///       40 | uint64  | zero
///
/// Section entry, 64 bytes:
///   offset | type     | field
///        0 | char[24] | name of letters, digits and _ . -, filled with zeros; no two are the same
///       24 | uint32   | type of its elements: 0 record, 1 uint8, 2 uint16, 3 float32, 4 float64, 5 uint32, 6 uvec4, 7 text
///       28 | uint32   | bytes of an element
///       32 | uint32   | 1: a reader that does not know the name passes the section over; 0: it refuses the file
///       36 | uint32   | zero
///       40 | uint64   | offset in the file
///       48 | uint64   | bytes
///       56 | uint64   | XXH3-64
/// Sections lie in the table's order, each at the next multiple of 16 bytes, gaps zero; the 8 bytes "SOCT.END" follow at the next
/// multiple of 16 and end the file.
///
/// Sections. Those with * are in every file, others where there is something to say:
///   name             | element | section
///   node_pool *      | uint32  | node words
///   begin_end *      | uint32  | Begin-End, one more than filled leaves
///   slab_pool *      | uint32  | slabs, one per filled leaf
///   reference_pool * | uint32  | reference pool
///   data_pool *      | uvec4   | splats
///   color_pool       | uint32  | colours, beside the splats
///   field_pool       | uint32  | normal fields, beside the splats
///   clip_pool        | uint32  | clip lines and ellipses, beside the splats
///   materials *      | record  | Material of layout.h, one per object
///   object_names *   | text    | beside the materials
///   root *           | record  | float64[3] lowest corner of the root, world; float64 world length of a lattice unit
///   build *          | record  | uint32 leaf size k, insertion (enum Insertion), probes per leaf, radius rule (enum RadiusRule);
///                    |         | float64 radius scale; uint64 samples taken on meshes, seed
///   world *          | record  | float64[3] up direction; float64[3] minimum, float64[3] maximum of the centres; float64 surface
///                    |         | area of the source meshes, world units^2, 0 = unknown
///   lights           | record  | uint32 kind, zero; float64[3] position; float32[3] power; uint32 zero; float64 size; float64[3]
///                    |         | half edges u, v, spot's axis; float64 inner angle, outer angle, range; world (SceneLight)
///   camera           | record  | float64[3] eye, target, up; float64 fov_y_deg, ortho_height; world (Camera)
///   environment      | text    | path of the environment map
///   crs              | text    | coordinate reference system
///   stations         | record  | float64[3] the scanner's place; uint32 is it known, rows, columns of its grid, was one found; float64 noise,
///                    |         | step of the coordinates, world, 0 = unknown (Station)
///   station_names    | text    | beside the stations
///   column_names     | text    | of column.0 and so on
///   column.0 ...     | 1 to 4  | values beside the splats, at most 32 columns
///   wide_nodes       | record  | WideNode (scene/wide/wide_node.h), the tree of programs on the host over the splats, which then lie in its
///                    |         | order; optional, another layout would have another name
/// A text ends with a zero byte, also the last of several. Records may be longer than a reader knows, which leaves their tail out, or
/// shorter (LEAST_BYTES of scene_records.h): what is not there is zero, and zero means what files without it do.
///
/// A new section or member of a record needs no new version. Versions 10 to 14, without names (old_scene_sections.h), are read.
#pragma once
#include <filesystem>

#include "engine/base/progress.h"
#include "engine/scene/scene.h"

namespace splatray {

/// The version of the files that are written.
inline constexpr std::uint32_t SCENE_FILE_VERSION = 15;

/// Writes to a temporary name beside `path`, then renames. Throws Error (failed) when it cannot, (interrupted) when
/// `progress`, called with the stage "writing", says so; leaves nothing behind.
void write_scene(const Scene& scene, const std::filesystem::path& path, const Progress& progress = {});

/// Reads and checks a whole scene file of version 10 to 15. What is large of it stays where it is, mapped (Scene::mapping). Refuses, as Error (input_unreadable) with path, found and expected: wrong
/// magic, another version (build again), foreign endianness, truncation at any byte, extra bytes, checksum mismatch, a missing
/// section, one that is not known and not optional, two of one name, and whatever find_scene_defect (scene_check.h) finds. Error
/// (interrupted) when `progress`, called with the stage "reading", says so.
[[nodiscard]] Scene read_scene(const std::filesystem::path& path, const Progress& progress = {});

}  // namespace splatray
