/// What stands beside a drawing on its page: title block, notes, bar, north, legend. Each is a part with its size, as wide as it is
/// given room for at most; texts are wrapped.
#pragma once
#include <string>
#include <vector>

#include "app/library/codec/drawing.h"
#include "app/library/request/title_block.h"
#include "app/library/sheet/measure_marks.h"
#include "app/library/shot/sheet.h"

namespace splatray {

/// The words of a page that are not its drawing's.
struct PageWords {
  std::string title;
  TitleBlock block;
};

/// The table of a page's fields: project, title, number and so on, empty ones too, with the scale, the paper's name and the coordinate
/// system.
[[nodiscard]] Drawing title_block(const PageWords& words, const Sheet& sheet, const std::string& paper,
                                  double width_mm);

/// Bar of lengths, north where the paper has it, notes one below the other, the table of measures, and what the colours mean. Wider than
/// it is given room for where the table's numbers need that.
[[nodiscard]] Drawing key_block(const Sheet& sheet, const ShownMeasures& measures,
                                const std::vector<std::string>& notes, double width_mm);

/// "1 : 50".
[[nodiscard]] std::string scale_text(const Sheet& sheet);

/// What a reader of the drawing must know: cut, depth, what the coordinates are, size of a pixel.
[[nodiscard]] std::vector<std::string> sheet_notes(const Sheet& sheet);

}  // namespace splatray
