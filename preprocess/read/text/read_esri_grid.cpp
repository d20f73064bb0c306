#include "preprocess/read/text/read_esri_grid.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/number_text.h"
#include "preprocess/base/lower_case.h"
#include "preprocess/read/bytes/byte_reader.h"
#include "preprocess/read/scan/missing_points.h"
#include "preprocess/read/text/row_reader.h"

namespace splatray {
namespace {

constexpr std::size_t MOST_HEAD_LINE_BYTES = 65536;
constexpr double MOST_GRID_EDGE = 16777216.0;  ///< columns or rows; products stay within 64 bits
constexpr double USUAL_NO_DATA = -9999.0;

/// The key of a line "key number", in lower case; empty where it is none.
std::string key_of(std::string_view line, double& value) {
  const std::vector<std::string> words = split_cells(line, ' ');
  if (words.size() != 2 || std::isalpha(static_cast<unsigned char>(words[0][0])) == 0) return "";
  const CellForm form{' ', true, {}, false};
  if (!parse_cell(words[1], form, value)) return "";
  return lower_case(words[0]);
}

class EsriGridReader {
 public:
  EsriGridReader(const std::filesystem::path& path, const ReadOptions& options, const ReadListener& listener)
      : path_(path), options_(options), listener_(listener) {}

  ScanFile read() {
    read_head();
    ScanFile file;
    file.counts.stored = static_cast<std::uint64_t>(columns_ * rows_);
    file.counts.missing = file.counts.stored - read_cells(file);
    listener_.note(path_, "it is a raster grid of " + number_text(columns_) + " x " + number_text(rows_) +
                              " cells, each a point in its middle");
    report_missing(path_, file.counts, options_.scans, listener_);
    return file;
  }

 private:
  void read_head() {
    ByteReader in(path_, &listener_);
    std::string_view line;
    double value = NAN;
    for (std::string key; in.line(line, MOST_HEAD_LINE_BYTES) && !(key = key_of(line, value)).empty();) {
      keys_[key] = value;
      ++data_.lines;
      data_.offset = in.offset();
    }
    const std::vector<std::string> rows = first_rows(in, {std::string(line)});
    form_ = find_cell_form(rows);
    columns_ = whole("ncols");
    rows_ = whole("nrows");
    size_ = {positive({"cellsize", "dx"}), positive({"cellsize", "dy"})};
    low_ = {required({"xllcorner", "xllcenter"}), required({"yllcorner", "yllcenter"})};
    if (keys_.count("xllcorner") > 0) low_.x += 0.5 * size_.x;
    if (keys_.count("yllcorner") > 0) low_.y += 0.5 * size_.y;
    const glm::dvec2 high = low_ + size_ * glm::dvec2(columns_, rows_);
    if (!std::isfinite(high.x + high.y))
      throw_unreadable(path_, "found a raster grid that ends beyond all numbers, expected smaller cells");
  }

  double required(std::initializer_list<const char*> names) const {
    for (const char* name : names)
      if (const auto found = keys_.find(name); found != keys_.end() && std::isfinite(found->second))
        return found->second;
    throw_unreadable(
        path_, "found a raster grid without " + std::string(*names.begin()) + ", expected it in its head");
  }

  double positive(std::initializer_list<const char*> names) const {
    const double number = required(names);
    if (!(number > 0.0))
      throw_unreadable(path_, "found a raster grid with cells of the size " + number_text(number) +
                                  ", expected a positive one");
    return number;
  }

  double whole(const char* name) const {
    const double number = required({name});
    if (!(number >= 1.0 && number <= MOST_GRID_EDGE && number == std::floor(number)))
      throw_unreadable(path_, "found " + std::string(name) + " " + number_text(number) +
                                  ", expected a whole number from 1 to 16777216");
    return number;
  }

  /// How many cells the file has.
  std::uint64_t read_cells(ScanFile& file) const {
    const auto found = keys_.find("nodata_value");
    const double no_data = found == keys_.end() ? USUAL_NO_DATA : found->second;
    const auto columns = static_cast<std::uint64_t>(columns_);
    std::uint64_t cell = 0;
    RowReader reader(path_, listener_, form_, data_);
    for (RowRun run; cell < file.counts.stored && reader.next(run);)
      for (std::size_t i = 0; i < run.width * run.rows && cell < file.counts.stored; ++i, ++cell) {
        const double height = run.values[i];
        if (!std::isfinite(height) || height == no_data) {
          ++file.counts.no_return;
          continue;
        }
        const double from_top = static_cast<double>(cell / columns);
        file.points.position.emplace_back(low_.x + static_cast<double>(cell % columns) * size_.x,
                                          low_.y + (rows_ - 1.0 - from_top) * size_.y, height);
      }
    return cell;
  }

  const std::filesystem::path& path_;
  const ReadOptions& options_;
  const ReadListener& listener_;
  std::map<std::string, double> keys_;
  TextPlace data_;
  CellForm form_;
  double columns_ = 0.0, rows_ = 0.0;
  glm::dvec2 size_{0.0};  ///< of a cell
  glm::dvec2 low_{0.0};   ///< the middle of the lowest cell
};

}  // namespace

bool is_esri_grid(const std::filesystem::path& path) {
  ByteReader in(path);
  double value = NAN;
  std::string_view line;
  const std::string key = in.line(line, MOST_HEAD_LINE_BYTES) ? key_of(line, value) : "";
  return key == "ncols" || key == "nrows";
}

ScanFile read_esri_grid(const std::filesystem::path& path, const ReadOptions& options,
                        const ReadListener& listener) {
  return EsriGridReader(path, options, listener).read();
}

}  // namespace splatray
