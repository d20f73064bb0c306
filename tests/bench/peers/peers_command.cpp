/// splatray-bench peers FOLDER -o PEERS.json [--quick] [--case NAME]: measures other ray tracers on what
/// splatray-bench prepare made; one JSON array of records (record.h).
#include "app/cli/option_types.h"
#include "engine/base/error.h"
#include "engine/file/atomic_file.h"
#include "tests/bench/commands.h"
#include "tests/bench/measure/measure_cases.h"
#include "tests/bench/peers/peer_measure.h"
#include "tests/trace/scenes.h"

namespace splatray::testing {
int bench_peers(int argc, char** argv) {
  OptionList list("Measures Embree on the cases that splatray-bench prepare made in FOLDER.",
                  "splatray-bench peers");
  std::filesystem::path folder, output;
  std::string only;
  bool quick = false;
  add_path(list, "FOLDER", folder, "what splatray-bench prepare wrote");
  list.require("FOLDER");
  add_path(list, "-o,--output", output, "JSON file to write: one record for each run");
  list.require("--output");
  list.add_switch("--quick", quick, "only the cases of splatray-bench prepare --quick, and fewer peers");
  add_text(list, "--case", only, "only this case");
  if (!list.parse(argc, argv)) return static_cast<int>(ExitCode::done);
  require_writable(output);
  std::vector<Case> chosen = named(cases(quick), only);
  std::erase_if(chosen, [](const Case& one) { return !has_peers(one); });
  measure_cases(chosen, folder, output, [&](const Case& one, const std::filesystem::path& prepared) {
    return measure_peers(one, prepared, data_folder().value_or(""), quick);
  });
  return static_cast<int>(ExitCode::done);
}

}  // namespace splatray::testing
