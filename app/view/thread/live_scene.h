/// The scene on the device, kept like the document: what changed is uploaded, the pools only where colours or
/// hidden points change.
#pragma once
#include <memory>

#include "app/library/shot/scene_on_device.h"
#include "app/library/user_folders.h"
#include "app/view/model/document.h"

namespace splatray {

/// A scene that threads share.
using SharedScene = std::shared_ptr<const Scene>;

/// On the render thread. The device must outlive it.
class LiveScene {
 public:
  explicit LiveScene(const Device& device) : shown_(device, {.pipeline_folder = user_cache_folder()}) {}

  /// Uploads another scene, with the colours and hidden points asked for; `planned`: as Tracer::upload has it, the scene is open then.
  /// Throws Error.
  void open(SharedScene scene, const AttributeOptions& attributes = {}, const Tracer::Planned& planned = {});
  /// Makes materials, lights, environment and up direction the document's, which is of the scene opened. Hidden objects
  /// stay hidden in `mode` facing, all others are two-sided there. Throws Error (input_unreadable) for an environment
  /// that cannot be read, once: the one before stays.
  void match(const Document& document, ViewMode mode);
  /// The same but for colours and hidden points, which are the document's: they may yet be uploaded.
  void match_look(const Document& document, ViewMode mode);

  /// As picture_lights.h has it for the document's picture of `size_px` pixels, though the document has lights; matches the document.
  [[nodiscard]] std::optional<SceneLight> light_at_camera(const Document& document, glm::uvec2 size_px);
  /// The exposure that suits the document's picture of `size_px` pixels, stops; matches the document.
  [[nodiscard]] double exposure_ev(const Document& document, glm::uvec2 size_px);

  [[nodiscard]] bool is_open() const { return scene_ != nullptr; }
  [[nodiscard]] const Scene& scene() const { return *scene_; }
  [[nodiscard]] const Look& look() const { return shown_.look(); }
  [[nodiscard]] SceneOnDevice& shown() { return shown_; }
  [[nodiscard]] const ColorLegend& legend() const { return legend_; }
  [[nodiscard]] Tracer& tracer() { return shown_.tracer(); }

 private:
  void match_attributes(const AttributeOptions& attributes, const glm::dvec3& up);
  /// A copy of the scene as the attributes are shown, which are then what is shown.
  Scene shown_with(const Scene& scene, const AttributeOptions& attributes);

  SceneOnDevice shown_;
  SharedScene scene_;
  AttributeOptions attributes_;  ///< as uploaded
  glm::dvec3 up_{0.0};           ///< of their heights
  ColorLegend legend_;
};

}  // namespace splatray
