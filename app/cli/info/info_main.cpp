/// splatray-info: what files hold, without a scene being built of them.
#include <algorithm>
#include <cstdio>

#include "app/cli/info/file_info.h"
#include "app/cli/option_list.h"
#include "app/library/request/fields.h"
#include "engine/base/error.h"
#include "engine/base/interrupt.h"
#include "engine/base/memory.h"
#include "engine/base/progress.h"
#include "preprocess/read/formats.h"
#include "preprocess/read/scan/input_files.h"

namespace {

using namespace splatray;

struct Options {
  std::vector<std::filesystem::path> files;
  InfoOptions asked;
  bool json = false;
};

bool parse(int argc, char** argv, Options& options) {
  OptionList list("Shows what files of points, meshes or scenes hold, without building a scene of them.",
                  "splatray-info");
  list.add_paths("INPUT", options.files,
                 "a .soct scene, points, meshes or scenes, or folders of scans: " + format_extensions(),
                 "FILE");
  list.require("INPUT");
  list.set_extensions("INPUT", ".soct " + format_extensions());
  list.set_brief("INPUT", "scenes, points, meshes, or folders of scans");
  list.add_switch("--head", options.asked.heads_only,
                  "of .las, .laz and .e57 only what their heads say, without reading the points");
  list.add_switch("--json", options.json, "a list of all files as JSON");
  const Field& columns = *find_field("columns", DOOR_PREPROCESS);
  list.add_value(
      "--columns", [&options](const std::string& names) { options.asked.columns = names; }, columns.help,
      columns.value);
  list.set_brief("--columns", columns.brief);
  list.set_brief("--head", "what the heads of .las, .laz and .e57 say, at once");
  list.set_brief("--json", "a list of all files as JSON");
  list.set_examples(
      {{"splatray-info survey.laz", "points, box, coordinate system, attributes, classes, scans"},
       {"splatray-info tiles/ --head", "of a folder of tiles, without reading their points"},
       {"splatray-info room.e57 --json > room.json", "for other programs"}});
  return list.parse(argc, argv);
}

void note(const std::string& sentence) {
  std::fprintf(stderr, "splatray-info: note: %s\n", sentence.c_str());
}

int run(int argc, char** argv) {
  Options options;
  if (!parse(argc, argv, options)) return static_cast<int>(ExitCode::done);
  catch_interrupts();
  const Progress progress =
      watching_memory([](const char* /*stage*/, double /*share*/) { return !interrupted(); });
  std::vector<FileInfo> infos;
  std::vector<Error> left_out;  // of a folder's files those that are something else
  for (const InputFile& file : input_files(options.files)) {
    try {
      infos.push_back(read_info(file.path, options.asked, progress));
    } catch (const Error& error) {
      if (!file.may_be_left_out || error.code() != ExitCode::input_unreadable) throw;
      left_out.push_back(error);
      continue;
    }
    std::for_each(infos.back().notes.begin(), infos.back().notes.end(), note);
    if (!options.json) std::fputs(info_text(infos.back()).c_str(), stdout);
  }
  if (infos.empty() && !left_out.empty()) throw Error(left_out.front());
  for (const Error& error : left_out) note(std::string(error.what()) + "; it was left out");
  if (options.json) std::puts(info_json(infos).c_str());
  return static_cast<int>(ExitCode::done);
}

}  // namespace

int main(int argc, char** argv) { return splatray::run_main("splatray-info", run, argc, argv); }
