#include "app/library/shot/shot.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace splatray {
namespace {

std::vector<Camera> orbit_cameras(const Camera& still, const glm::dvec3& up, std::uint32_t columns,
                                  std::uint32_t rows) {
  const glm::dmat3 upright = upright_axes(up);
  const glm::dvec3 from_target = still.eye - still.target;
  const double distance = glm::length(from_target);
  glm::dvec3 level = from_target - glm::dot(from_target, upright[1]) * upright[1];
  level = glm::length(level) > 1e-6 * distance ? glm::normalize(level) : upright[2];
  std::vector<Camera> cameras;
  for (std::uint32_t row = 0; row < rows; ++row) {
    Camera camera = still;
    if (rows > 1) {
      const double share = static_cast<double>(row) / (rows - 1);
      const double elevation =
          (ORBIT_LOWEST_DEG + (ORBIT_HIGHEST_DEG - ORBIT_LOWEST_DEG) * share) * std::numbers::pi / 180.0;
      camera.eye = still.target + distance * (std::cos(elevation) * level + std::sin(elevation) * upright[1]);
      camera.up = upright[1];
    }
    for (std::uint32_t column = 0; column < columns; ++column)
      cameras.push_back(turned_camera(camera, up, static_cast<double>(column) / columns));
  }
  return cameras;
}

}  // namespace

Settings Shot::traced_settings() const {
  Settings traced = settings;
  traced.aov = traced.aov || denoises() || std::holds_alternative<Orbit>(output);
  traced.estimate_error = traced.estimate_error || denoises() || request.output.despeckle;
  const bool meets_colors = settings.look == LOOK_LIT || settings.look == LOOK_SCAN;
  traced.albedo = denoises() && meets_colors && !request.settings.has_goal() && request.output.resume.empty();
  return traced;
}

Shot frame_shot(const Shot& shot, std::uint32_t frame) {
  Shot turned = shot;
  const auto* sequence = std::get_if<Sequence>(&shot.output);
  const bool in_studio = shot.environment.empty() || shot.environment == "studio";
  if (sequence == nullptr || sequence->turntable == 0 || !in_studio) return turned;
  const double turns = double{shot.settings.environment_turn} + double(frame) / sequence->turntable;
  turned.settings.environment_turn = static_cast<float>(turns - std::floor(turns));
  turned.request.settings.environment_turn = turned.settings.environment_turn;
  return turned;
}

void show_sheet(const Sheet& sheet, Shot& shot) {
  shot.view.width = sheet.width;
  shot.view.height = sheet.height;
  shot.view.window = window_of(shot.request.view, sheet.width, sheet.height);
  shot.view.camera = sheet.camera();
  shot.settings.region = region_of(shot.request.view.region, sheet.up);
  for (const HalfSpace& plane : sheet.planes()) shot.settings.region.kept.push_back(plane);
}

Shot sheet_shot(const Shot& shot, std::size_t index) {
  Sheet sheet = shot.sheet_set()->sheets[index];
  Shot one = shot;
  show_sheet(sheet, one);
  one.output = std::move(sheet);
  return one;
}

Camera frame_camera(const Shot& shot, std::uint32_t frame, const Scene& scene) {
  const auto* sequence = std::get_if<Sequence>(&shot.output);
  if (sequence == nullptr) return shot.view.camera;
  if (!sequence->path.empty()) return camera_at(sequence->path, frame);
  return turned_camera(shot.view.camera, shot.request.look.up.value_or(scene.up),
                       double(frame) / sequence->turntable);
}

Camera first_camera(const Shot& shot, const Scene& scene) {
  const auto* sequence = std::get_if<Sequence>(&shot.output);
  const bool has_path = sequence != nullptr && !sequence->path.empty();
  return frame_camera(shot, has_path ? sequence->path.front().frame : 0, scene);
}

std::vector<Camera> all_cameras(const Shot& shot, const Scene& scene) {
  if (const auto* orbit = std::get_if<Orbit>(&shot.output))
    return orbit_cameras(shot.view.camera, shot.request.look.up.value_or(scene.up), orbit->columns,
                         orbit->rows);
  std::vector<Camera> cameras;
  if (const SheetSet* set = shot.sheet_set()) {
    for (const Sheet& sheet : set->sheets) cameras.push_back(sheet.camera());
    return cameras;
  }
  for (const SequenceFrame& frame : shot.frames) cameras.push_back(frame_camera(shot, frame.number, scene));
  return cameras;
}

std::vector<View> all_views(const Shot& shot, const Scene& scene) {
  std::vector<View> views;
  for (const Camera& camera : all_cameras(shot, scene))
    views.push_back({camera, shot.view.width, shot.view.height});
  if (const SheetSet* set = shot.sheet_set())
    for (std::size_t i = 0; i < views.size(); ++i) {
      views[i].width = set->sheets[i].width;
      views[i].height = set->sheets[i].height;
    }
  return views;
}

std::string choices_text(const Shot& shot) {
  std::string text;
  for (const FieldText& choice : shot.choices)
    text += (text.empty() ? "--" : " --") + choice.name + (choice.text == "on" ? "" : " " + choice.text);
  return text;
}

}  // namespace splatray
