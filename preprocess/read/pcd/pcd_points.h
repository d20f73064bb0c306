/// Points of a PCD file's rows.
#pragma once
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "preprocess/points.h"
#include "preprocess/read/pcd/pcd_header.h"

namespace splatray {

/// Rows in memory, in the order that the file's kind of DATA has them.
struct PcdRows {
  const unsigned char* bytes = nullptr;  ///< ascii: float64, row_cells of them a row
  std::uint64_t count = 0;
};

/// Collects the points whose positions are finite.
class PcdPoints {
 public:
  /// Throws Error (input_unreadable) where x, y or z is missing. `attributes`: names of further fields to keep.
  PcdPoints(const PcdHeader& header, const std::filesystem::path& path,
            const std::vector<std::string>& attributes);

  /// Appends rows. Fields of compressed files stand one after the other, of header.points values each; `rows` are the
  /// first of them.
  void append(const PcdRows& rows);

  /// Of fields one after the other, how many points have all that is used of them in the first `bytes`.
  [[nodiscard]] std::uint64_t whole_points(std::uint64_t bytes) const;

  /// Fields that are not used, but for paddings ("_").
  [[nodiscard]] std::vector<std::string> unused() const;
  /// Whether positions are float32.
  [[nodiscard]] bool has_float_positions() const { return position_[0]->type == PcdType::float32; }
  /// Rows appended without a position.
  [[nodiscard]] std::uint64_t no_return() const { return no_return_; }
  /// What was appended, with grid cells by the number of the row; colours of zeros alone are none, and greys whose blue was lost are
  /// grey again. What was taken for granted about colours goes to `notes`.
  [[nodiscard]] Points take(std::vector<std::string>& notes);

 private:
  struct View;
  [[nodiscard]] bool uses(const PcdField& field) const;
  [[nodiscard]] View view(const PcdField& field, const PcdRows& rows) const;
  [[nodiscard]] glm::u16vec3 color(const View& view, std::uint64_t i) const;

  const PcdHeader& header_;
  std::vector<const PcdField*> position_;
  std::vector<const PcdField*> normal_;         ///< three or none
  const PcdField* color_ = nullptr;             ///< of all three channels
  std::vector<const PcdField*> channel_;        ///< three or none, where there is no `color_`
  std::array<std::vector<float>, 3> channels_;  ///< their values
  std::vector<std::pair<std::string, const PcdField*>> attributes_;  ///< with the names of their columns
  std::vector<std::vector<double>> values_;                          ///< of the attributes
  Points points_;
  std::uint64_t rows_ = 0;
  std::uint64_t no_return_ = 0;
};

}  // namespace splatray
