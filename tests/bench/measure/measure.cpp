#include "tests/bench/measure/measure.h"

#include "engine/file/scene_file.h"
#include "tests/bench/cases/loaded_case.h"
#include "tests/bench/measure/frames.h"
#include "tests/bench/truth/bounces.h"
#include "tests/bench/truth/flip.h"
#include "tests/bench/truth/shading.h"
#include "tests/trace/agreement.h"
#include "tests/trace/rays.h"

namespace splatray::testing {
namespace {

double ppm(double part, double whole) { return 1e6 * part / whole; }

Intersect intersect_of(LoadedCase& loaded, const Run& run) {
  return [&tracer = loaded.variant_of(run).tracer, settings = loaded.settings_of(run)](
             std::span<const RayQuery> rays) { return tracer.intersect(rays, settings); };
}

void compare_with_truth(LoadedCase& loaded, std::vector<Json>& records) {
  const Truth truth = read_truth(loaded.folder() / "truth.bin", loaded.view().width, loaded.view().height);
  for (std::size_t i = 0; i < records.size(); ++i) {
    const Run& run = loaded.about().runs[i];
    Settings settings = loaded.settings_of(run);
    settings.aov = true;
    const Image image = loaded.variant_of(run).tracer.render(loaded.view(), settings);
    records[i]["error"]["truth"] = loaded.prepared().truth;
    add_errors(records[i]["error"], errors_of(image, truth, loaded.view(), loaded.prepared().diagonal_world));
  }
}

void probe(LoadedCase& loaded, std::vector<Json>& records) {
  std::map<const LoadedVariant*, Probes> probes;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const Run& run = loaded.about().runs[i];
    LoadedVariant& variant = loaded.variant_of(run);
    const auto found =
        probes.try_emplace(&variant, *loaded.about().shape, variant.root, loaded.about().rays, 1).first;
    add_errors(records[i]["error"],
               found->second.measure(intersect_of(loaded, run), variant.prepared.radius_median_world));
  }
}

void compare_with_brute_force(LoadedCase& loaded, std::vector<Json>& records) {
  const Run& first = loaded.about().runs.front();
  const Scene scene = read_scene(loaded.folder() / file_name(first.variant));
  const BruteForce brute(scene);
  const Settings settings = loaded.settings_of(first);
  std::vector<RayQuery> rays = random_primary_rays(scene, loaded.about().rays, 1);
  const std::vector<RayQuery> secondary = secondary_rays(scene, rays, all_nearest(brute, rays, settings), 2);
  rays.insert(rays.end(), secondary.begin(), secondary.end());
  const std::vector<TrueHit> truth = all_nearest(brute, rays, settings);
  for (std::size_t i = 0; i < records.size(); ++i) {
    ShownTracer& tracer = loaded.variant_of(loaded.about().runs[i]).tracer;
    const Agreement agreement = agreement_of(brute, truth, tracer.intersect(rays, settings));
    records[i]["error"]["truth"] = "brute force";
    records[i]["error"]["mismatch_ppm"] =
        ppm(static_cast<double>(agreement.exceptions()), static_cast<double>(agreement.rays));
  }
}

void follow_mirrors(LoadedCase& loaded, std::vector<Json>& records) {
  const Case& one = loaded.about();
  for (std::size_t i = 0; i < records.size(); ++i) {
    LoadedVariant& variant = loaded.variant_of(one.runs[i]);
    const Intersect intersect = intersect_of(loaded, one.runs[i]);
    const double radius = variant.prepared.radius_median_world;
    const Bounces bounces = one.measure == Measure::wedge
                                ? wedge_bounces(intersect, variant.root, one.wedge_deg, radius, one.rays)
                                : ball_bounces(intersect, variant.root, radius, one.rays);
    records[i]["error"]["truth"] = "analytic";
    records[i]["error"]["wrong_bounces_ppm"] =
        ppm(static_cast<double>(bounces.wrong), static_cast<double>(bounces.counted));
  }
}

void count_leaks(LoadedCase& loaded, std::vector<Json>& records) {
  for (std::size_t i = 0; i < records.size(); ++i) {
    const Run& run = loaded.about().runs[i];
    Settings settings = loaded.settings_of(run);
    settings.counters = true;
    ShownTracer& tracer = loaded.variant_of(run).tracer;
    const Image image = tracer.render(loaded.view(), settings);
    double covered = 0.0;
    for (const vec4& pixel : image.rgba) covered += pixel.w;
    records[i]["error"]["truth"] = "analytic";
    records[i]["error"]["leaks_ppm"] =
        ppm(static_cast<double>(tracer.stats().counters[COUNT_LEAKED]), covered * settings.samples);
  }
}

std::vector<glm::vec3> display_of(const Image& image) {
  std::vector<glm::vec3> picture;
  for (const vec4& pixel : image.rgba) picture.push_back(srgb_8_bit(glm::dvec3(pixel)));
  return picture;
}

void compare_with_many_samples(LoadedCase& loaded, std::vector<Json>& records) {
  const View& view = loaded.view();
  const Run& first = loaded.about().runs.front();
  Settings many = loaded.settings_of(first);
  many.samples = REFERENCE_SAMPLES;
  many.seed = first.settings.seed + 1;
  const auto reference = display_of(loaded.variant_of(first).tracer.render(view, many));
  for (std::size_t i = 0; i < records.size(); ++i) {
    const Run& run = loaded.about().runs[i];
    const auto picture = display_of(loaded.variant_of(run).tracer.render(view, loaded.settings_of(run)));
    Json& error = records[i]["error"];
    error["truth"] = std::to_string(REFERENCE_SAMPLES) + " samples";
    set_number(error, "psnr_db", psnr_db(picture, reference));
    set_number(error, "flip_mean", flip_mean(reference, picture, view.width, view.height));
  }
}

}  // namespace

std::vector<Json> measure_case(const Device& device, const Case& one, const std::filesystem::path& folder) {
  LoadedCase loaded(device, one, folder);
  std::vector<Json> records;
  for (const Run& run : one.runs) records.push_back(loaded.start_record(run));
  switch (one.measure) {
    case Measure::picture:
      time_frames(loaded, records);
      compare_with_truth(loaded, records);
      if (one.shape) probe(loaded, records);
      break;
    case Measure::frame:
      time_frames(loaded, records);
      break;
    case Measure::brute_force:
      compare_with_brute_force(loaded, records);
      break;
    case Measure::wedge:
    case Measure::ball:
      follow_mirrors(loaded, records);
      break;
    case Measure::leaks:
      count_leaks(loaded, records);
      break;
    case Measure::samples:
      time_frames(loaded, records);
      compare_with_many_samples(loaded, records);
      break;
  }
  return records;
}

}  // namespace splatray::testing
