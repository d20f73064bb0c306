#include "tests/view/gui_driver.h"

#include <gtest/gtest.h>

#include <set>

namespace splatray {
namespace {

constexpr float STEP_PX = 5.0F;  ///< less than any control's height
constexpr int FRAMES_TO_SETTLE = 3;

void add(Requests& all, const Requests& more) {
  all.commands.insert(all.commands.end(), more.commands.begin(), more.commands.end());
  if (more.open) {
    all.open = more.open;
    all.add = more.add;
  }
  if (more.save) all.save = more.save;
  if (more.change) all.change = more.change;
  all.cancel |= more.cancel;
}

ImGuiID id_of(const ImGuiWindow& window, const ControlPath& path) {
  ImGuiID id = window.ID;
  for (const auto& part : path) {
    if (const int* number = std::get_if<int>(&part))
      id = ImHashData(number, sizeof(int), id);
    else
      id = ImHashStr(std::get<std::string>(part).c_str(), 0, id);
  }
  return id;
}

}  // namespace

GuiDriver::GuiDriver(float width_px, float height_px, double ui_scale) : context_(ImGui::CreateContext()) {
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.DisplaySize = {width_px, height_px};
  io.DeltaTime = 1.0F / 60.0F;
  state.ui_scale = ui_scale;
  set_style(ui_scale);
  unsigned char* pixels = nullptr;
  int width = 0, height = 0;
  io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
}

Requests GuiDriver::frame() {
  ImGui::NewFrame();
  Requests requests = draw_panels(document, state, view);
  ImGui::Render();
  return requests;
}

ImGuiWindow* GuiDriver::find(const std::string& window) const {
  for (ImGuiWindow* candidate : context_->Windows)
    if (candidate->WasActive && !candidate->Hidden &&
        std::string(candidate->Name).find(window) != std::string::npos)
      return candidate;
  return nullptr;
}

bool GuiDriver::point_at(const std::string& window, const ControlPath& path) {
  for (int i = 0; i < FRAMES_TO_SETTLE; ++i) frame();
  const ImGuiWindow* found = find(window);
  if (found == nullptr) return false;
  const ImGuiID wanted = id_of(*found, path);
  const ImRect area = found->Rect();
  for (float y = area.Min.y + 1.0F; y < area.Max.y; y += STEP_PX)
    for (float x = area.Min.x + 1.0F; x < area.Max.x; x += 2.0F * STEP_PX) {
      ImGui::GetIO().MousePos = {x, y};
      frame();
      if (context_->HoveredId == wanted && !context_->HoveredIdDisabled) return true;
    }
  return false;
}

Requests GuiDriver::click(const std::string& window, const ControlPath& path) {
  Requests all;
  EXPECT_TRUE(point_at(window, path)) << "nothing to click in " << window;
  for (const bool down : {true, false}) {
    ImGui::GetIO().MouseDown[0] = down;
    add(all, frame());
  }
  for (int i = 0; i < FRAMES_TO_SETTLE; ++i) add(all, frame());
  return all;
}

void GuiDriver::open_section(const char* title) {
  for (int i = 0; i < FRAMES_TO_SETTLE; ++i) frame();
  ImGuiWindow* column = find("##column");
  ASSERT_NE(column, nullptr);
  column->StateStorage.SetInt(id_of(*column, {title}), 1);
}

bool GuiDriver::can_click(const std::string& window, const ControlPath& path) {
  return point_at(window, path);
}

std::vector<bool> GuiDriver::are_there(const std::string& window, const std::vector<ControlPath>& paths) {
  constexpr float INSIDE_PX = 60.0F;  // within check boxes' names and all wider controls
  for (int i = 0; i < FRAMES_TO_SETTLE; ++i) frame();
  std::set<ImGuiID> met;
  const ImGuiWindow* found = find(window);
  const ImRect area = found != nullptr ? found->Rect() : ImRect();
  for (float y = area.Min.y + 1.0F; y < area.Max.y; y += STEP_PX) {
    ImGui::GetIO().MousePos = {area.Min.x + INSIDE_PX, y};
    frame();
    met.insert(context_->HoveredId);
  }
  std::vector<bool> there;
  for (const ControlPath& path : paths)
    there.push_back(found != nullptr && met.contains(id_of(*found, path)));
  return there;
}

float GuiDriver::width(const std::string& window, const ControlPath& path) {
  EXPECT_TRUE(point_at(window, path)) << "nothing to measure in " << window;
  ImVec2& mouse = ImGui::GetIO().MousePos;
  const ImGuiID wanted = context_->HoveredId;
  const float start = mouse.x;
  const auto reach = [&](float step) {
    for (mouse.x = start; context_->HoveredId == wanted; frame()) mouse.x += step;
    const float end = mouse.x - step;
    mouse.x = start;
    frame();
    return end;
  };
  const float left = reach(-1.0F);
  return reach(1.0F) - left + 1.0F;
}

ImRect GuiDriver::rectangle(const std::string& window) const {
  const ImGuiWindow* found = find(window);
  return found != nullptr ? found->Rect() : ImRect();
}

}  // namespace splatray
