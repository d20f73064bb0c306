/// Rows of the surveyors' text formats PTX and PTS.
#pragma once
#include <string_view>
#include <vector>

#include "preprocess/points.h"
#include "preprocess/read/text/row_reader.h"

namespace splatray {

/// Collects points of rows x y z [intensity [r g b [nx ny nz]]]. Blocks of a file may differ in what they have.
class SurveyRows {
 public:
  static constexpr std::string_view EXPECTED =
      "x y z, or with intensity, with r g b, and with nx ny nz behind them";

  /// Whether rows of `width` cells are such.
  [[nodiscard]] static bool is_width(std::size_t width) {
    return width == 3 || width == 4 || width == 7 || width == 10;
  }

  /// Appends a point. `normal_world` is used where the row has one.
  void append(const double* row, std::size_t width, const glm::dvec3& position_world,
              const glm::dvec3& normal_world);

  [[nodiscard]] const std::vector<glm::dvec3>& position() const { return points_.position; }

  /// All points; attributes that some rows lack are 0 there, colours white. Colours are of 8 bits unless one exceeds them.
  [[nodiscard]] Points take();

 private:
  Points points_;
  std::vector<float> intensity_;
};

}  // namespace splatray
