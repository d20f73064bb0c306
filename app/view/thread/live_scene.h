/// The scene on the device, kept like the document: what changed is uploaded, the pools only where colours or
/// hidden points change.
#pragma once
#include <memory>
#include <optional>

#include "app/library/user_folders.h"
#include "app/view/model/document.h"
#include "engine/gpu/tracer.h"

namespace splatray {

/// A scene that threads share.
using SharedScene = std::shared_ptr<const Scene>;

/// On the render thread. The context must outlive it.
class LiveScene {
 public:
  explicit LiveScene(const Context& context) : tracer_(context, {.pipeline_folder = user_cache_folder()}) {}

  /// Uploads another scene. Throws Error.
  void open(SharedScene scene);
  /// Makes materials, lights, environment and up direction the document's, which is of the scene opened. Hidden objects
  /// stay hidden in `mode` facing, all others are two-sided there. Throws Error (input_unreadable) for an environment
  /// that cannot be read, once: the one before stays.
  void match(const Document& document, ViewMode mode);

  /// After others have given the tracer lights.
  void forget_lights() { lights_.reset(); }

  [[nodiscard]] bool is_open() const { return scene_ != nullptr; }
  [[nodiscard]] const Scene& scene() const { return *scene_; }
  [[nodiscard]] const ColorLegend& legend() const { return legend_; }
  [[nodiscard]] Tracer& tracer() { return tracer_; }

 private:
  void match_looks(const ObjectLooks& looks);
  void match_attributes(const AttributeOptions& attributes);
  void match_environment(const std::string& name);

  Tracer tracer_;
  SharedScene scene_;
  ObjectLooks looks_;  ///< as uploaded, and so on
  std::optional<std::vector<SceneLight>> lights_;
  std::optional<std::string> environment_;
  glm::dvec3 up_{0.0};
  AttributeOptions attributes_;
  ColorLegend legend_;
};

}  // namespace splatray
