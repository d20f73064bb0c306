// What is drawn over the picture at places of the scene: handles, boxes, measures, the point turned about.
#include <imgui.h>

#include <array>
#include <cmath>

#include "app/view/model/navigation.h"
#include "app/view/ui/panel_parts.h"

namespace splatray {
namespace {

constexpr ImU32 BOX = IM_COL32(255, 200, 60, 255), DROPPED = IM_COL32(240, 110, 90, 255),
                CUT = IM_COL32(90, 200, 250, 255), MEASURE = IM_COL32(255, 240, 120, 255),
                PIVOT = IM_COL32(255, 255, 255, 230), DARK = IM_COL32(0, 0, 0, 160);
constexpr float ARROW_EM = 2.0F, DOT_EM = 0.35F;

/// Draws at world places, in the picture alone.
class Marks {
 public:
  Marks(const Document& document, const PanelView& view, float width_px)
      : camera_(document.camera),
        size_px_(view.picture_px),
        em_(ImGui::GetFontSize()),
        list_(*ImGui::GetBackgroundDrawList()) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    to_window_ = {width_px / static_cast<float>(size_px_.x), display.y / static_cast<float>(size_px_.y)};
    list_.PushClipRect({0.0F, 0.0F}, {width_px, display.y});
  }
  ~Marks() { list_.PopClipRect(); }
  Marks(const Marks&) = delete;
  Marks& operator=(const Marks&) = delete;

  [[nodiscard]] std::optional<ImVec2> at(const glm::dvec3& world) const {
    const auto px = place_in_picture(camera_, world, size_px_);
    if (!px || glm::length(*px) > 1e5) return {};
    return ImVec2(static_cast<float>(px->x) * to_window_.x, static_cast<float>(px->y) * to_window_.y);
  }
  void line(const glm::dvec3& a, const glm::dvec3& b, ImU32 color, float width = 1.5F) {
    const auto from = at(a), to = at(b);
    if (!from || !to) return;
    list_.AddLine(*from, *to, DARK, width + 2.0F);
    list_.AddLine(*from, *to, color, width);
  }
  void dot(const glm::dvec3& world, ImU32 color, float em) {
    const auto place = at(world);
    if (!place) return;
    list_.AddCircleFilled(*place, em * em_ + 1.5F, DARK);
    list_.AddCircleFilled(*place, em * em_, color);
  }
  void text(const glm::dvec3& world, const std::string& words) {
    const auto place = at(world);
    if (!place || words.empty()) return;
    const ImVec2 size = ImGui::CalcTextSize(words.c_str()),
                 corner{place->x + 0.6F * em_, place->y - 1.6F * em_};
    list_.AddRectFilled({corner.x - 4.0F, corner.y - 2.0F},
                        {corner.x + size.x + 4.0F, corner.y + size.y + 2.0F}, DARK, 3.0F);
    list_.AddText(corner, MEASURE, words.c_str());
  }
  /// A dot with an arrow that is as long everywhere.
  void handle(const Grip& handle, ImU32 color, bool held) {
    dot(handle.place_world, color, held ? 1.4F * DOT_EM : DOT_EM);
    const auto from = at(handle.place_world);
    const double step = 1e-3 * glm::distance(camera_.eye, handle.place_world);
    const auto ahead = at(handle.place_world + step * handle.normal);
    if (!from || !ahead) return;
    const ImVec2 way{ahead->x - from->x, ahead->y - from->y};
    const float length = std::hypot(way.x, way.y);
    if (length < 0.05F) return;
    const float arrow = ARROW_EM * em_ / length;
    list_.AddLine(*from, {from->x + arrow * way.x, from->y + arrow * way.y}, color, 2.5F);
  }

 private:
  Camera camera_;
  glm::dvec2 size_px_;
  float em_;
  ImDrawList& list_;
  ImVec2 to_window_;
};

void box_edges(const std::optional<TurnedBox>& box, const glm::dvec3& up, ImU32 color, Marks& marks) {
  if (!box) return;
  const std::array<glm::dvec3, 8> corners = corners_of(*box, up);
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      if ((i >> axis & 1U) == 0) marks.line(corners[i], corners[i | std::size_t{1} << axis], color);
}

void region_marks(const Document& document, const Grip* held, Marks& marks) {
  box_edges(document.request.view.region.keep_box, up_of(document), BOX, marks);
  box_edges(document.request.view.region.drop_box, up_of(document), DROPPED, marks);
  for (const Grip& handle : handles_of(document)) {
    const bool is_held = held != nullptr && held->of == handle.of && held->number == handle.number;
    marks.handle(handle,
                 handle.of == GripOf::keep_box ? BOX : (handle.of == GripOf::drop_box ? DROPPED : CUT),
                 is_held);
  }
}

void measure_marks(const Document& document, Marks& marks) {
  for (const Measure& measure : document.measures) {
    if (measure.points.empty()) continue;
    std::vector<glm::dvec3> places;
    for (const SurfacePoint& point : measure.points) places.push_back(point.place);
    for (std::size_t i = 1; i < places.size(); ++i) marks.line(places[i - 1], places[i], MEASURE);
    if (is_outline(measure.kind) && places.size() > 2) marks.line(places.back(), places.front(), MEASURE);
    for (const glm::dvec3& place : places) marks.dot(place, MEASURE, 0.9F * DOT_EM);
    const bool at_corner = measure.kind == MeasureKind::angle;
    marks.text(at_corner ? places[places.size() / 2] : places.back(),
               labelled_text(measure, measure_frame(document)));
  }
}

}  // namespace

void scene_marks(const Document& document, const PanelState& state, const PanelView& view, float width_px) {
  if (view.picture_px.x == 0 || view.picture_px.y == 0 || document.materials.empty()) return;
  Marks marks(document, view, width_px);
  if (state.shows_handles) region_marks(document, view.handle, marks);
  measure_marks(document, marks);
  if (view.about_world) marks.dot(*view.about_world, PIVOT, 0.7F * DOT_EM);
}

}  // namespace splatray
