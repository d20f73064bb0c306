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

/// What stands below one of several views: its number, what it shows, and north where the paper has it.
[[nodiscard]] Drawing caption_block(std::size_t number, const Sheet& sheet, double width_mm);

/// What the key of a page says.
struct PageKey {
  const Sheet& sheet;  ///< whose scale and colours the page has
  bool has_north = false;
  std::vector<std::string> notes;
  ShownMeasures measures;
};

/// Bar of lengths, north, notes one below the other, the table of measures, and what the colours mean. Wider than it is given room for
/// where the table's numbers need that.
[[nodiscard]] Drawing key_block(const PageKey& key, double width_mm);

/// "1 : 50".
[[nodiscard]] std::string scale_text(const Sheet& sheet);

/// What a sheet shows, "Plan, cut at height 1.2 m".
[[nodiscard]] std::string subject_text(const Sheet& sheet);

/// What a page has: of several views contours are in captions, and levels beside the views alone.
enum class PageOf { one_sheet, views };

/// What a reader of the drawing must know beside that: size of a pixel, levels, contours, unit.
[[nodiscard]] std::vector<std::string> sheet_notes(const Sheet& sheet, PageOf page = PageOf::one_sheet);

}  // namespace splatray
