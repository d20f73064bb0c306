/// splatray-bench run FOLDER -o RUNS.json [--quick] [--device D]: measures what splatray-bench prepare made; one JSON array of
/// records (record.h). Links the engine only, so that it runs on a bare GPU machine.
#include <cstdio>

#include "engine/base/error.h"
#include "engine/file/atomic_file.h"
#include "tests/bench/commands.h"
#include "tests/bench/measure/measure.h"
#include "tests/bench/measure/measure_cases.h"
#include "tests/bench/measure/measuring_options.h"

namespace splatray::testing {
namespace {

constexpr const char* USAGE =
    "splatray-bench run FOLDER -o RUNS.json [--quick] [--device NUMBER|NAME] [--case NAME]\n"
    "Measures the cases that splatray-bench prepare made in FOLDER and writes one record for each run.\n"
    "  --quick    only the cases of splatray-bench prepare --quick\n"
    "  --device   number or part of a name, as splatray-render --list-devices shows them; default the best\n"
    "  --case     only this case\n";

}  // namespace

int bench_run(int argc, char** argv) {
  const std::optional<MeasuringOptions> options = parse_measuring({argv + 1, argv + argc}, "--case");
  if (!options) {
    std::fputs(USAGE, stdout);
    return static_cast<int>(ExitCode::done);
  }
  require_writable(options->output);
  const std::unique_ptr<Device> device = open_device(options->device);
  std::printf("%s, %s\n", device->info().name.c_str(), device->info().driver.c_str());
  measure_cases(named(cases(options->quick), options->only), options->folder, options->output,
                [&](const Case& one, const std::filesystem::path& prepared) {
                  return measure_case(*device, one, prepared);
                });
  return static_cast<int>(ExitCode::done);
}

}  // namespace splatray::testing
