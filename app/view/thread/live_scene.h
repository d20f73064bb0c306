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

  [[nodiscard]] bool is_open() const { return scene_ != nullptr; }
  [[nodiscard]] const Scene& scene() const { return *scene_; }
  [[nodiscard]] const Look& look() const { return look_; }
  [[nodiscard]] const ColorLegend& legend() const { return legend_; }
  [[nodiscard]] Tracer& tracer() { return tracer_; }

 private:
  void match_attributes(const AttributeOptions& attributes);
  void match_environment(const std::string& name);

  Tracer tracer_;
  SharedScene scene_;
  Look look_;
  std::optional<std::string> environment_;  ///< the name of the look's
  AttributeOptions attributes_;             ///< as uploaded
  ColorLegend legend_;
};

}  // namespace splatray
