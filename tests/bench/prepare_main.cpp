/// splatray-bench-prepare -o FOLDER [--quick]: scene files, cameras and truths for splatray-bench.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "engine/host/error.h"
#include "preprocess/option_types.h"
#include "tests/bench/prepare.h"
#include "tests/trace/scenes.h"

namespace splatray::testing {
namespace {

int run(int argc, char** argv) {
  CLI::App app(
      "Makes scene files, cameras and truths for splatray-bench. Real models come from SPLATRAY_DATA_DIR.",
      "splatray-bench-prepare");
  Folders folders{SPLATRAY_REPOSITORY, data_folder().value_or(""), {}};
  bool quick = false;
  std::string only;
  app.add_option("-o,--output", folders.output, "folder to write to, made when missing")->required();
  app.add_flag("--quick", quick, "only the cases that take less than a minute to make and measure");
  app.add_option("--case", only, "only this case");
  if (!parse_options(app, argc, argv)) return static_cast<int>(ExitCode::done);
  for (const Case& one : cases(quick)) {
    if (!only.empty() && one.name != only) continue;
    const std::string reason = reason_to_leave_out(one, folders);
    if (reason.empty()) prepare_case(one, folders);
    std::printf("%s: %s\n", one.name.c_str(), reason.empty() ? "made" : ("left out, " + reason).c_str());
    std::fflush(stdout);
  }
  return static_cast<int>(ExitCode::done);
}

}  // namespace
}  // namespace splatray::testing

int main(int argc, char** argv) {
  return splatray::run_main("splatray-bench-prepare", splatray::testing::run, argc, argv);
}
