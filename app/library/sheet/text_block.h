/// Parts of a page that know how large they are, and text in them that is measured and wrapped.
#pragma once
#include <string>
#include <vector>

#include "app/library/codec/drawing.h"

namespace splatray {

/// What a text takes of its page, from corner to corner, whatever its letters are.
struct TextBox {
  glm::dvec2 low{0.0}, high{0.0};

  [[nodiscard]] bool meets(const TextBox& other) const {
    return low.x < other.high.x && other.low.x < high.x && low.y < other.high.y && other.low.y < high.y;
  }
  [[nodiscard]] bool holds(const TextBox& other) const {
    return low.x <= other.low.x && low.y <= other.low.y && other.high.x <= high.x && other.high.y <= high.y;
  }
};
[[nodiscard]] TextBox text_box(const DrawnText& text);

/// Adds a part to a page, its top left corner there.
void add_block(const Drawing& block, const glm::dvec2& corner, Drawing& page);

/// Height of a line of letters of this size, with room below what hangs deepest, millimetres.
[[nodiscard]] double line_height(double size_mm);

/// Width of a text, millimetres.
[[nodiscard]] double text_width(const std::string& text, double size_mm);

/// Lines of at most this width: broken between words, and within a word that is wider alone. Control characters become blanks.
/// At least one line; at least one letter in each.
[[nodiscard]] std::vector<std::string> wrapped(const std::string& text, double size_mm, double width_mm);

/// Adds the wrapped text with its top left corner there, and returns its height, millimetres.
double add_text(const std::string& text, double size_mm, double width_mm, const glm::dvec2& corner,
                Drawing& block);

}  // namespace splatray
