/// splatray-bench-peers FOLDER -o PEERS.json [--quick] [--case NAME]: measures other ray tracers on what
/// splatray-bench-prepare made; one JSON array of records (record.h).
#include <CLI/CLI.hpp>

#include "app/cli/option_types.h"
#include "engine/base/error.h"
#include "engine/file/atomic_file.h"
#include "tests/bench/measure/measure_cases.h"
#include "tests/bench/peers/peer_measure.h"
#include "tests/trace/scenes.h"

namespace splatray::testing {
namespace {

int run(int argc, char** argv) {
  CLI::App app("Measures Embree on the cases that splatray-bench-prepare made in FOLDER.",
               "splatray-bench-peers");
  std::filesystem::path folder, output;
  std::string only;
  bool quick = false;
  app.add_option("folder", folder, "what splatray-bench-prepare wrote")->required();
  app.add_option("-o,--output", output, "JSON file to write: one record for each run")->required();
  app.add_flag("--quick", quick, "only the cases of splatray-bench-prepare --quick, and fewer peers");
  app.add_option("--case", only, "only this case");
  if (!parse_options(app, argc, argv)) return static_cast<int>(ExitCode::done);
  require_writable(output);
  std::vector<Case> list = named(cases(quick), only);
  std::erase_if(list, [](const Case& one) { return !has_peers(one); });
  measure_cases(list, folder, output, [&](const Case& one, const std::filesystem::path& prepared) {
    return measure_peers(one, prepared, data_folder().value_or(""), quick);
  });
  return static_cast<int>(ExitCode::done);
}

}  // namespace
}  // namespace splatray::testing

int main(int argc, char** argv) {
  return splatray::run_main("splatray-bench-peers", splatray::testing::run, argc, argv);
}
