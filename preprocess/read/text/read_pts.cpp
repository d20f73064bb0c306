#include "preprocess/read/text/read_pts.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/read/scan/missing_points.h"
#include "preprocess/read/text/read_expe_points.h"
#include "preprocess/read/text/read_xyz.h"
#include "preprocess/read/text/row_reader.h"
#include "preprocess/read/text/survey_rows.h"
#include "preprocess/read/text/text_layout.h"

namespace splatray {
namespace {

constexpr double MOST_COUNT = 4294967296.0;  ///< of a block; sums stay within 64 bits

class PtsReader {
 public:
  PtsReader(const std::filesystem::path& path, const ReadOptions& options, const ReadListener& listener)
      : path_(path), options_(options), listener_(listener), rows_(path, listener, form_of_rows(path)) {}

  ScanFile read() {
    RowRun run;
    while (rows_.next(run)) {
      if (run.width != 1) {
        read_points(run);
        continue;
      }
      for (std::size_t i = 0; i < run.rows; ++i) {
        end_block();
        begin_block(run.row(i)[0], run.first_line + i);
      }
    }
    end_block();
    ScanFile file;
    std::vector<std::string> said;
    file.points = points_.take(said);
    for (const std::string& sentence : said) listener_.note(path_, sentence);
    file.counts = counts_;
    report_missing(path_, counts_, options_.scans, listener_);
    return file;
  }

 private:
  void begin_block(double count, std::uint64_t line) {
    if (!(count >= 0.0 && count < MOST_COUNT && count == std::floor(count)))
      rows_.fail(line,
                 "found one number, expected the count of points or " + std::string(SurveyRows::EXPECTED));
    counted_ = true;
    declared_ = static_cast<std::uint64_t>(count);
    count_line_ = line;
  }

  void read_points(const RowRun& run) {
    if (!SurveyRows::is_width(run.width))
      rows_.fail(run.first_line, "found " + std::to_string(run.width) + " numbers, expected " +
                                     std::string(SurveyRows::EXPECTED));
    points_.judge(run, counted_);
    const std::optional<std::size_t> n = points_.normal_cell(run.width);
    if (run.open && counted_ && found_ + 1 < declared_) return;  // it may have lost digits
    for (std::size_t i = 0; i < run.rows; ++i) {
      const double* row = run.row(i);
      const glm::dvec3 position(row[0], row[1], row[2]);
      ++found_;
      const bool is_point = std::isfinite(position.x + position.y + position.z);
      counts_.no_return += is_point ? 0 : 1;
      const glm::dvec3 normal = n ? glm::dvec3(row[*n], row[*n + 1], row[*n + 2]) : glm::dvec3(0.0);
      if (is_point) points_.append(row, run.width, position, normal);
    }
  }

  void end_block() {
    counts_.stored += counted_ ? std::max(declared_, found_) : found_;
    if (counted_) counts_.missing += declared_ - std::min(declared_, found_);
    if (counted_ && found_ > declared_)
      listener_.note(path_, "line " + std::to_string(count_line_) + " says " + std::to_string(declared_) +
                                " points, and " + std::to_string(found_) + " follow; all were read");
    counted_ = false;
    found_ = 0;
  }

  const std::filesystem::path& path_;
  const ReadOptions& options_;
  const ReadListener& listener_;
  RowReader rows_;
  SurveyRows points_;
  ScanCounts counts_;
  bool counted_ = false;        ///< the block began with its count
  std::uint64_t declared_ = 0;  ///< that count
  std::uint64_t count_line_ = 0;
  std::uint64_t found_ = 0;  ///< lines of the block
};

}  // namespace

ScanFile read_pts(const std::filesystem::path& path, const ReadOptions& options,
                  const ReadListener& listener) {
  if (is_expe_points(path)) return read_expe_points(path, options, listener);
  const TextLayout layout = find_text_layout(path, options.scans);
  if (!layout.columns.empty() || layout.numbered) return read_xyz(path, options, listener);
  return PtsReader(path, options, listener).read();
}

}  // namespace splatray
