/// The files of an octree in the making: `ept.json`, its folders, and beside them, until it is there, `ept-build`.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "preprocess/levels/level_plan.h"
#include "preprocess/read/tiles/tile_schema.h"

namespace splatray {

/// What all steps follow.
struct LevelJob {
  LevelPlan plan;
  TileSchema schema;
  std::string crs;  ///< Scene::crs
  std::uint64_t points = 0;
  glm::dvec3 box_low{0.0}, box_high{0.0};   ///< of the points
  std::vector<Station> stations;            ///< those that know where the scanner was; grids are not kept
  std::vector<std::size_t> first_stations;  ///< of each batch, the number of its first
  std::string source;  ///< what the points came from, and how they are read: another makes another job
};

/// How far the points have been divided.
struct DividedSoFar {
  std::size_t batches = 0;
  std::vector<std::uint64_t> bytes;  ///< of each part
};

/// Points of nodes, by the nodes' names ("1-0-1-1").
using NodeCounts = std::map<std::string, std::uint64_t>;

struct BuiltNodes {
  NodeCounts points;
  NodeCounts means;  ///< that stand for nodes which are not read; there are none of the root

  void add(const BuiltNodes& more) {
    points.insert(more.points.begin(), more.points.end());
    means.insert(more.means.begin(), more.means.end());
  }
};

[[nodiscard]] std::string node_name(std::uint32_t level, const glm::uvec3& cell);

class LevelFolder {
 public:
  /// The files beside an `ept.json` that is made.
  explicit LevelFolder(const std::filesystem::path& ept_json);

  [[nodiscard]] const std::filesystem::path& ept_json() const { return ept_json_; }
  /// A node's file, and where a part's top waits until it has been thinned for the nodes above it.
  [[nodiscard]] std::filesystem::path node(const std::string& name) const;
  [[nodiscard]] std::filesystem::path top(std::size_t part) const;
  /// Further records of a part's top that cannot be divided.
  [[nodiscard]] std::filesystem::path rest(std::size_t part) const;
  /// What stands for a node.
  [[nodiscard]] std::filesystem::path means(const std::string& name) const;
  /// Records of a part, or of some node in it, that are not built.
  [[nodiscard]] std::filesystem::path records(std::size_t part, const std::string& node = "") const;

  /// Nothing where there is none. All that read throw Error (input_unreadable) for what is damaged.
  [[nodiscard]] std::optional<LevelJob> job() const;
  /// Makes the folders where they are missing, too. All that write throw Error (failed).
  void keep(const LevelJob& job) const;
  [[nodiscard]] DividedSoFar divided(std::size_t parts) const;
  void keep(const DividedSoFar& divided) const;
  /// The nodes of a part that is built.
  [[nodiscard]] std::optional<BuiltNodes> nodes_of(std::size_t part) const;
  void keep(std::size_t part, const BuiltNodes& nodes) const;

  /// Writes the hierarchy and, last, `ept.json`, and removes what was only needed to make it.
  void finish(const LevelJob& job, const BuiltNodes& nodes) const;

 private:
  std::filesystem::path ept_json_, folder_, build_;
};

/// Writes a whole file without waiting for the disk, or appends to it. Throws Error (failed) where that fails.
void write_records(std::span<const unsigned char> bytes, const std::filesystem::path& path,
                   bool append = false);
/// Throws Error (input_unreadable) where it cannot be read.
[[nodiscard]] std::vector<unsigned char> read_records(const std::filesystem::path& path);

}  // namespace splatray
