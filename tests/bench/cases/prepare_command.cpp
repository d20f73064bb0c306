/// splatray-bench prepare -o FOLDER [--scale] [--keep] [--quick]: scene files, cameras and truths for splatray-bench.
#include <algorithm>
#include <cstdio>

#include "app/cli/option_types.h"
#include "engine/base/error.h"
#include "tests/bench/cases/prepare.h"
#include "tests/bench/cases/scale_cases.h"
#include "tests/bench/commands.h"
#include "tests/bench/measure/memory.h"
#include "tests/trace/scenes.h"

namespace splatray::testing {
namespace {

/// Most memory of making a scene, for each of its points.
constexpr std::uint64_t BYTES_PER_POINT = 160;

std::vector<Case> cases_of_scale(bool quick) {
  std::vector<Case> list = scale_spheres(quick);
  for (const Case& one : scale_scenes(quick)) list.push_back(one);
  return list;
}

std::string reason_of_size(const Case& one) {
  std::uint64_t most = 0;
  for (const Variant& variant : variants_of(one)) most = std::max(most, variant.points);
  return reason_of_memory(BYTES_PER_POINT * most);
}

/// Makes the case unless there is a reason not to; what became of it.
std::string prepare(const Case& one, const Folders& folders, bool keep) {
  if (keep && std::filesystem::exists(folders.output / folder_name(one) / "case.json")) return "kept";
  for (const std::string& reason : {reason_to_leave_out(one, folders), reason_of_size(one)})
    if (!reason.empty()) return "left out, " + reason;
  prepare_case(one, folders);
  return "made";
}

}  // namespace

int bench_prepare(int argc, char** argv) {
  OptionList list(
      "Makes scene files, cameras and truths for splatray-bench. Real models come from SPLATRAY_DATA_DIR.",
      "splatray-bench prepare");
  Folders folders{SPLATRAY_REPOSITORY, data_folder().value_or(""), {}};
  bool quick = false, scale = false, keep = false;
  std::string only;
  add_path(list, "-o,--output", folders.output, "folder to write to, made when missing");
  list.require("--output");
  list.add_switch("--quick", quick, "only the cases that take less than a minute to make and measure");
  list.add_switch("--scale", scale, "the cases of splatray-bench scale");
  list.add_switch("--keep", keep, "leave what was made before as it is");
  add_text(list, "--case", only, "only this case");
  if (!list.parse(argc, argv)) return static_cast<int>(ExitCode::done);
  for (const Case& one : scale ? cases_of_scale(quick) : cases(quick)) {
    if (!only.empty() && one.name != only) continue;
    std::printf("%s: %s\n", one.name.c_str(), prepare(one, folders, keep).c_str());
    std::fflush(stdout);
  }
  return static_cast<int>(ExitCode::done);
}

}  // namespace splatray::testing
