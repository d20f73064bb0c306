#include "preprocess/read/text/read_xyz.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "preprocess/base/quoted_list.h"
#include "preprocess/read/scan/column_names.h"
#include "preprocess/read/scan/missing_points.h"
#include "preprocess/read/scan/narrow_column.h"
#include "preprocess/read/scan/scan_stations.h"
#include "preprocess/read/scan/stored_colors.h"
#include "preprocess/read/text/read_esri_grid.h"
#include "preprocess/read/text/text_layout.h"
#include "preprocess/read/text/unnamed_columns.h"

namespace splatray {
namespace {

/// A column that is read beside the positions.
struct Extra {
  std::size_t cell = 0;
  std::string name;           ///< "" until it is guessed
  std::vector<float> values;  ///< of colours, normals, intensity and those without a name
  std::vector<double> exact;  ///< of all others
};

bool is_one_of(const std::string& name, const std::string_view (&names)[3]) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

bool is_float(const std::string& name) {
  return name.empty() || name == COLUMN_INTENSITY || name == COLUMN_RADIUS ||
         is_one_of(name, COLUMN_NORMALS) || is_one_of(name, COLUMN_COLORS);
}

class XyzReader {
 public:
  XyzReader(const std::filesystem::path& path, const ReadOptions& options, const ReadListener& listener)
      : path_(path),
        options_(options),
        listener_(listener),
        layout_(find_text_layout(path, options.scans)),
        rows_(path, listener, layout_.form, layout_.data) {}

  /// Takes the first column for a coordinate, whatever it is.
  void keep_first_column() { layout_.numbered = false; }

  /// Nothing where the first column, which should count the rows, does not.
  std::optional<ScanFile> read() {
    RowRun run;
    while (rows_.next(run)) {
      if (width_ == 0) choose_cells(run);
      check_width(run);
      check_numbers(run);
      if (numbers_break_) break;
      if (run.open && layout_.count && found_ + 1 < *layout_.count) break;  // it may have lost digits
      append(run);
    }
    if (numbers_break_) return {};
    if (layout_.degrees) file_.in_degrees = true;
    count();
    if (layout_.columns.empty()) name_extras();
    take_attributes();
    report();
    return std::move(file_);
  }

 private:
  /// Where the first row says how many columns there are.
  void choose_cells(const RowRun& run) {
    const std::vector<std::string>& columns = layout_.columns;
    const std::size_t first = layout_.numbered ? 1 : 0;
    if (columns.empty()) axes_ = {first, first + 1, first + 2};
    for (std::size_t cell = first; cell < (columns.empty() ? run.width : columns.size()); ++cell) {
      const std::string name = columns.empty() ? "" : columns[cell];
      const auto* const axis = std::find(std::begin(COLUMN_AXES), std::end(COLUMN_AXES), name);
      if (axis != std::end(COLUMN_AXES)) {
        axes_[static_cast<std::size_t>(axis - std::begin(COLUMN_AXES))] = cell;
      } else if (columns.empty() ? cell >= first + 3 : !name.empty()) {
        extras_.push_back({cell, name, {}, {}});
      }
    }
    width_ = columns.empty() ? run.width : last_used_cell() + 1;
    if (width_ < 3)
      rows_.fail(run.first_line, "found " + std::to_string(width_) + " numbers, expected at least x y z");
  }

  [[nodiscard]] std::size_t last_used_cell() const {
    std::size_t last = *std::max_element(axes_.begin(), axes_.end());
    for (const Extra& extra : extras_) last = std::max(last, extra.cell);
    return last;
  }

  /// Rows without names may end in empty cells; others may have more cells than are used.
  void check_width(const RowRun& run) const {
    if (run.width == width_ || (run.width > width_ && !layout_.columns.empty())) return;
    for (std::size_t i = 0; i < run.rows; ++i) {
      bool empty = run.width > width_ && layout_.form.separator != ' ';
      for (std::size_t cell = width_; cell < run.width && empty; ++cell) empty = std::isnan(run.row(i)[cell]);
      if (!empty)
        rows_.fail(run.first_line + i,
                   "found " + std::to_string(run.width) + " columns, expected " + std::to_string(width_) +
                       (layout_.columns.empty() ? "; --columns names those to read" : ""));
    }
  }

  /// Numbers of rows ascend: those of rows that were deleted are missing.
  void check_numbers(const RowRun& run) {
    for (std::size_t i = 0; i < run.rows && layout_.numbered; ++i) {
      const double number = run.row(i)[0];
      numbers_break_ = numbers_break_ || !(number > last_number_ && number == std::floor(number));
      last_number_ = number;
    }
  }

  void append(const RowRun& run) {
    std::vector<glm::dvec3>& position = file_.points.position;
    const std::size_t before = position.size();
    resize(before + run.rows);
    std::size_t at = before;
    for (std::size_t i = 0; i < run.rows; ++i) {
      const double* row = run.row(i);
      const glm::dvec3 place(row[axes_[0]], row[axes_[1]], row[axes_[2]]);
      if (!std::isfinite(place.x + place.y + place.z)) continue;
      position[at] = place;
      for (Extra& extra : extras_) {
        if (extra.exact.empty()) {
          extra.values[at] = static_cast<float>(row[extra.cell]);
        } else {
          extra.exact[at] = row[extra.cell];
        }
      }
      ++at;
    }
    resize(at);
    found_ += run.rows;
    file_.counts.no_return += run.rows - (at - before);
  }

