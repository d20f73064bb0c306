/// Scans some points at a time, in memory that does not depend on how many there are.
#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/points.h"
#include "preprocess/read/las/read_las.h"

namespace splatray {

/// All points of the inputs in batches, which are the same whenever they are read: those of LAS and LAZ some millions at a time, of other
/// formats a file at a time.
class PointBatches {
 public:
  /// Opens each file. Folders and lists stand for their files (input_files.h). Throws Error (input_unreadable), one sentence, for what is
  /// no scan, for coordinates in degrees, and for files of different coordinate systems. `options` must live as long as this.
  PointBatches(const std::vector<std::filesystem::path>& inputs, const ReadOptions& options);

  [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }
  [[nodiscard]] std::size_t size() const { return batches_.size(); }
  /// What the files say of their coordinates: the system, and what they all are multiples of, from where on (zero: of nothing).
  [[nodiscard]] const std::string& crs() const { return crs_; }
  [[nodiscard]] const glm::dvec3& step_world() const { return step_world_; }
  [[nodiscard]] const glm::dvec3& origin_world() const { return origin_world_; }
  /// The points of batch i < size().
  [[nodiscard]] Points read(std::size_t i);
  /// What the last pass over all batches left out, and what was odd, or is known of points and kept in no levels.
  [[nodiscard]] const ScanCounts& counts() const { return counts_; }
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

 private:
  struct Batch {
    std::size_t file, part;
  };

  void open(std::size_t file);
  void add_las(std::size_t file);
  /// Notes, once a file, what levels do not hold of it.
  void note_lost(const std::filesystem::path& path, const Points& points);
  void require_one_system(const std::filesystem::path& path, const std::string& crs, bool in_degrees);

  std::vector<std::filesystem::path> files_;
  const ReadOptions& options_;
  std::vector<Batch> batches_;
  std::string crs_;
  glm::dvec3 step_world_{0.0}, origin_world_{0.0};
  std::unique_ptr<LasBatches> las_;  ///< of the file `opened_`
  std::size_t opened_ = 0;
  ScanCounts counts_;
  std::vector<std::string> notes_;
};

}  // namespace splatray
