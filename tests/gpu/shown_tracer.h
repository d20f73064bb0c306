/// A tracer for tests and benchmarks that change one thing after the other of what a scene is seen in.
#pragma once
#include "engine/gpu/tracer.h"
#include "engine/scene/phong.h"

namespace splatray {

/// Keeps the look: that of the scene uploaded last, in the environment of before, with what a test changed of it.
class ShownTracer : public Tracer {
 public:
  using Tracer::Tracer;

  void upload(const Scene& scene) {
    Tracer::upload(scene);
    take_look(scene);
  }
  void upload_and_free(Scene& scene) {
    take_look(scene);
    Tracer::upload_and_free(scene);
  }
  void set_environment(Environment environment) {
    look.environment = std::make_shared<const Environment>(std::move(environment));
  }
  void set_materials(std::vector<Material> materials) {
    for (Material& material : materials) follow_phong(material);
    look.materials = std::move(materials);
  }

  [[nodiscard]] Image render(const View& view, const Settings& settings, const Progress& progress = {},
                             Stopped stopped = Stopped::dropped) {
    return Tracer::render(look, view, settings, progress, stopped);
  }
  [[nodiscard]] Image render_until(const View& view, const Settings& settings, const Goal& goal,
                                   const Progress& progress = {}) {
    return Tracer::render_until(look, view, settings, goal, progress);
  }
  void begin(const View& view, const Settings& settings) { Tracer::begin(look, view, settings); }
  [[nodiscard]] std::vector<AovPixel> trace_aov(const View& view, const Settings& settings,
                                                const Progress& progress = {}) {
    return Tracer::trace_aov(look, view, settings, progress);
  }
  [[nodiscard]] std::vector<RayHit> intersect(std::span<const RayQuery> rays, const Settings& settings) {
    return Tracer::intersect(look, rays, settings);
  }

  Look look;

 private:
  void take_look(const Scene& scene) {
    auto environment = std::move(look.environment);
    look = look_of(scene);
    look.environment = std::move(environment);
  }
};

}  // namespace splatray
