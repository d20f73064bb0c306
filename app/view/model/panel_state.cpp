#include "app/view/model/panel_state.h"

namespace splatray {

Request first_save() {
  Request save;
  save.output.path = "splatray.png";
  return save;
}

Request first_sheet() {
  Request sheet;
  sheet.output.path = "sheet.pdf";
  sheet.view.sheet.emplace();
  return sheet;
}

Request first_record() {
  constexpr std::uint32_t FRAMES = 120;
  Request record;
  record.output.path = "frame.####.png";
  record.output.turntable = FRAMES;
  return record;
}

bool dialog_is_open(const PanelState& state) {
  return state.show_open || state.show_save || state.show_sheet || state.show_record || !state.error.empty();
}

}  // namespace splatray
