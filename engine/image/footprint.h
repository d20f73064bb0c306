/// Where in a picture a scene's splats can be seen at all: what is not there need not be traced.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/image/view.h"
#include "engine/scene/scene.h"
#include "engine/scene/tree.h"

namespace splatray {

/// Cells that hold all filled leaves, none smaller than 2^-FOOTPRINT_LEVELS of the root.
[[nodiscard]] std::vector<OctreeCell> filled_cells(const Scene& scene);
inline constexpr std::uint32_t FOOTPRINT_LEVELS = 5;

/// The blocks of 8 x 8 pixels of a picture that primary rays may hit something in.
class Footprint {
 public:
  static constexpr std::uint32_t BLOCK = 8;  ///< pixels

  /// Covers no pixels.
  Footprint() = default;
  /// Covers a whole picture.
  Footprint(std::uint32_t width, std::uint32_t height);
  /// Covers these cells. Blocks that a cell's bounding rectangle comes near are in it, all of them where a cell reaches behind
  /// the eye's plane. The view must be one that make_frame_params accepts.
  Footprint(const std::vector<OctreeCell>& cells, const RootTransform& root, const View& view);

  /// Whether some pixel of the rectangle [x, x + width) x [y, y + height) is in a block of the footprint.
  [[nodiscard]] bool meets(std::uint32_t x, std::uint32_t y, std::uint32_t width, std::uint32_t height) const;

 private:
  std::uint32_t columns_ = 0;
  std::uint32_t rows_ = 0;
  std::vector<std::uint8_t> blocks_;  ///< row by row; 0: not in it
};

}  // namespace splatray
