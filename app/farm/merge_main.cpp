/// splatray-merge: parts of a picture in, the picture out.
#include <algorithm>

#include "app/cli/option_list.h"
#include "app/cli/option_types.h"
#include "app/farm/join_tiles.h"
#include "app/library/codec/picture_format.h"
#include "app/library/picture/picture_file.h"
#include "app/library/picture/reproduce.h"
#include "app/library/shot/resolve.h"
#include "engine/base/error.h"
#include "engine/base/interrupt.h"
#include "engine/file/atomic_file.h"
#include "engine/file/file_roles.h"
#include "preprocess/base/file_extension.h"

namespace {

using namespace splatray;

struct Options {
  std::vector<std::filesystem::path> parts;
  std::filesystem::path output;
  bool mixed_devices = false;
};

bool parse(int argc, char** argv, Options& options) {
  OptionList list(
      "Joins the parts of a picture that splatray-render made with --tile, --crop or --sample-offset.",
      "splatray-merge");
  list.add_paths("PART", options.parts,
                 "an EXR with a part of the picture; each sample of each pixel must be in one", "FILE");
  list.require("PART");
  list.set_extensions("PART", ".exr");
  list.set_brief("PART", "EXRs, each with a part of the picture");
  add_path(list, "-o,--output", options.output,
           "the picture: .exr, the very file that one splatray-render writes, or .png, .jpg or .webp with "
           "its exposure and tone");
  list.require("--output");
  list.set_brief("--output", "the picture: .exr, .png, .jpg or .webp");
  list.add_switch("--mixed-devices", options.mixed_devices,
                  "join parts of several devices or drivers, whose samples may differ");
  list.set_brief("--mixed-devices", "join parts of several devices or drivers");
  list.set_examples(
      {{"splatray-merge part.*.exr -o picture.exr", "the very file that one process would have written"},
       {"splatray-merge part.1.exr part.2.exr -o picture.png", "with the exposure and tone of the parts"},
       {"splatray-merge part.*.exr -o picture.exr --mixed-devices", "of machines with other drivers"}});
  if (!list.parse(argc, argv)) return false;
  if (!is_picture_format(options.output))
    throw Error(ExitCode::usage, "found output '" + options.output.string() +
                                     "', expected -o with a file of " + PICTURE_NAMES);
  return true;
}

int merge(int argc, char** argv) {
  Options options;
  if (!parse(argc, argv, options)) return static_cast<int>(ExitCode::done);
  std::for_each(options.parts.begin(), options.parts.end(), note_input);
  claim_output(options.output);
  require_writable(options.output);
  require_picture_writer(options.output);
  catch_interrupts();
  const ExrPicture picture = join_tiles(options.parts, options.mixed_devices);
  if (lower_extension(options.output) == ".exr") {
    write_exr(picture, options.output);
  } else {
    write_output(draft(read_picture_request(options.parts.front())), image_of(picture), picture.metadata,
                 options.output);
  }
  return static_cast<int>(ExitCode::done);
}

}  // namespace

int main(int argc, char** argv) { return splatray::run_main("splatray-merge", merge, argc, argv); }
