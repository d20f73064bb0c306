/// Points and their attributes from records of LAS files.
#pragma once
#include <cstdint>
#include <vector>

#include "preprocess/points.h"
#include "preprocess/read/las/las_extra_bytes.h"
#include "preprocess/read/las/las_header.h"

namespace splatray {

/// Collects what records hold: positions, colours, intensity, class, returns, source and time, and the extra bytes that
/// are chosen. Points that are withheld or of the classes of noise (7, 18) are left out unless options keep them.
class LasColumns {
 public:
  /// What became of some records.
  struct Filled {
    std::size_t kept = 0;
    std::uint64_t withheld = 0;
    std::uint64_t noise = 0;
  };

  /// Columns of `extra` whose name is there already are left out.
  LasColumns(const LasHeader& header, LasExtras extra, const ScanOptions& options);

  /// Which bytes of a record are of use.
  [[nodiscard]] std::vector<bool> used_bytes() const;

  /// Expects `count` points in all; nothing of it is touched yet.
  void reserve(std::size_t count);
  /// Makes room for `count` more points and returns the place of the first.
  std::size_t grow(std::size_t count);
  /// Puts the points of `count` records at `at` and behind, close together; needs as much room. Other places may be filled
  /// by other threads meanwhile.
  Filled fill(const unsigned char* records, std::size_t count, std::size_t at);
  /// Moves `count` points from `from` to `to` <= `from`.
  void move(std::size_t from, std::size_t count, std::size_t to);
  /// Drops all points from `count` on.
  void cut(std::size_t count);
  [[nodiscard]] std::size_t size() const { return points_.size(); }
  /// Those that are there.
  [[nodiscard]] const Points& points() const { return points_; }

  /// The names of attributes with integers of 2^53 and more, which doubles round.
  [[nodiscard]] std::vector<std::string> rounded() const;

  /// All points; attributes that are zero throughout are left out unless options ask for them, normals and radii always.
  [[nodiscard]] Points take();

 private:
  template <class F>
  void for_each_array(F f);
  void fill_extra(const unsigned char* record, std::size_t at);

  LasHeader header_;
  LasFields fields_;
  LasExtras extra_;  ///< its columns beside the last ones
  bool keep_all_;
  std::vector<std::string> asked_;
  Points points_;
};

}  // namespace splatray
