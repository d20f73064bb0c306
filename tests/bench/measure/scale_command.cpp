/// splatray-bench scale FOLDER -o RECORDS.json --part PART [--quick] [--device D]: measures what splatray-bench prepare --scale
/// made; one JSON array of records. Links the engine only, so that it runs on a bare GPU machine.
#include <cstdio>

#include "engine/base/error.h"
#include "engine/file/atomic_file.h"
#include "tests/bench/cases/scale_cases.h"
#include "tests/bench/commands.h"
#include "tests/bench/measure/measure_cases.h"
#include "tests/bench/measure/measuring_options.h"
#include "tests/bench/measure/scale_coverage.h"
#include "tests/bench/measure/scale_features.h"
#include "tests/bench/measure/scale_rays.h"

namespace splatray::testing {
namespace {

constexpr const char* USAGE =
    "splatray-bench scale FOLDER -o RECORDS.json --part PART [--quick] [--device NUMBER|NAME]\n"
    "Measures the cases that splatray-bench prepare --scale made in FOLDER.\n"
    "  --part     rays: primary, shadow, mirrored and random rays at spheres of 10 k to 30 M splats\n"
    "             features: what each costs that is absent, there but out of view, and in view\n"
    "             coverage: frames of which 30 % or 99 % of the pixels hit\n"
    "  --quick    only the cases of splatray-bench prepare --scale --quick\n"
    "  --device   number or part of a name, as splatray-render --list-devices shows them; default the best\n";

std::vector<Case> cases_of(const std::string& part, bool quick) {
  if (part == "rays") return scale_spheres(quick);
  std::vector<Case> list{scale_sphere(quick)};
  if (part == "features") return list;
  if (part != "coverage")
    throw Error(ExitCode::usage, "found --part '" + part + "', expected rays, features or coverage");
  for (const Case& one : scale_scenes(quick)) list.push_back(one);
  return list;
}

std::vector<Json> measure_part(const std::string& part, const Device& device, const Case& one,
                               const std::filesystem::path& folder) {
  if (part == "rays") return measure_rays(device, one, folder, {});
  if (part == "features") return measure_features(device, one, folder);
  return measure_coverage(device, one, folder);
}

}  // namespace

int bench_scale(int argc, char** argv) {
  const std::optional<MeasuringOptions> options = parse_measuring({argv + 1, argv + argc}, "--part");
  if (!options) {
    std::fputs(USAGE, stdout);
    return static_cast<int>(ExitCode::done);
  }
  const std::vector<Case> cases = cases_of(options->only, options->quick);
  require_writable(options->output);
  const std::unique_ptr<Device> device = open_device(options->device);
  std::printf("%s, %s\n", device->info().name.c_str(), device->info().driver.c_str());
  measure_cases(cases, options->folder, options->output,
                [&](const Case& one, const std::filesystem::path& prepared) {
                  return measure_part(options->only, *device, one, prepared);
                });
  return static_cast<int>(ExitCode::done);
}

}  // namespace splatray::testing
