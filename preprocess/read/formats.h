/// The one table of file formats that preprocess reads: help, refusals, the viewer's drops and app/guide/formats.md follow it.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "preprocess/points.h"
#include "preprocess/read/read_listener.h"

namespace splatray {

/// One format. It has one of three readers, which throw Error (input_unreadable) with the file's name, or (interrupted).
struct Format {
  std::string_view extensions;  ///< with their dots, in lower case, a blank between: ".gltf .glb"
  std::string_view contents;    ///< what is read, as the guide's table has it
  /// Reads a file that is one object; a mesh without triangles is a point set.
  Mesh (*read_mesh)(const std::filesystem::path& path, const ReadOptions& options,
                    const ReadListener& listener);
  /// Reads a file that is a scene.
  Input (*read_scene)(const std::filesystem::path& path, const ReadOptions& options,
                      const ReadListener& listener);
  /// Reads a file that is points alone: all such files make one object.
  ScanFile (*read_scan)(const std::filesystem::path& path, const ReadOptions& options,
                        const ReadListener& listener);
};

[[nodiscard]] std::span<const Format> formats();

/// The format of a file by its extension, in any case; nullptr for an extension that is not in the table.
[[nodiscard]] const Format* find_format(const std::filesystem::path& path);

/// All extensions, a blank between; `meshes_only`: of files that are one object.
[[nodiscard]] std::string format_extensions(bool meshes_only = false);

}  // namespace splatray
