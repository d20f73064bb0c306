#include "preprocess/read/text/read_ptx.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "preprocess/read/scan/missing_points.h"
#include "preprocess/read/scan/sensor_place.h"
#include "preprocess/read/text/row_reader.h"
#include "preprocess/read/text/survey_rows.h"

namespace splatray {
namespace {

constexpr std::size_t HEADER_LINES = 10;
constexpr std::size_t HEADER_WIDTHS[HEADER_LINES] = {1, 1, 3, 3, 3, 3, 4, 4, 4, 4};
constexpr const char* HEADER_NAMES[HEADER_LINES] = {
    "the number of columns",   "the number of rows",     "the scanner's position",  "the scanner's x axis",
    "the scanner's y axis",    "the scanner's z axis",   "the transform's 1st row", "the transform's 2nd row",
    "the transform's 3rd row", "the transform's 4th row"};
constexpr double MOST_EDGE = 16777216.0;  ///< columns or rows; products and their sums stay within 64 bits
constexpr std::size_t MOST_SCANS = 65535;

/// One scan's header and how far its cells are read.
struct PtxScan {
  double header[HEADER_LINES][4] = {};
  std::uint64_t first_line = 0;
  std::uint64_t cells = 0;      ///< read so far
  std::size_t first_point = 0;  ///< in the file's points

  [[nodiscard]] std::uint64_t columns() const { return static_cast<std::uint64_t>(header[0][0]); }
  [[nodiscard]] std::uint64_t rows() const { return static_cast<std::uint64_t>(header[1][0]); }
  [[nodiscard]] glm::dvec3 triple(std::size_t line) const {
    return {header[line][0], header[line][1], header[line][2]};
  }
};

class PtxReader {
 public:
  PtxReader(const std::filesystem::path& path, const ReadOptions& options, const ReadListener& listener)
      : path_(path), options_(options), listener_(listener), rows_(path, listener, form_of_rows(path)) {}

  ScanFile read() {
    RowRun run;
    while (rows_.next(run)) {
      for (std::size_t i = 0; i < run.rows;) {
        if (in_cells() && run.width != 1) {
          read_cells(run, i);
          break;
        }
        read_header_line(run, i++);
      }
    }
    if (header_lines_ == 0) throw_unreadable(path_, "found no numbers, expected the header of a PTX file");
    if (!in_cells())
      rows_.fail(last_line_, std::string("the file ends here, expected ") + HEADER_NAMES[header_lines_]);
    end_scan();
    return finished();
  }

 private:
  [[nodiscard]] bool in_cells() const { return header_lines_ == HEADER_LINES; }

  void read_header_line(const RowRun& run, std::size_t i) {
    if (in_cells()) {
      end_scan();
      header_lines_ = 0;
    }
    if (header_lines_ == 0) {
      scan_ = {};
      scan_.first_line = run.first_line + i;
      scan_.first_point = points_.position().size();
    }
    last_line_ = run.first_line + i;
    const std::size_t width = HEADER_WIDTHS[header_lines_];
    if (run.width != width)
      fail_header("found " + std::to_string(run.width) + " numbers, expected " + std::to_string(width));
    std::copy_n(run.row(i), width, scan_.header[header_lines_]);
    if (!std::all_of(run.row(i), run.row(i) + width, [](double v) { return std::isfinite(v); }))
      fail_header("found a number that is not finite, expected one that is");
    const double first = run.row(i)[0];
    if (width == 1 && !(first >= 0.0 && first <= MOST_EDGE && first == std::floor(first)))
      fail_header("found " + std::to_string(first) + ", expected a whole number up to 16777216");
    ++header_lines_;
    if (in_cells()) end_header();
  }

  [[noreturn]] void fail_header(const std::string& what) const {
    rows_.fail(last_line_, what + " for " + HEADER_NAMES[header_lines_]);
  }

  void end_header() {
    const auto& m = scan_.header;
    linear_ = glm::dmat3(scan_.triple(6), scan_.triple(7), scan_.triple(8));
    origin_ = scan_.triple(9);
    const bool by_columns = m[9][0] == 0.0 && m[9][1] == 0.0 && m[9][2] == 0.0 &&
                            (m[6][3] != 0.0 || m[7][3] != 0.0 || m[8][3] != 0.0);
    if (by_columns) {
      linear_ = glm::transpose(linear_);
      origin_ = {m[6][3], m[7][3], m[8][3]};
      note("its transform has the position in its last column and is taken as transposed");
    }
    if (linear_ == glm::dmat3(0.0)) {
      linear_ = glm::dmat3(1.0);
      note("its transform is all zero and was left out");
    }
    const double volume = glm::determinant(linear_);
    normals_ = volume != 0.0 ? glm::transpose(glm::inverse(linear_)) : glm::dmat3(0.0);
  }

