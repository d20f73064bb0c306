/// A page of lines, letters and rasters, or a part of one, in millimetres from its top left corner, x to the right, y down. It is
/// drawn in the order of its members.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "shaders/layout.h"

namespace splatray {

struct DrawnLine {
  glm::dvec2 from, to;
  double width_mm = 0.18;
};

struct DrawnBox {
  glm::dvec2 corner, size;
  glm::vec3 fill{0.0F};  ///< sRGB, 0 to 1
};

/// Lines from point to point.
struct DrawnPath {
  std::vector<glm::dvec2> points;
  bool closed = false;
  double width_mm = 0.35;
};

enum class TextAnchor { begin, middle, end };

struct DrawnText {
  glm::dvec2 at;         ///< on the base line
  double size_mm = 3.0;  ///< height of the letters' body
  TextAnchor anchor = TextAnchor::begin;
  std::string text;      ///< UTF-8
  bool upwards = false;  ///< turned by a quarter, to be read from the right
};

/// What a text takes of its line, mm, whatever its letters are.
struct TextExtents {
  double width = 0.0;
  double ascent = 0.0, descent = 0.0;  ///< of the font, above and below the base line
};

/// Pixels, top row first, four bytes each: sRGB that alpha is not multiplied into, and alpha; and lines on them.
struct DrawnRaster {
  glm::dvec2 corner{0.0}, size{0.0};
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
  std::vector<DrawnPath> paths;  ///< places of the page, cut off at the raster's border
};

struct Drawing {
  glm::dvec2 size{0.0};
  std::string title;  ///< of the document
  std::vector<DrawnRaster> rasters;
  std::vector<DrawnLine> lines;
  std::vector<DrawnBox> boxes;
  std::vector<DrawnText> texts;
};

}  // namespace splatray
