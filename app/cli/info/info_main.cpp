/// splatray-info: what files hold, without a scene being built of them.
#include <cstdio>

#include "app/cli/info/file_info.h"
#include "app/cli/option_list.h"
#include "engine/base/error.h"
#include "engine/base/interrupt.h"
#include "engine/base/memory.h"
#include "engine/base/progress.h"
#include "preprocess/read/formats.h"

namespace {

using namespace splatray;

struct Options {
  std::vector<std::filesystem::path> files;
  bool heads_only = false;
  bool json = false;
};

bool parse(int argc, char** argv, Options& options) {
  OptionList list("Shows what files of points, meshes or scenes hold, without building a scene of them.",
                  "splatray-info");
  list.add_paths("INPUT", options.files, "a .soct scene, or points, meshes or scenes: " + format_extensions(),
                 "FILE");
  list.require("INPUT");
  list.add_switch("--head", options.heads_only,
                  "of .las, .laz and .e57 only what their heads say, without reading the points");
  list.add_switch("--json", options.json, "a list of all files as JSON");
  list.add_answer(
      "--version", [] { return SPLATRAY_VERSION; }, "print the version");
  return list.parse(argc, argv);
}

int run(int argc, char** argv) {
  Options options;
  if (!parse(argc, argv, options)) return static_cast<int>(ExitCode::done);
  catch_interrupts();
  const Progress progress =
      watching_memory([](const char* /*stage*/, double /*share*/) { return !interrupted(); });
  std::vector<FileInfo> infos;
  for (const std::filesystem::path& file : options.files) {
    infos.push_back(read_info(file, options.heads_only, progress));
    for (const std::string& note : infos.back().notes)
      std::fprintf(stderr, "splatray-info: note: %s\n", note.c_str());
    if (!options.json) std::fputs(info_text(infos.back()).c_str(), stdout);
  }
  if (options.json) std::puts(info_json(infos).c_str());
  return static_cast<int>(ExitCode::done);
}

}  // namespace

int main(int argc, char** argv) { return splatray::run_main("splatray-info", run, argc, argv); }