  /// The cells from row `first` of a run on.
  void read_cells(const RowRun& run, std::size_t first) {
    if (!SurveyRows::is_width(run.width))
      rows_.fail(run.first_line + first, "found " + std::to_string(run.width) + " numbers, expected " +
                                             std::string(SurveyRows::EXPECTED));
    points_.judge(run, true);
    const std::optional<std::size_t> n = points_.normal_cell(run.width);
    if (run.open && scan_.cells + 1 < scan_.columns() * scan_.rows()) return;  // it may have lost digits
    for (std::size_t i = first; i < run.rows; ++i, ++scan_.cells) {
      const double* row = run.row(i);
      const glm::dvec3 local(row[0], row[1], row[2]);
      const glm::dvec3 world = linear_ * local + origin_;
      if (local == glm::dvec3(0.0) || !std::isfinite(world.x + world.y + world.z)) {
        ++no_return_;
        continue;
      }
      const glm::dvec3 normal =
          n ? normals_ * glm::dvec3(row[*n], row[*n + 1], row[*n + 2]) : glm::dvec3(0.0);
      points_.append(row, run.width, world, normal);
      cells_.push_back(scan_.cells);
    }
  }

  void end_scan() {
    const std::uint64_t declared = scan_.columns() * scan_.rows();
    counts_.stored += std::max(declared, scan_.cells);
    counts_.missing += declared - std::min(declared, scan_.cells);
    if (stations_.size() == MOST_SCANS) throw_unreadable(path_, "found more than 65535 scans");
    Station station;
    const bool gridded = declared == scan_.cells && declared < NO_CELL;
    if (gridded) {
      station.rows = static_cast<std::uint32_t>(scan_.rows());
      station.columns = static_cast<std::uint32_t>(scan_.columns());
    } else {
      note("its header says " + std::to_string(scan_.columns()) + " columns of " +
           std::to_string(scan_.rows()) + ", and " + std::to_string(scan_.cells) +
           " lines follow; its points are read without a grid");
    }
    for (std::size_t i = scan_.first_point; i < cells_.size(); ++i) {
      const std::uint64_t cell = cells_[i];
      grid_cell_.push_back(
          gridded ? static_cast<std::uint32_t>(cell % station.rows * station.columns + cell / station.rows)
                  : NO_CELL);
      station_.push_back(static_cast<std::uint16_t>(stations_.size()));
    }
    const bool stated = scan_.triple(3) != glm::dvec3(0.0) || scan_.triple(4) != glm::dvec3(0.0) ||
                        scan_.triple(5) != glm::dvec3(0.0);
    const glm::dvec3 place = origin_ == glm::dvec3(0.0) ? scan_.triple(2) : origin_;
    if (stated) station.sensor_world = credible_sensor(place, points_.position(), scan_.first_point);
    stations_.push_back(station);
  }

  ScanFile finished() {
    ScanFile file;
    std::vector<std::string> said;
    file.points = points_.take(said);
    for (const std::string& sentence : said) listener_.note(path_, sentence);
    file.counts = counts_;
    file.counts.no_return = no_return_;
    if (std::any_of(grid_cell_.begin(), grid_cell_.end(), [](std::uint32_t cell) { return cell != NO_CELL; }))
      file.points.grid_cell = std::move(grid_cell_);
    if (stations_.size() > 1) file.points.station = std::move(station_);
    file.points.stations = std::move(stations_);
    report_missing(path_, file.counts, options_.scans, listener_);
    return file;
  }

  void note(const std::string& what) const {
    listener_.note(path_, "the scan at line " + std::to_string(scan_.first_line) + ": " + what);
  }

  const std::filesystem::path& path_;
  const ReadOptions& options_;
  const ReadListener& listener_;
  RowReader rows_;
  PtxScan scan_;
  std::size_t header_lines_ = 0;  ///< read of the scan's header
  std::uint64_t last_line_ = 0;
  glm::dmat3 linear_{1.0};  ///< of the transform: world = linear * local + origin
  glm::dvec3 origin_{0.0};
  glm::dmat3 normals_{1.0};
  SurveyRows points_;
  std::vector<std::uint64_t> cells_;  ///< number of each point's line in its scan
  std::vector<std::uint32_t> grid_cell_;
  std::vector<std::uint16_t> station_;
  std::vector<Station> stations_;
  ScanCounts counts_;
  std::uint64_t no_return_ = 0;
};

}  // namespace

ScanFile read_ptx(const std::filesystem::path& path, const ReadOptions& options,
                  const ReadListener& listener) {
  return PtxReader(path, options, listener).read();
}

}  // namespace splatray
