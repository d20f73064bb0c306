#include <algorithm>
#include <sstream>

#include "app/library/request/fields.h"
#include "engine/base/number_text.h"

namespace splatray {
namespace {

constexpr FieldGroup OUTPUT = FieldGroup::output;

/// The channels by their names.
struct AovName {
  const char* name;
  bool Request::Output::*member;
};
constexpr AovName AOV_NAMES[] = {{"depth", &Request::Output::aov_depth},
                                 {"normal", &Request::Output::aov_normal},
                                 {"id", &Request::Output::aov_id},
                                 {"error", &Request::Output::aov_error}};

void read_aovs(Request& request, const std::string& text) {
  Request::Output& output = request.output;
  for (const AovName& aov : AOV_NAMES) output.*aov.member = false;
  std::istringstream names(text);
  for (std::string name; std::getline(names, name, ',');) {
    const auto found = std::find_if(std::begin(AOV_NAMES), std::end(AOV_NAMES),
                                    [&](const AovName& aov) { return name == aov.name; });
    if (found == std::end(AOV_NAMES)) throw Expected{"a list of depth, normal, id, error"};
    output.*found->member = true;
  }
  request.settings.aov = output.aov_depth || output.aov_normal || output.aov_id;
  request.settings.estimate_error = output.aov_error;
}

std::string aov_text(const Request& request) {
  std::string text;
  for (const AovName& aov : AOV_NAMES)
    if (request.output.*aov.member) text += (text.empty() ? "" : ",") + std::string(aov.name);
  return text;
}

Field frames_row() {
  return value_row(
      "frames", OUTPUT, "A-B:STEP,...",
      "only these frames of a sequence, such as 0-47 or 0-3,7,9-12:3; default all",
      [](Request& request, const std::string& text) {
        const auto ranges = read_frame_list(text);
        if (!ranges)
          throw Expected{"first-last such as 0-47, or several such as 0-3,7,9-12:3, each up to " +
                         std::to_string(LAST_FRAME)};
        request.output.frames = *ranges;
      },
      [](const Request& request) { return frame_list_text(request.output.frames); });
}

/// Of a program's run, not of a picture.
std::vector<Field> file_fields() {
  constexpr FieldGroup FILES = FieldGroup::files;
  std::vector<Field> rows = {
      path_row("stats-json", FILES, MEMBER(output.stats_json), "write times, counts, bytes and device here"),
      path_row("reference", FILES, MEMBER(output.reference),
               "picture to compare with; exit 1 when they differ"),
      number_row("reference-threshold", FILES, MEMBER(output.reference_threshold), 0.0, 1.0,
                 "allowed error of a pixel, 0..1; default 0.004"),
      number_row("reference-share", FILES, MEMBER(output.reference_share), 0.0, 1.0,
                 "allowed share of pixels beyond it; default 0.0002"),
      number_row("reference-limit", FILES, MEMBER(output.reference_limit), 0.0, 1.0,
                 "no pixel's error may exceed this; default 0.012"),
      switch_row("list-devices", FILES, MEMBER(output.list_devices), "list the Vulkan devices and end"),
      switch_row("quiet", FILES, MEMBER(output.quiet), "only errors on stderr"),
      choice_row<ProgressStyle>("progress", FILES, MEMBER(output.progress),
                                {{"line", ProgressStyle::line},
                                 {"plain", ProgressStyle::plain},
                                 {"json", ProgressStyle::json},
                                 {"openjd", ProgressStyle::openjd}},
                                "how progress is reported: a line on a terminal; lines; a JSON object a "
                                "line; as Open Job Description has "
                                "it; default line")};
  for (Field& row : rows) {
    row.doors = DOOR_RENDER;
    row.why_not = "of a run of the program, not of a picture";
  }
  rows[0].doors = DOOR_RENDER | DOOR_VIEW | DOOR_PREPROCESS;
  return rows;
}

}  // namespace

std::vector<Field> output_fields() {
  std::vector<Field> rows = {
      with(path_row("output", OUTPUT, MEMBER(output.path),
                    "the picture: .png (sRGB) or .exr (linear float); of a sequence with a run of # for the "
                    "frame's "
                    "digits such as out.####.png"),
           {.letter = "-o"}),
      value_row("aov", OUTPUT, "depth,normal,id,error",
                "more channels of an EXR picture: Z, N.X N.Y N.Z, id, error (estimated, of the radiance)",
                read_aovs, aov_text),
      number_row(
          "turntable", OUTPUT, MEMBER(output.turntable), 0, 999999,
          "this many pictures of a full turn about the scene's up axis through the target; default 0 = none"),
      frames_row(),
      switch_row("skip-existing", OUTPUT, MEMBER(output.skip_existing),
                 "leave out pictures whose file is whole and was made by the same command")};
  for (std::size_t i = 2; i < rows.size(); ++i) {
    rows[i].doors = DOOR_RENDER | DOOR_VIEW;
    rows[i].why_not = NOT_SEQUENCES;
  }
  for (Field& row : file_fields()) rows.push_back(std::move(row));
  return rows;
}

}  // namespace splatray
