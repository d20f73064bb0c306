/// Decodes the points of one E57 scan.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "preprocess/points.h"
#include "preprocess/read/e57/description.h"
#include "preprocess/read/e57/field_stream.h"
#include "preprocess/read/e57/packet_reader.h"
#include "preprocess/read/e57/scan_colors.h"
#include "preprocess/read/e57/scan_layout.h"
#include "preprocess/read/e57/scan_sensor.h"
#include "preprocess/read/read_listener.h"

namespace splatray {

/// Appends one scan's points, its station and its counts to a file's. Attributes that earlier scans lack are filled up before:
/// white, zero, no cell; what this one lacks is left to finish_scans.
class ScanDecoder {
 public:
  /// The arguments must live as long as this.
  ScanDecoder(const E57Scan& scan, const ScanLayout& layout, ScanColors& colors, ScanFile& file);

  /// Decodes all records of the section, or what is there of them; `listener` hears of the share. Throws Error
  /// (input_unreadable) for packets that are none, or (interrupted).
  void decode(PagedFile& pages, const E57Section& section, const ReadListener& listener);

  /// Points at the frame's very origin are dropped as no returns where they are more than 10 and more than a thousandth: so
  /// do programs store pulses that met nothing. Then the station is added with its sensor and grid. Sentences go to `notes`.
  void finish(std::vector<std::string>& notes);

 private:
  struct Source {
    FieldStream stream;
    std::vector<double> values;  ///< of the batch; of a constant, for ever
    bool is_constant;
  };

  void decode_ready(std::uint64_t most);
  void decode_batch(std::size_t count);
  void find_positions(std::size_t count);
  void append_colors();
  void append_normals();
  void append_columns();
  void append_cells(std::size_t count);
  void drop_origins();
  void set_grid(Station& station, std::vector<std::string>& notes);
  [[nodiscard]] const double* values(FieldIndex field) const {
    return sources_[source_of_[field]].values.data();
  }

  const E57Scan& scan_;
  const ScanLayout& layout_;
  ScanColors& colors_;
  ScanFile& file_;
  std::size_t first_;  ///< of this scan's points in the file's
  glm::dmat3 rotation_;
  std::vector<Source> sources_;
  std::vector<std::size_t> source_of_;  ///< by field; only of fields that are read
  std::vector<std::size_t> columns_;    ///< of the file, by the layout's
  std::uint64_t decoded_ = 0;
  std::uint64_t origins_ = 0;  ///< points at the frame's origin
  ScanBox box_;                ///< without these
  // State of the batch:
  std::vector<std::uint32_t> kept_;  ///< records that have a position
  std::vector<glm::dvec3> world_;    ///< beside kept_
  // State of the grid; up to finish(), Points::grid_cell holds the rows.
  std::vector<std::uint32_t> column_;  ///< of this scan's points
  std::uint32_t row_maximum_ = 0;      ///< of all records, with a position or without
  std::uint32_t column_maximum_ = 0;
};

/// Fills up what the last scans lack, and numbers the stations of points where there are several: `last_of_scan` holds the
/// number of points up to each scan's end.
void finish_scans(Points& points, const std::vector<std::size_t>& last_of_scan);

}  // namespace splatray
