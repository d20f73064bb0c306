/// Scans in LAS and LAZ files.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/points.h"
#include "preprocess/read/bytes/byte_reader.h"
#include "preprocess/read/las/las_header.h"
#include "preprocess/read/las/las_vlrs.h"
#include "preprocess/read/las/laz/laz_chunks.h"
#include "preprocess/read/read_listener.h"

namespace splatray {

/// Reads LAS 1.0 to 1.5 with point formats 0 to 10, as they are or compressed by LASzip, COPC among them, whatever the
/// extension says. Positions are scale * integer + offset in double; z is up. Colours are as stored, of unknown scale.
/// Columns: intensity, class, return, returns, source, time, and those extra bytes and further fields
/// (las_further_fields.h) that `options.scans.attributes` names; others that are zero throughout are left out. Extra bytes are also where normals and radii come from (LasExtras). Besides the points it takes a few tens of megabytes.
///
/// A file that ends early, or whose compressed parts are damaged, gives what is whole, with a note, or is refused when
/// options.scans.strict. Throws Error (input_unreadable) for what is no such file.
[[nodiscard]] ScanFile read_las(const std::filesystem::path& path, const ReadOptions& options,
                                const ReadListener& listener);

/// The points of such a file some at a time, so that memory does not depend on how many there are.
class LasBatches {
 public:
  /// What a batch has at most, unless one chunk alone has more.
  static constexpr std::uint64_t MOST_POINTS = 2'000'000;

  /// Throws Error (input_unreadable) for what is no such file, and for compressed points whose chunks no table names. `options` must
  /// live as long as this.
  LasBatches(const std::filesystem::path& path, const ReadOptions& options, const ReadListener& listener);

  [[nodiscard]] std::size_t size() const { return batches_.size(); }
  [[nodiscard]] const LasHeader& header() const { return header_; }
  [[nodiscard]] std::string crs() const;                 ///< Scene::crs
  [[nodiscard]] std::optional<bool> in_degrees() const;  ///< as ScanFile has it
  /// The points of batch i < size(), as read_las gives them; what was left out is added to `counts`.
  [[nodiscard]] Points read(std::size_t i, ScanCounts& counts, const ReadListener& listener);

 private:
  struct Batch {
    std::uint64_t first, count;    ///< records
    std::vector<LazChunk> chunks;  ///< of compressed points
  };

  ByteReader in_;
  LasHeader header_;
  LasVlrs vlrs_;
  const ReadOptions& options_;
  std::vector<Batch> batches_;
};

}  // namespace splatray
