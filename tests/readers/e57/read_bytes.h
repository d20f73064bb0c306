/// What the tests of E57 share: reading bytes, and a small scan.
#pragma once
#include "preprocess/read/e57/read_e57.h"
#include "tests/readers/e57/e57_writer.h"
#include "tests/readers/read_error.h"
#include "tests/temp_folder.h"

namespace splatray::testing {

/// What reading these bytes gives; notes are expected to be `note_count`.
inline ScanFile read_bytes(const std::string& bytes, std::size_t note_count = 0,
                           const ReadOptions& options = {}) {
  const TempFolder folder;
  std::vector<std::string> notes;
  ScanFile file = read_e57(folder.write("a.e57", bytes), options, {notes, options.progress});
  EXPECT_EQ(notes.size(), note_count) << (notes.empty() ? "" : notes[0]);
  return file;
}

/// Points of a line: (i + 1, 2 i, -i).
inline E57TestScan line_scan(int count) {
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> z;
  for (int i = 0; i < count; ++i) {
    x.push_back(i + 1.0);
    y.push_back(2.0 * i);
    z.push_back(-1.0 * i);
  }
  E57TestScan scan;
  scan.fields = {E57TestField::float64("cartesianX", x), E57TestField::float64("cartesianY", y),
                 E57TestField::float64("cartesianZ", z)};
  return scan;
}

/// 0, 1, ... to `count` values.
inline std::vector<std::int64_t> counted(int count) {
  std::vector<std::int64_t> values;
  for (int i = 0; i < count; ++i) values.push_back(i);
  return values;
}

}  // namespace splatray::testing
