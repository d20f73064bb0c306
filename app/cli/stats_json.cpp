#include "app/cli/stats_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/library/attributes.h"
#include "app/library/commit.h"
#include "engine/base/json_text.h"
#include "engine/file/atomic_file.h"
#include "preprocess/build_report.h"

namespace splatray {
namespace {

using Json = nlohmann::ordered_json;

Json scene_json(const Scene& scene, const PoolCounts& counts, std::size_t lights) {
  Json json = {{"splats", counts.splats},
               {"references", counts.references},
               {"nodes", counts.node_words},
               {"filled_leaves", counts.filled_leaves},
               {"objects", scene.materials.size()},
               {"lights", lights},
               {"diagonal_world", scene.diagonal_world()}};
  for (const Category& kind : categories_of(scene, COLUMN_KIND)) json["kinds"][kind.name] = kind.points;
  return json;
}

Json counters_json(const std::array<std::uint64_t, COUNTER_COUNT>& count) {
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
          {"energy_lost", static_cast<double>(count[COUNT_ENERGY_LOST]) / 1024.0},
          {"below", count[COUNT_BELOW]},
          {"energy_below", static_cast<double>(count[COUNT_BELOW_ENERGY]) / 1024.0}};
}

Json bytes_json(const PoolBytes& bytes) {
  Json json;
  for (std::size_t i = 0; i < POOLS; ++i) json[pool_kinds()[i].key] = bytes.pools[i];
  json["environment"] = bytes.environment;
  json["frame"] = bytes.frame;
  json["pages"] = bytes.pages;
  return json;
}

/// What was chosen, by the fields that ask for the same.
Json choices_json(const Shot& shot) {
  Json json = Json::object();
  for (const FieldText& choice : shot.choices) json[choice.name] = choice.text;
  return json;
}

/// Which way a scene stands, what decided that, and the number by which.
Json up_json(const UpFound& found) {
  return {{"direction", {found.up.x, found.up.y, found.up.z}},
          {"by", up_evidence_name(found.by)},
          {"figure", found.figure}};
}

/// The views of a scan that were tried, each with the figure that decided.
Json views_json(const Shot& shot) {
  Json json = Json::array();
  for (const CheckedView& view : shot.views)
    json.push_back({{"view", viewpoint_name(view.viewpoint)},
                    {"fault", view_fault_name(view.fault)},
                    {"share", view.share}});
  return json;
}

/// The pictures together, as if they were one.
PictureRecord sum_of(const std::vector<PictureRecord>& pictures) {
  PictureRecord sum;
  for (const PictureRecord& picture : pictures) {
    sum.lights = picture.lights;
    sum.stats.trace_ms += picture.stats.trace_ms;
    sum.stats.wall_ms += picture.stats.wall_ms;
    sum.write_ms += picture.write_ms;
    sum.denoise_ms += picture.denoise_ms;
    sum.stats.error = std::max(sum.stats.error, picture.stats.error);
    sum.stats.samples = std::max(sum.stats.samples, picture.stats.samples);
    for (std::size_t i = 0; i < COUNTER_COUNT; ++i) sum.stats.counters[i] += picture.stats.counters[i];
  }
  return sum;
}

Json frames_json(const std::vector<PictureRecord>& pictures) {
  Json frames = Json::array();
  for (const PictureRecord& picture : pictures)
    frames.push_back({{"frame", picture.frame.number},
                      {"trace_ms", picture.stats.trace_ms},
                      {"render_ms", picture.stats.wall_ms},
                      {"write_ms", picture.write_ms}});
  return frames;
}

}  // namespace

void write_stats(const Shot& shot, const LoadedScene& loaded, const PoolCounts& counts, const Device& device,
                 const PoolBytes& bytes, const StageTimes& times, const SequenceRecord& record) {
  const DeviceInfo& info = device.info();
  const PictureRecord sum = sum_of(record.made);
  const Settings& settings = shot.settings;
  Json json = {
      {"commit", COMMIT},
      {"device", {{"name", info.name}, {"type", info.type}, {"driver", info.driver}, {"api", info.api}}},
      {"scene", scene_json(loaded.scene, counts, sum.lights)},
      {"picture",
       {{"width", shot.view.width},
        {"height", shot.view.height},
        {"samples", sum.stats.samples},
        {"error", sum.stats.error},
        {"seed", settings.seed}}},
      {"choices", choices_json(shot)},
      {"up", up_json(loaded.facts.up)},
      {"views", views_json(shot)},
      {"times_ms",
       {{"device", times.device_ms},
        {"load", loaded.load_ms},
        {"upload", times.upload_ms},
        {"exposure", times.exposure_ms},
        {"trace", sum.stats.trace_ms},
        {"render", sum.stats.wall_ms},
        {"write", sum.write_ms}}},
      {"bytes", bytes_json(bytes)}};
  if (loaded.build) json["build"] = Json::parse(build_stats_json(*loaded.build));
  if (settings.counters) json["counters"] = counters_json(sum.stats.counters);
  if (!shot.lod_error.empty()) json["lod_error"] = shot.lod_error;
  if (shot.denoises()) json["times_ms"]["denoise"] = sum.denoise_ms;
  if (shot.is_sequence()) json["frames"] = frames_json(record.made);
  write_text_file(json_text(json, 2) + '\n', shot.request.output.stats_json);
}

}  // namespace splatray
