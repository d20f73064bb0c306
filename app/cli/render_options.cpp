#include "app/cli/render_options.h"

#include <algorithm>

#include "app/cli/option_types.h"
#include "app/cli/options.h"
#include "app/library/codec/picture_format.h"
#include "app/library/picture/reproduce.h"
#include "app/library/picture/series/run_files.h"
#include "app/library/request/consistent.h"
#include "app/library/request/request_json.h"
#include "engine/base/error.h"
#include "engine/file/atomic_file.h"
#include "engine/file/file_roles.h"

namespace splatray {
namespace {

/// Files that say what is asked for, and where that is written.
struct RequestFiles {
  std::filesystem::path picture, request, save_request;
};

void add_request_files(OptionList& list, RequestFiles& files) {
  list.set_group(group_title(FieldGroup::files));
  add_path(
      list, "--from", files.picture,
      "make this picture again, from the request kept in it; options beside it replace parts of that, -o "
      "defaults to "
      "its name with .again; relative paths in it are looked for here, then in its folder and those above");
  add_path(list, "--request", files.request,
           "a request (JSON: names of options without dashes, and their values); options beside it replace "
           "parts of it");
  add_path(list, "--save-request", files.save_request,
           "write all that is asked for here, as --request reads it, and end");
  list.set_brief("--from", "make this picture again, with the options beside it");
}

/// Whether options ask for another picture than the one that is made again.
bool changes_picture(const std::vector<FieldText>& values) {
  return std::any_of(values.begin(), values.end(), [](const FieldText& value) {
    return value.name != "output" && value.name != "quiet" && value.name != "device";
  });
}

bool names(const std::vector<FieldText>& values, const char* name) {
  return std::any_of(values.begin(), values.end(),
                     [&](const FieldText& value) { return value.name == name; });
}

/// What the options stand on: the request of a picture or of a file.
Request base_request(const RequestFiles& files, const std::vector<FieldText>& values) {
  if (!files.picture.empty() && !files.request.empty())
    throw Error(ExitCode::usage, "found --from and --request, expected one of them");
  if (!files.request.empty()) return read_request(files.request);
  Request request;
  if (files.picture.empty()) return request;
  note_input(files.picture);
  request = read_picture_request(files.picture);
  const std::string choices = kept_choices(files.picture);
  if (!changes_picture(values)) request.output.chosen = choices;
  // A background that was chosen beside the studio would hide other surroundings.
  if (names(values, "environment") && choices.find("--background ") != std::string::npos)
    request.settings.background.reset();
  request.output.path = files.picture;
  request.output.path.replace_extension(".again" + files.picture.extension().string());
  const auto output = std::find_if(values.rbegin(), values.rend(),
                                   [](const FieldText& value) { return value.name == "output"; });
  if (output != values.rend() && is_display_format(output->text))
    assign(request, std::vector<FieldText>{{"aov", ""}}, DOOR_RENDER);
  return request;
}

}  // namespace

std::optional<GivenRequest> parse_render_options(int argc, char** argv) {
  OptionList list("Ray-traces a scene of splats into pictures.", "splatray-render");
  GivenFields given;
  RequestFiles files;
  add_fields(list, DOOR_RENDER, "SCENE", given);
  add_request_files(list, files);
  list.set_examples({{"splatray-render survey.laz -o survey.png",
                      "view, colours, light and exposure follow from what the scan is of"},
                     {"splatray-render room.e57 -o room.png --view dollhouse --samples 64",
                      "into a room from above, with less noise"},
                     {"splatray-render --from room.png -o poster.png --resolution 3840x2160",
                      "the same picture again, larger"}});
  if (!list.parse(argc, argv)) return {};
  Request request = base_request(files, given.values);
  assign(request, given, DOOR_RENDER);
  if (!request.output.list_devices) {
    require_inputs(request.source);
    require_consistent(request);
    if (!files.save_request.empty()) {
      note_inputs(request);
      claim_output(files.save_request);
      return write_text_file(request_json(request), files.save_request), std::nullopt;
    }
    if (request.output.path.empty())
      throw Error(ExitCode::usage,
                  std::string("found no output, expected -o with a file of ") + PICTURE_NAMES);
  }
  return GivenRequest{std::move(request), std::move(given.notes)};
}

}  // namespace splatray