  void resize(std::size_t size) {
    file_.points.position.resize(size);
    for (Extra& extra : extras_) {
      if (is_float(extra.name)) {
        extra.values.resize(size);
      } else {
        extra.exact.resize(size);
      }
    }
  }

  void count() {
    ScanCounts& counts = file_.counts;
    counts.stored = std::max(found_, layout_.count.value_or(0));
    counts.missing = counts.stored - found_;
    if (layout_.count && found_ > *layout_.count)
      listener_.note(path_, "its first number says " + std::to_string(*layout_.count) + " points, and " +
                                std::to_string(found_) + " follow; all were read");
  }

  /// Names are guessed once all values are known. Empty columns at the end are those of a separator behind the last cell.
  void name_extras() {
    const auto is_empty = [](const Extra& extra) {
      return std::all_of(extra.values.begin(), extra.values.end(), [](float v) { return std::isnan(v); });
    };
    while (!extras_.empty() && is_empty(extras_.back())) extras_.pop_back();
    std::vector<const std::vector<float>*> lists;
    for (const Extra& extra : extras_) lists.push_back(&extra.values);
    std::vector<std::string> notes;
    const std::vector<std::string> meanings = guess_columns(lists, notes);
    for (std::size_t i = 0; i < extras_.size(); ++i) extras_[i].name = meanings[i];
    for (const std::string& note : notes) listener_.note(path_, note);
  }

  /// The three columns of these names, or empty lists.
  std::array<std::vector<float>, 3> take_triple(const std::string_view (&names)[3]) {
    std::array<Extra*, 3> found{};
    for (Extra& extra : extras_)
      for (std::size_t i = 0; i < 3; ++i)
        if (extra.name == names[i]) found[i] = &extra;
    std::array<std::vector<float>, 3> triple;
    if (std::find(found.begin(), found.end(), nullptr) != found.end()) return triple;
    for (std::size_t i = 0; i < 3; ++i) triple[i] = std::move(found[i]->values);
    return triple;
  }

  void take_attributes() {
    Points& points = file_.points;
    const std::array<std::vector<float>, 3> normals = take_triple(COLUMN_NORMALS);
    points.normal.resize(normals[0].size());
    for (std::size_t i = 0; i < points.normal.size(); ++i) {
      const glm::vec3 normal(normals[0][i], normals[1][i], normals[2][i]);
      points.normal[i] = std::isfinite(glm::dot(normal, normal)) ? normal : glm::vec3(0.0F);
    }
    if (std::array<std::vector<float>, 3> colors = take_triple(COLUMN_COLORS); !colors[0].empty())
      if (const std::string said = store_colors(std::move(colors), points); !said.empty())
        listener_.note(path_, said);
    for (Extra& extra : extras_) {
      if (extra.name.empty() || is_one_of(extra.name, COLUMN_NORMALS) || is_one_of(extra.name, COLUMN_COLORS))
        continue;
      if (extra.name == COLUMN_RADIUS) {
        take_radii(std::move(extra.values));
        continue;
      }
      if (!extra.values.empty()) extra.exact.assign(extra.values.begin(), extra.values.end());
      if (extra.name == COLUMN_SCAN) {
        if (!make_stations(extra.exact, points))
          listener_.note(path_, "its numbers of scans are not whole or more than 65535, and were left out");
      } else {
        points.columns.push_back(narrow_column(extra.name, std::move(extra.exact)));
      }
    }
  }

  /// What is no radius is one to be found.
  void take_radii(std::vector<float>&& values) {
    for (float& value : values)
      if (!(value > 0.0F && std::isfinite(value))) value = 0.0F;
    if (std::any_of(values.begin(), values.end(), [](float value) { return value > 0.0F; }))
      file_.points.radius = std::move(values);
  }

  void report() const {
    report_missing(path_, file_.counts, options_.scans, listener_);
    if (!layout_.unused.empty()) listener_.note(path_, "skipped columns " + quoted_list(layout_.unused));
    if (layout_.has_more) listener_.note(path_, "cells behind the last named column were left out");
    if (layout_.numbered) listener_.note(path_, "its first column counts the rows and was left out");
    if (layout_.form.decimal_comma && layout_.form.separator == ' ')
      listener_.note(path_, "commas are taken as decimal ones");
    if (layout_.degrees)
      listener_.note(
          path_,
          "x and y are degrees of longitude and latitude by their names, which are no lengths; project "
          "them to metres first");
  }

  const std::filesystem::path& path_;
  const ReadOptions& options_;
  const ReadListener& listener_;
  TextLayout layout_;
  RowReader rows_;
  std::size_t width_ = 0;
  std::array<std::size_t, 3> axes_{0, 1, 2};
  std::vector<Extra> extras_;
  ScanFile file_;
  std::uint64_t found_ = 0;
  double last_number_ = -1.0;   ///< of the rows so far, where they are numbered
  bool numbers_break_ = false;  ///< they do not ascend
};

}  // namespace

ScanFile read_xyz(const std::filesystem::path& path, const ReadOptions& options,
                  const ReadListener& listener) {
  if (is_esri_grid(path)) return read_esri_grid(path, options, listener);
  XyzReader reader(path, options, listener);
  if (std::optional<ScanFile> file = reader.read()) return *std::move(file);
  XyzReader again(path, options, listener);
  again.keep_first_column();
  return again.read().value();
}

}  // namespace splatray
