// What Tracer leaves on the device for a filter.
#include "engine/gpu/tracer_parts.h"

namespace splatray {

DeviceGuide Tracer::trace_guide(const Look& look, const View& view, const Settings& settings,
                                const std::optional<Settings>& base, const Progress& progress) {
  Impl& impl = *impl_;
  Runner& runner = impl.runner;
  runner.require_scene("trace_guide()");
  impl.start();
  runner.scene.show(look);
  const std::uint64_t pixels = std::uint64_t{view.width} * view.height;
  runner.queue->reserve(impl.guide_aov, pixels * sizeof(AovPixel));
  runner.queue->reserve(impl.guide_base, pixels * sizeof(vec4));
  runner.bind(*impl.guide_base);
  runner.scene.bindings().bind(BIND_AOV, *impl.guide_aov);
  if (!base) {
    const std::vector<vec4> white(pixels, vec4(1.0F));
    runner.queue->upload(*impl.guide_base, std::as_bytes(std::span(white)));
  }
  Dispatch aov = runner.aov_dispatch(view, settings);
  Dispatch samples = runner.picture_dispatch(view, base.value_or(settings));
  for (const Tile& tile : cut_into_tiles(view.width, view.height, progress ? PROMPT_PIXELS : TILE_PIXELS)) {
    aov.frame.tile_first = samples.frame.tile_first = tile.y * view.width + tile.x;
    runner.run(aim(aov, tile));
    std::uint32_t batch = 1;
    TileDispatch aimed = aim(samples, tile);
    if (base)
      trace_samples(runner, aimed, 0, base->samples, runner.work(samples), batch, [](std::uint32_t) {});
    report(progress, double(tile.y + tile.height) / view.height);
  }
  return {impl.guide_aov.get(), impl.guide_base.get()};
}

}  // namespace splatray
