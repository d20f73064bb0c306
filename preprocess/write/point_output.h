/// Points on their way into a file.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "engine/base/progress.h"
#include "engine/file/atomic_file.h"
#include "preprocess/write/point_table.h"

namespace splatray {

/// A file that is written in blocks of rows, one a point.
class PointOutput {
 public:
  PointOutput(AtomicFile& file, const Progress& progress, std::size_t rows)
      : file_(file), progress_(progress), rows_(rows) {}

  void write(const std::string& bytes) { file_.write(bytes.data(), bytes.size()); }

  /// Writes what `add` appends of each row, in order; throws Error (interrupted) as the progress says. Of several passes over
  /// the rows this is the one from share `from` to share `to`.
  template <typename Add>
  void write_rows(const Add& add, double from = 0.0, double to = 1.0) {
    constexpr std::size_t BLOCK_BYTES = std::size_t{1} << 20;
    std::string block;
    for (std::size_t i = 0; i < rows_; ++i) {
      add(i, block);
      if (block.size() < BLOCK_BYTES && i + 1 < rows_) continue;
      report(from + (to - from) * static_cast<double>(i) / static_cast<double>(rows_));
      write(block);
      block.clear();
    }
  }

 private:
  void report(double share) const;

  AtomicFile& file_;
  const Progress& progress_;
  std::size_t rows_;
};

/// Appends a number as the bytes that a type has.
inline void append_value(ValueType type, double number, std::string& bytes) {
  const std::size_t at = bytes.size();
  bytes.resize(at + bytes_of(type));
  store_value(type, number, reinterpret_cast<unsigned char*>(bytes.data() + at));
}

/// The formats, each into a file that the caller commits (write_points.h).
void write_ply(const PointTable& table, PointOutput& out);
void write_las(const PointTable& table, PointOutput& out);
void write_csv(const PointTable& table, PointOutput& out);
void write_vtp(const PointTable& table, PointOutput& out);

}  // namespace splatray
