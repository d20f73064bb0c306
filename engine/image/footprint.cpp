#include "engine/image/footprint.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/scene/tree.h"

namespace splatray {
namespace {

/// Hits lie within LIST_INFLATION of their leaf's cell; the rest is for primary rays' origins in float32.
constexpr double CELL_MARGIN = 16.0;
/// What float32 adds to a primary ray's pixel, in units of the lengths that it is computed from.
constexpr double RAY_ERROR = 1e-6;
constexpr double PIXEL_MARGIN = 0.01;
constexpr double INFINITE = std::numeric_limits<double>::infinity();

/// Pixel positions, in float64.
struct PixelRectangle {
  double left = INFINITE, top = INFINITE;
  double right = -INFINITE, bottom = -INFINITE;
};

/// How root space is seen in a picture.
class Projection {
 public:
  Projection(const RootTransform& root, const View& view) : ortho_(view.camera.ortho_height > 0.0) {
    const ImagePlane plane = image_plane(root, view);
    const double pixel = std::min(glm::length(plane.dx), glm::length(plane.dy));
    to_picture_ = glm::transpose(glm::dmat3(plane.dx / glm::dot(plane.dx, plane.dx),
                                            plane.dy / glm::dot(plane.dy, plane.dy), plane.forward));
    eye_ = plane.eye;
    corner_ = to_picture_ * plane.corner;
    const double reach = ortho_ ? glm::length(plane.eye) + 2.0 * (1U << LATTICE_BITS) : 1.0;
    margin_ = PIXEL_MARGIN + RAY_ERROR * (reach + glm::length(plane.corner)) / pixel;
  }

  /// What a cell covers: nothing behind the eye's plane, everything where it reaches behind it.
  [[nodiscard]] PixelRectangle rectangle(const OctreeCell& cell) const {
    const glm::dvec3 first = to_picture_ * (glm::dvec3(cell.low) - CELL_MARGIN - eye_);
    const glm::dmat3 edges = (cell.size + 2.0 * CELL_MARGIN) * to_picture_;
    PixelRectangle bounds;
    double nearest = INFINITE, farthest = -INFINITE;
    for (unsigned i = 0; i < 8; ++i) {
      const glm::dvec3 point =
          first + double(i & 1U) * edges[0] + double(i >> 1 & 1U) * edges[1] + double(i >> 2) * edges[2];
      const double scale = ortho_ ? 1.0 : 1.0 / point.z;
      const double x = point.x * scale - corner_.x, y = point.y * scale - corner_.y;
      bounds = {std::min(bounds.left, x), std::min(bounds.top, y), std::max(bounds.right, x),
                std::max(bounds.bottom, y)};
      nearest = std::min(nearest, point.z);
      farthest = std::max(farthest, point.z);
    }
    if (farthest < 0.0) return {};
    if (nearest < 1.0 && !ortho_) return {-INFINITE, -INFINITE, INFINITE, INFINITE};
    return {bounds.left - margin_, bounds.top - margin_, bounds.right + margin_, bounds.bottom + margin_};
  }

 private:
  bool ortho_;
  /// Pixels right and down, on the plane at distance 1 where there is perspective, and depth.
  glm::dmat3 to_picture_{};
  glm::dvec3 eye_{}, corner_{};
  double margin_ = 0.0;
};

/// The block that holds a pixel position, in [0, count].
std::uint32_t block_of(double pixel, std::uint32_t count) {
  return static_cast<std::uint32_t>(std::clamp(std::floor(pixel / Footprint::BLOCK), 0.0, double(count)));
}

}  // namespace

std::vector<OctreeCell> filled_cells(const Scene& scene) {
  std::vector<OctreeCell> cells;
  visit_cells(scene, [&cells](std::uint32_t word, const OctreeCell& cell) {
    const std::uint32_t tag = word >> NODE_TAG_SHIFT;
    if (tag == NODE_INNER && cell.size > 1U << (LATTICE_BITS - FOOTPRINT_LEVELS)) return true;
    if (tag != NODE_EMPTY) cells.push_back(cell);
    return false;
  });
  return cells;
}

Footprint::Footprint(std::uint32_t width, std::uint32_t height)
    : columns_((width + BLOCK - 1) / BLOCK),
      rows_((height + BLOCK - 1) / BLOCK),
      blocks_(std::size_t{columns_} * rows_, 1) {}

Footprint::Footprint(const std::vector<OctreeCell>& cells, const RootTransform& root, const View& view)
    : Footprint(view.width, view.height) {
  const Projection projection(root, view);
  const std::size_t stride = columns_ + 1;
  // How many cells begin less end at a block; summed over the blocks before it, how many cover it.
  std::vector<std::int32_t> change(stride * (rows_ + 1), 0);
  for (const OctreeCell& cell : cells) {
    const PixelRectangle bounds = projection.rectangle(cell);
    if (!(bounds.left <= bounds.right)) continue;
    const std::uint32_t left = block_of(bounds.left, columns_),
                        right = block_of(bounds.right + BLOCK, columns_);
    const std::uint32_t top = block_of(bounds.top, rows_), bottom = block_of(bounds.bottom + BLOCK, rows_);
    ++change[top * stride + left];
    --change[top * stride + right];
    --change[bottom * stride + left];
    ++change[bottom * stride + right];
  }
  for (std::size_t row = 0; row < rows_; ++row) {
    std::int32_t sum = 0;
    for (std::size_t column = 0; column < columns_; ++column) {
      sum += change[row * stride + column];
      const std::int32_t above = row > 0 ? change[(row - 1) * stride + column] : 0;
      change[row * stride + column] = sum + above;
      blocks_[row * columns_ + column] = sum + above != 0 ? 1 : 0;
    }
  }
}

bool Footprint::meets(std::uint32_t x, std::uint32_t y, std::uint32_t width, std::uint32_t height) const {
  const std::uint32_t right = std::min((x + width - 1) / BLOCK + 1, columns_);
  const std::uint32_t bottom = std::min((y + height - 1) / BLOCK + 1, rows_);
  for (std::uint32_t row = y / BLOCK; row < bottom; ++row)
    for (std::uint32_t column = x / BLOCK; column < right; ++column)
      if (blocks_[std::size_t{row} * columns_ + column] != 0) return true;
  return false;
}

}  // namespace splatray
