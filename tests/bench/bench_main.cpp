/// splatray-bench FOLDER -o RUNS.json [--quick] [--device D]: measures what splatray-bench-prepare made; one JSON array of
/// records (record.h). Links the engine only, so that it runs on a bare GPU machine.
#include <cstdio>

#include "engine/host/atomic_file.h"
#include "engine/host/error.h"
#include "tests/bench/measure.h"
#include "tests/bench/measuring_options.h"

namespace splatray::testing {
namespace {

constexpr const char* USAGE =
    "splatray-bench FOLDER -o RUNS.json [--quick] [--device NUMBER|NAME] [--case NAME]\n"
    "Measures the cases that splatray-bench-prepare made in FOLDER and writes one record for each run.\n"
    "  --quick    only the cases of splatray-bench-prepare --quick\n"
    "  --device   number or part of a name, as splatray-render --list-devices shows them; default the best\n"
    "  --case     only this case\n";

int run(int argc, char** argv) {
  const std::optional<MeasuringOptions> options = parse_measuring({argv + 1, argv + argc}, "--case");
  if (!options) {
    std::fputs(USAGE, stdout);
    return static_cast<int>(ExitCode::done);
  }
  require_writable(options->output);
  const Context context(options->device);
  std::printf("%s, %s\n", context.device_info().name.c_str(), context.device_info().driver.c_str());
  Json records = Json::array();
  for (const Case& one : cases(options->quick)) {
    if (!options->only.empty() && one.name != options->only) continue;
    const std::filesystem::path folder = options->folder / folder_name(one);
    if (!std::filesystem::exists(folder / "case.json")) {
      std::printf("%s: left out, it was not prepared\n", one.name.c_str());
      continue;
    }
    for (const Json& record : measure_case(context, one, folder)) records.push_back(record);
    std::printf("%s: %zu runs\n", one.name.c_str(), one.runs.size());
    std::fflush(stdout);
  }
  write_text_file(records.dump(1) + '\n', options->output);
  return static_cast<int>(ExitCode::done);
}

}  // namespace
}  // namespace splatray::testing

int main(int argc, char** argv) {
  return splatray::run_main("splatray-bench", splatray::testing::run, argc, argv);
}
