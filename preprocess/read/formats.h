/// The one table of file formats that preprocess reads: help, refusals, the viewer's drops and app/guide/formats.md follow it.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "preprocess/base/levels.h"
#include "preprocess/points.h"
#include "preprocess/read/read_listener.h"

namespace splatray {

/// One format. It has one of four readers, which throw Error (input_unreadable) with the file's name, or (interrupted).
struct Format {
  /// With their dots, in lower case, a blank between: ".gltf .glb"; or the whole name of a file that is always called so.
  std::string_view extensions;
  std::string_view contents;  ///< what is read, as the guide's table has it
  /// Reads a file that is one object; a mesh without triangles is a point set.
  Mesh (*read_mesh)(const std::filesystem::path& path, const ReadOptions& options,
                    const ReadListener& listener);
  /// Reads a file that is a scene.
  Input (*read_scene)(const std::filesystem::path& path, const ReadOptions& options,
                      const ReadListener& listener);
  /// Reads a file that is points alone: all such files make one object.
  ScanFile (*read_scan)(const std::filesystem::path& path, const ReadOptions& options,
                        const ReadListener& listener) = nullptr;
  /// How the points of such a file are in levels; empty where they are in none. Null: they never are.
  Levels (*read_levels)(const std::filesystem::path& path) = nullptr;
  /// Reads a file that names others, which stand in its place.
  std::vector<std::filesystem::path> (*read_list)(const std::filesystem::path& path) = nullptr;
};

[[nodiscard]] std::span<const Format> formats();

/// The format of a file by its extension or name, in any case; nullptr for one that is not in the table.
[[nodiscard]] const Format* find_format(const std::filesystem::path& path);

/// The levels of a file; empty for those without any. Throws Error (input_unreadable) where it cannot be read.
[[nodiscard]] Levels levels_of(const std::filesystem::path& path);

/// All extensions, a blank between; `meshes_only`: of files that are one object.
[[nodiscard]] std::string format_extensions(bool meshes_only = false);

}  // namespace splatray
