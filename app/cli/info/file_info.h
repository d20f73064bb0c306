/// What a file holds, as splatray reads it, without a scene being built of it.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/base/bounds.h"
#include "preprocess/points.h"

namespace splatray {

/// The values of one attribute of points.
struct AttributeInfo {
  std::string name;
  std::string type;  ///< as splatray keeps it: uint8, uint16, float32, float64
  double low = 0.0, high = 0.0;
};

/// One scan, object or mesh of a file.
struct PartInfo {
  std::string name;
  std::uint64_t points = 0;  ///< of meshes: vertices
  std::uint64_t triangles = 0;
  std::optional<Station> station{};  ///< of scans
};

struct FileInfo {
  std::filesystem::path path;
  std::vector<FileFact> facts;  ///< of the file's head
  /// That are read of it; of meshes: vertices; with heads only: that the head counts.
  std::uint64_t points = 0;
  std::uint64_t triangles = 0;
  Bounds box;              ///< of finite positions, file coordinates
  bool from_head = false;  ///< points and box are as the head says
  std::string crs;         ///< Scene::crs
  ScanCounts counts;       ///< what reading left out of scans
  std::vector<AttributeInfo> attributes;
  std::map<std::uint32_t, std::uint64_t> classes;  ///< points of each; empty = the points have none
  std::vector<PartInfo> scans;                     ///< in the file's order
  std::vector<PartInfo> objects;                   ///< of scenes, and of files that are one object
  std::uint64_t lights = 0;
  bool has_camera = false;
  std::vector<std::string> notes;  ///< what is odd about the file, a sentence each
};

/// How files are looked at.
struct InfoOptions {
  bool heads_only = false;  ///< as ReadOptions has it
  std::string columns;      ///< as ScanOptions has them
};

/// Reads a file of any format that splatray reads, a .soct among them. Throws Error (input_unreadable).
[[nodiscard]] FileInfo read_info(const std::filesystem::path& path, const InfoOptions& asked,
                                 const Progress& progress);

/// The same for people, some lines, and as JSON, a list of all files.
[[nodiscard]] std::string info_text(const FileInfo& info);
[[nodiscard]] std::string info_json(const std::vector<FileInfo>& infos);

}  // namespace splatray
