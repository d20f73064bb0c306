/// Rows of the surveyors' text formats PTX and PTS.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "preprocess/points.h"
#include "preprocess/read/text/row_reader.h"

namespace splatray {

/// Collects points of rows x y z [intensity] [r g b [nx ny nz]], where the first three numbers beside the intensity are normals if
/// they have the length 1. Blocks of a file may differ in what they have.
class SurveyRows {
 public:
  static constexpr std::string_view EXPECTED =
      "x y z, or with intensity, with r g b, and with nx ny nz behind them; other columns are named by "
      "--columns";

  /// Whether rows of `width` cells are such.
  [[nodiscard]] static bool is_width(std::size_t width) {
    return width == 3 || width == 4 || width == 6 || width == 7 || width == 9 || width == 10;
  }

  /// Looks at the first rows of a run, before they are appended, for what their columns are. Unless `intensity_first`, it stands where
  /// find_intensity() finds it.
  void judge(const RowRun& run, bool intensity_first);
  /// Whether rows of that width have a normal, and where.
  [[nodiscard]] std::optional<std::size_t> normal_cell(std::size_t width) const;

  /// Appends a point. `normal_world` is used where the row has one.
  void append(const double* row, std::size_t width, const glm::dvec3& position_world,
              const glm::dvec3& normal_world);

  [[nodiscard]] const std::vector<glm::dvec3>& position() const { return points_.position; }

  /// All points; attributes that some rows lack are 0 there, colours white. What was taken for granted goes to `notes`.
  [[nodiscard]] Points take(std::vector<std::string>& notes);

 private:
  void store_all_colors(std::vector<std::string>& notes);
  /// The first cell of a row's first or second triple.
  [[nodiscard]] std::size_t triple_cell(std::size_t width, std::size_t triple) const;

  Points points_;
  std::vector<float> intensity_;
  std::array<std::vector<float>, 3> channel_;  ///< NaN: the row has none
  std::size_t intensity_cell_ = 3;             ///< of rows that have one
  bool normals_first_ = false;                 ///< the first triple is normals
  bool is_judged_ = false;
};

}  // namespace splatray
