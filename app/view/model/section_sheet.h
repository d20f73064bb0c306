/// The sheet, a drawing to scale, of the section that the window shows.
#pragma once
#include <string>

#include "app/library/request/sheet_request.h"
#include "app/view/model/document.h"

namespace splatray {

/// The sheet that is nearest to what the camera sees: from above a plan, at the height of the lowest level face of the region that cuts
/// the scene; from below an ortho; else a section along the upright face of the region that the camera looks at, or without one the
/// elevation from the nearest of the four sides. Nearest: within 45 degrees. All but the kind, the place and the height are
/// those of `like`.
[[nodiscard]] SheetRequest section_sheet(const Document& document, const SheetRequest& like);

/// What a sheet shows, a sentence: "A plan, cut at the height 1.2.".
[[nodiscard]] std::string sheet_sentence(const SheetRequest& sheet);

}  // namespace splatray
