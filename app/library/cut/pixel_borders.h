/// Lines along the borders of pixels.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace splatray {

/// A line of borders, as long as it goes on.
struct BorderLine {
  /// The borders' middles and the line's ends, pixels from the raster's top left corner.
  std::vector<glm::dvec2> points;
  bool closed = false;
};

/// Borders between two pixels of a raster that are marked. Those marked as `weak` are part of lines, but make none.
class PixelBorders {
 public:
  enum Mark : std::uint8_t { none, weak, strong };

  PixelBorders(std::uint32_t width, std::uint32_t height);

  void mark_right(std::uint32_t x, std::uint32_t y, Mark mark) { right_[index(x, y)] = mark; }
  void mark_below(std::uint32_t x, std::uint32_t y, Mark mark) { below_[index(x, y)] = mark; }

  /// Joins the marked borders to lines. Where more than two meet, those go on into each other that are nearly straight. Branches of
  /// less than `spur` borders that end nowhere are left out, and lines of which less than a quarter is strong.
  [[nodiscard]] std::vector<BorderLine> lines(std::size_t spur) const;

 private:
  friend class BorderTracer;
  [[nodiscard]] std::size_t index(std::uint32_t x, std::uint32_t y) const {
    return std::size_t{y} * width_ + x;
  }

  std::uint32_t width_, height_;
  std::vector<std::uint8_t> right_, below_;
};

}  // namespace splatray
