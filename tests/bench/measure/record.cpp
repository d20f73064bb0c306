#include "tests/bench/measure/record.h"

#include <cmath>
#include <ctime>

#include "app/library/commit.h"

namespace splatray::testing {
namespace {

std::string sampling_word(const Case& one, const Variant& variant) {
  if (one.origin == Origin::mesh && variant.points == 0) return "vertices";
  return variant.even ? "even" : "random";
}

Json settings_json(const Case& one, const Run& run, std::uint64_t splats) {
  const BuildParams& build = run.variant.build;
  const Settings& settings = run.settings;
  return {{"splats", splats},
          {"sampling", sampling_word(one, run.variant)},
          {"radius_rule", word(build.radius_rule)},
          {"radius_scale", build.radius_scale},
          {"normal_fields", build.normal_fields},
          {"clip", build.clip},
          {"leaf_size", build.leaf_size},
          {"insertion", word(build.insertion)},
          {"probes", build.probes},
          {"blend", blend_word(settings.blend)},
          {"kernel", kernel_word(settings.kernel)},
          {"kappa", settings.kappa},
          {"side", side_word(settings.side)},
          {"samples", settings.samples},
          {"shadows", settings.shadows},
          {"width", one.width},
          {"height", one.height}};
}

}  // namespace

std::string today() {
  const std::time_t now = std::time(nullptr);
  char text[16];
  std::strftime(text, sizeof(text), "%Y-%m-%d", std::gmtime(&now));
  return text;
}

Json start_record(const Case& one, const Run& run, std::uint64_t splats) {
  return {{"case", one.name},
          {"scene", one.scene},
          {"method", blend_word(run.settings.blend)},
          {"varied", run.varied},
          {"settings", settings_json(one, run, splats)},
          {"commit", COMMIT},
          {"date", today()}};
}

void set_number(Json& json, const std::string& key, double value) {
  if (std::isfinite(value)) json[key] = value;
}

Json share_json(const Share& share, std::uint64_t rays) {
  return {{"value", 1e6 * share.value}, {"low", 1e6 * share.low}, {"high", 1e6 * share.high}, {"rays", rays}};
}

void add_errors(Json& error, const Errors& errors) {
  set_number(error, "mismatch_ppm", errors.mismatch_ppm);
  set_number(error, "mismatch_edge_ppm", errors.mismatch_edge_ppm);
  set_number(error, "mismatch_inside_ppm", errors.mismatch_inside_ppm);
  set_number(error, "depth_signed_mean", errors.depth_signed_mean);
  set_number(error, "depth_abs_median", errors.depth_abs_median);
  set_number(error, "depth_abs_p99", errors.depth_abs_p99);
  set_number(error, "normal_median_deg", errors.normal_median_deg);
  set_number(error, "normal_p95_deg", errors.normal_p95_deg);
  set_number(error, "normal_p99_deg", errors.normal_p99_deg);
  set_number(error, "normal_rms_deg", errors.normal_rms_deg);
  set_number(error, "psnr_db", errors.psnr_db);
  set_number(error, "flip_mean", errors.flip_mean);
  if (errors.hole_rays > 0) error["holes_ppm"] = share_json(errors.holes, errors.hole_rays);
}

void add_errors(Json& error, const ProbeErrors& errors) {
  set_number(error, "normal_rms_deg", errors.normal_rms_deg);
  set_number(error, "jump_p999_deg", errors.jump_p999_deg);
  set_number(error, "view_inconsistency_p99_deg", errors.view_inconsistency_p99_deg);
  set_number(error, "depth_bias_r", errors.depth_bias_r);
  error["holes_ppm"] = share_json(errors.holes, errors.rays);
  error["overhangs_ppm"] = share_json(errors.overhangs, errors.rays);
}

}  // namespace splatray::testing
