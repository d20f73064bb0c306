/// Scene files of versions 10 to 14, whose sections have places in place of names: header, table of 46 sections, sections, end marker,
/// little-endian, as scene_file.h has it otherwise.
///
/// Header, 288 bytes, the first 32 as in scene_file.h:
///   offset | type      | field
///       12 | uint32    | bytes of header and section table together, 1760
///       32 | uint64    | splats = entries of the data pool
///       40 | uint64    | references = entries of the reference pool
///       48 | uint64    | node words
///       56 | uint64    | filled leaves = entries of Begin-End - 1
///       64 | uint32    | objects = materials
///       68 | uint32    | lights
///       72 | uint32    | optional pools, a bit each: 1 colour pool, 2 normal fields, 4 clip lines; 256: some of these are ellipses
///       76 | uint32    | 1: there is a camera, 0: none
///       80 | uint64    | bytes of strings
///       88 | 32 bytes  | "root" of scene_file.h
///      120 | 40 bytes  | "build"
///      160 | 80 bytes  | "world"
///      240 | uint32    | stations
///      244 | uint32    | surfaces: as many as objects, or 0
///      248 | uint8[32] | columns' types: 1 uint8, 2 uint16, 3 float32, 4 float64; 0 behind the last
///      280 | uint32    | sections, 46
///      284 | uint32    | bytes of a section entry, 32
///
/// Section entry, 32 bytes: uint32 id, uint32 bytes of an element, uint64 offset in the file, uint64 bytes, uint64 XXH3-64. All else
/// follows from the header's counts.
///    id    | section
///   1 - 8  | the pools, in the order of scene_file.h
///    9     | "materials", OldMaterialRecord
///   10     | "lights", of version 10 the first 48 bytes of a record, of 11 the first 104, then all 152
///   11     | "camera"
///   12     | "stations", before version 14 the first 40 bytes of a record
///   13     | strings, each ended by a zero byte: objects' names, the environment, stations' names, columns' names; of version 14
///          | also the coordinate system
///   14     | "surfaces", the first 80 bytes of layout.h's Material but for the last 4, which are zero; none: those that follow from the
///          | materials
///  15 - 46 | columns
#pragma once
#include "engine/file/scene_sections.h"

namespace splatray::scene_file {

inline constexpr std::uint32_t OLDEST_VERSION = 10, LAST_VERSION_WITHOUT_NAMES = 14;

/// An old file by the names of today.
struct OldScene {
  SectionTable table;
  bool ellipses;  ///< the header says that some clip lines are ellipses
};

/// What LOOK_PAPER sees of an object, and what all looks do.
struct OldMaterialRecord {
  static constexpr std::uint32_t LEAST_BYTES = 48;
  vec3 diffuse;
  float specular;
  vec3 tint;
  float shininess, mirror, ior;
  std::uint32_t flags, mask_bit;
};

/// The materials of a file whose "materials" are such records. Refuses another number of surfaces.
[[nodiscard]] std::vector<Material> read_old_materials(SceneInput& input, SectionReader& sections);

/// `head`: header and table, whose checksum is right. Refuses what contradicts itself, and strings with another checksum.
[[nodiscard]] OldScene read_old_table(SceneInput& input, const std::vector<char>& head);

}  // namespace splatray::scene_file
