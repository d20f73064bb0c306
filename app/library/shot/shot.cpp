#include "app/library/shot/shot.h"

namespace splatray {

Settings Shot::traced_settings() const {
  Settings traced = settings;
  traced.aov = traced.aov || denoises();
  traced.estimate_error = traced.estimate_error || denoises() || request.output.despeckle;
  return traced;
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

std::string choices_text(const Shot& shot) {
  std::string text;
  for (const FieldText& choice : shot.choices)
    text += (text.empty() ? "--" : " --") + choice.name + (choice.text == "on" ? "" : " " + choice.text);
  return text;
}

}  // namespace splatray
