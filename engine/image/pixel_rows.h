/// Filters of pictures: a piece of a row at a time, whose pixels all look at the same neighbour, so that loops are vectorised.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>

#include "engine/base/all_cores.h"
#include "shaders/display/denoise_layout.h"

namespace splatray {

/// Neighbouring pixels of a row that are filtered together: what they need stays in the cache.
constexpr std::size_t PIECE = DENOISE_PIECE;
using Piece = std::array<float, PIECE>;

/// Some pixels of a piece, beside each the neighbour that lies (dx, dy) from it.
struct Taps {
  std::size_t first, count;  ///< of the piece
  std::size_t center, tap;   ///< the first pixel, and its neighbour
  int dx, dy;                ///< pixels
};

/// A picture of pixels in rows.
class PixelRows {
 public:
  PixelRows(std::size_t width, std::size_t height)
      : width_(static_cast<int>(width)), height_(static_cast<int>(height)) {}

  /// Calls work(first pixel, count) for all pieces, on all cores; what it writes is of these pixels alone.
  template <class Work>
  void for_pieces(const Work& work) const {
    on_all_cores(static_cast<std::size_t>(height_), [&](std::size_t y) {
      for (int x = 0; x < width_; x += int{PIECE})
        work(at(x, static_cast<int>(y)), static_cast<std::size_t>(std::min(int{PIECE}, width_ - x)));
    });
  }

  /// Calls take(Taps) for each place of a square around the pixels of a piece, for those whose neighbour lies in the picture.
  template <class Take>
  void around(std::size_t first, std::size_t count, int reach, int step, const Take& take) const {
    const int y = static_cast<int>(first) / width_, x = static_cast<int>(first) % width_;
    for (int dy = -reach * step; dy <= reach * step; dy += step) {
      if (y + dy < 0 || y + dy >= height_) continue;
      for (int dx = -reach * step; dx <= reach * step; dx += step) {
        const int begin = std::max(x, -dx), end = std::min(x + static_cast<int>(count), width_ - dx);
        if (begin >= end) continue;
        take(Taps{static_cast<std::size_t>(begin - x), static_cast<std::size_t>(end - begin), at(begin, y),
                  at(begin + dx, y + dy), dx, dy});
      }
    }
  }

 private:
  [[nodiscard]] std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  int width_, height_;
};

}  // namespace splatray
