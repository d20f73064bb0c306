#include "app/stats_json.h"

#include <nlohmann/json.hpp>

#include "app/commit.h"
#include "engine/host/atomic_file.h"
#include "preprocess/build_report.h"

namespace splatray {
namespace {

using Json = nlohmann::ordered_json;

Json scene_json(const Scene& scene) {
  return {{"splats", scene.splat_count},
          {"references", scene.data_pool.size()},
          {"nodes", scene.node_pool.size()},
          {"filled_leaves", scene.begin_end.size() - 1},
          {"objects", scene.materials.size()},
          {"lights", scene.lights.size()},
          {"diagonal_world", scene.diagonal_world()}};
}

Json counters_json(const RenderStats& stats) {
  const auto& count = stats.counters;
  return {{"rays_primary", count[COUNT_PRIMARY]},
          {"rays_shadow", count[COUNT_SHADOW]},
          {"rays_reflected", count[COUNT_REFLECTED]},
          {"rays_refracted", count[COUNT_REFRACTED]},
          {"leaves", count[COUNT_LEAVES]},
          {"node_steps", count[COUNT_NODE_STEPS]},
          {"splat_tests", count[COUNT_TESTS]},
          {"hits", count[COUNT_HITS]},
          {"lost", count[COUNT_LOST]},
          {"leaked", count[COUNT_LEAKED]},
          {"non_finite", count[COUNT_NON_FINITE]},
          {"bounce_limit", count[COUNT_BOUNCE_LIMIT]},
          {"energy_lost", static_cast<double>(count[COUNT_ENERGY_LOST]) / 1024.0}};
}

}  // namespace

void write_stats(const std::filesystem::path& path, const LoadedScene& loaded, const View& view,
                 const Settings& settings, const Context& context, const Tracer& tracer,
                 const StageTimes& times) {
  const DeviceInfo& device = context.device_info();
  const PoolBytes& bytes = tracer.pool_bytes();
  Json json = {
      {"commit", COMMIT},
      {"device",
       {{"name", device.name}, {"type", device.type}, {"driver", device.driver}, {"api", device.api}}},
      {"scene", scene_json(loaded.scene)},
      {"picture",
       {{"width", view.width},
        {"height", view.height},
        {"samples", settings.samples},
        {"seed", settings.seed}}},
      {"times_ms",
       {{"device", times.device_ms},
        {"load", loaded.load_ms},
        {"upload", times.upload_ms},
        {"trace", tracer.stats().trace_ms},
        {"render", tracer.stats().wall_ms},
        {"write", times.write_ms}}},
      {"bytes",
       {{"node_pool", bytes.node_pool},
        {"begin_end", bytes.begin_end},
        {"data_pool", bytes.data_pool},
        {"color_pool", bytes.color_pool},
        {"field_pool", bytes.field_pool},
        {"environment", bytes.environment},
        {"texel_buffers", bytes.texel_buffers}}}};
  if (loaded.build) json["build"] = Json::parse(build_stats_json(*loaded.build));
  if (settings.counters) json["counters"] = counters_json(tracer.stats());
  write_text_file(json.dump(2) + '\n', path);
}

}  // namespace splatray
