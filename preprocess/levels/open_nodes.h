/// Nodes of levels whose records are not yet what they stay, as the nodes above them take some.
#pragma once
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "preprocess/levels/level_folder.h"
#include "preprocess/levels/level_nodes.h"

namespace splatray {

/// Records of a job in memory, and where they lie.
struct Records {
  const LevelJob& job;
  std::vector<unsigned char> bytes;
  std::vector<glm::uvec3> places;

  void append(std::span<const unsigned char> more);
  [[nodiscard]] std::vector<unsigned char> of(const RecordNumbers& numbers) const;
};

struct OpenNode {
  std::uint32_t level = 0;
  glm::uvec3 cell{0};
  std::vector<unsigned char> records;
  /// What stands for all points in the node where it is not read; of the root none.
  std::vector<unsigned char> means;
  std::filesystem::path rest;  ///< a file of further records, of a node that cannot be divided; empty: none
};

/// Writes nodes of a job, and keeps how many points each has.
class NodeWriter {
 public:
  NodeWriter(const LevelJob& job, const LevelFolder& folder) : job_(job), folder_(folder) {}

  /// The means, in cells of the node above it, of all points in a node, by those of the nodes below it or by its records.
  [[nodiscard]] std::vector<unsigned char> means_of(std::uint32_t level,
                                                    std::span<const unsigned char> records,
                                                    const TileSchema& schema) const;
  /// The node above some, which takes its sample from them; they are written.
  [[nodiscard]] OpenNode above(std::uint32_t level, const glm::uvec3& cell, std::vector<OpenNode>& children);
  /// Writes a node and its means.
  void write(const OpenNode& node);
  void write_means(const OpenNode& node);

  BuiltNodes built;

 private:
  const LevelJob& job_;
  const LevelFolder& folder_;
};

}  // namespace splatray
