/// Which points of the input a scene leaves out.
#pragma once
#include <vector>

#include "preprocess/points.h"
#include "preprocess/write/point_table.h"

namespace splatray {

/// Numbers the points of an input before a scene is built of it, to know afterwards which are in no splat: those far from all
/// others, strays, what noise hides, copies of one splat. What readers leave out has no number.
class LeftOutPoints {
 public:
  /// Gives all points a column of their number.
  explicit LeftOutPoints(Input& input);
  /// The points that are in no splat of the scene, which loses that column.
  [[nodiscard]] LeftOut take(Scene& scene) &&;

 private:
  LeftOut all_;
};

}  // namespace splatray
