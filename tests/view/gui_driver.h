/// Dear ImGui without a window: frames of the panels, and a mouse that clicks where asked.
#pragma once
#include <imgui.h>
#include <imgui_internal.h>

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "app/view/ui/panels.h"

namespace splatray {

/// A place among the controls: names and numbers as ImGui::PushID takes them, the control's own last.
using ControlPath = std::vector<std::variant<std::string, int>>;

/// One context, document and set of panels.
class GuiDriver {
 public:
  GuiDriver(float width_px, float height_px, double ui_scale = 1.0);
  ~GuiDriver() { ImGui::DestroyContext(context_); }
  GuiDriver(const GuiDriver&) = delete;
  GuiDriver& operator=(const GuiDriver&) = delete;

  /// Draws one frame.
  Requests frame();
  /// Moves the mouse over a control of the window whose name holds `window`, clicks, and draws until that has had its
  /// effect; what was asked for meanwhile. Fails the test when there is no such control to be seen.
  Requests click(const std::string& window, const ControlPath& path);
  /// Opens a section of the column without the mouse, wherever it has been scrolled to.
  void open_section(const char* title);
  /// Whether such a control can be clicked.
  [[nodiscard]] bool can_click(const std::string& window, const ControlPath& path);
  /// Whether the mouse, led once down the window, was over such a control; `paths` each.
  [[nodiscard]] std::vector<bool> are_there(const std::string& window, const std::vector<ControlPath>& paths);
  /// Width of a control that the mouse can be over, pixels; fails the test where there is none.
  [[nodiscard]] float width(const std::string& window, const ControlPath& path);
  /// Rectangle of the window whose name holds `window`, pixels; empty when it was not drawn.
  [[nodiscard]] ImRect rectangle(const std::string& window) const;

  Document document;
  PanelState state;
  PanelView view;

 private:
  [[nodiscard]] ImGuiWindow* find(const std::string& window) const;
  [[nodiscard]] bool point_at(const std::string& window, const ControlPath& path);

  ImGuiContext* context_;
};

}  // namespace splatray
